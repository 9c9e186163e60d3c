// One pass over the moves each, or for feeds two: with what each move removes by itself, and with that of the rounded
// corner at its end, as the share of the next move's length. The feed of neighbours by bisection.
// O(moves * moves within a diameter).

#include "cam/toolpath/run_motion.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

namespace qchopper {
namespace {

constexpr double feed_ratio = 0.95;  // of neighbouring feeds
constexpr int halvings = 40;         // of a range of feeds
constexpr double kept_feed = 0.85;   // of what is allowed: a slower feed is raised
constexpr std::array<double, 6> distances{5, 2, 0.8, 0.3, 0.12, 0.05};

// Largest value of the table that is not above a distance; 0: none is.
double settled(double distance) {
    const auto* const found = std::ranges::find_if(distances, [&](double value) { return value <= distance; });
    return found == distances.end() ? 0 : *found;
}

bool is_cutting(const PathMove& move) {
    return move.kind == MoveKind::cut || move.kind == MoveKind::approach;
}

// The moves of a run: lengths, volumes that they remove, feeds with which they are driven, and least feeds.
struct DrivenMoves {
    std::vector<double> length;
    std::vector<double> volume;
    std::vector<double> feed;
    std::vector<double> least;

    // Slows the fastest of the moves that end with move `last` and are together as long as `width`, to one feed, if
    // they remove more than `rate`. To slow all of them by the same factor would bring those that are slow already
    // below their least feed.
    void slow(std::size_t last, double width, double rate) {
        double mm = 0;
        double mm3 = 0;
        std::size_t first = last + 1;
        while (first > 0 && mm < width) {
            --first;
            mm += length[first];
            mm3 += volume[first];
        }
        const auto feed_at = [&](std::size_t i, double most) { return std::min(feed[i], std::max(most, least[i])); };
        const auto is_slow_enough = [&](double most) {
            double seconds = 0;
            for (std::size_t i = first; i <= last; ++i) seconds += length[i] / feed_at(i, most);
            return mm3 <= rate * seconds;
        };
        double high = *std::max_element(feed.begin() + static_cast<std::ptrdiff_t>(first),
                                        feed.begin() + static_cast<std::ptrdiff_t>(last) + 1);
        if (is_slow_enough(high)) return;
        double low = 0;
        for (int k = 0; k < halvings; ++k) {
            const double middle = 0.5 * (low + high);
            (is_slow_enough(middle) ? low : high) = middle;
        }
        for (std::size_t i = first; i <= last; ++i) feed[i] = feed_at(i, low);
    }

    void slow_all(double width, double rate) {
        for (std::size_t i = 0; i < length.size(); ++i) slow(i, width, rate);
    }

    // Counts what is removed in rounded corners for the moves before them, by the share of the next move's length.
    void count_corners_before(const std::vector<PathMove>& moves) {
        double taken = 0;  // of the own volume, by the corner before
        for (std::size_t i = 0; i < volume.size(); ++i) {
            double next = 0;
            if (i + 1 < volume.size() && length[i + 1] > 0) {
                const double corner = std::min({moves[i].rounding, 0.5 * length[i], 0.5 * length[i + 1]});
                next = corner / length[i + 1] * volume[i + 1];
            }
            volume[i] += next - taken;
            taken = next;
        }
    }
};

}  // namespace

double corner_rounding(Vec3 from, Vec3 at, Vec3 to, double deviation, double largest) {
    const Vec3 before = at - from;
    const Vec3 behind = to - at;
    const double lengths = norm(before) * norm(behind);
    if (!(lengths > 0)) return 0;
    const double half_angle = std::sqrt(std::max(0.0, 0.5 * (1 - dot(before, behind) / lengths)));
    const double allowed = half_angle * largest > 2 * deviation ? 2 * deviation / half_angle : largest;
    const double most = 0.5 * std::min(norm(before), norm(behind));
    return allowed >= most ? largest : allowed;
}

Vec3 on_parabola(Vec3 from, Vec3 at, Vec3 to, double rounding, double t) {
    const double before = norm(at - from);
    const double behind = norm(to - at);
    const double a = std::min(rounding, 0.5 * std::min(before, behind));
    const Vec3 first = at - (a / before) * (at - from);
    const Vec3 last = at + (a / behind) * (to - at);
    return (1 - t) * (1 - t) * first + 2 * t * (1 - t) * at + t * t * last;
}

void limit_feeds(PathRun& run, std::span<const double> removed_mm3, double cell, const CuttingTool& tool,
                 const Operation& operation) {
    assert(removed_mm3.size() == run.moves.size());
    const auto least_feed = [&](const PathMove& move) {
        if (!is_cutting(move)) return operation.link_feed;
        return std::min(feed_of(operation, move.kind), (move.kind == MoveKind::cut ? 1 : 0.5) * tool.feed_min_mm_per_s);
    };
    DrivenMoves moves{{}, {removed_mm3.begin(), removed_mm3.end()}, {}, {}};
    Vec3 at = run.start;
    for (const PathMove& move : run.moves) {
        moves.length.push_back(norm(move.tip - at));
        moves.feed.push_back(feed_of(operation, move.kind));
        moves.least.push_back(least_feed(move));
        at = move.tip;
    }
    const double rate = used_rate * (1 - std::min(cell / tool.diameter, 1.0)) * tool.removal_mm3_per_s;
    moves.slow_all(tool.diameter, rate);
    moves.count_corners_before(run.moves);
    moves.slow_all(tool.diameter, rate);
    std::array<double, 2> current{operation.feed, operation.approach_feed};
    for (std::size_t i = 0; i < run.moves.size(); ++i) {
        PathMove& move = run.moves[i];
        if (!is_cutting(move)) continue;
        const bool is_cut = move.kind == MoveKind::cut;
        const double own = feed_of(operation, move.kind);
        const double allowed = std::min(own, moves.feed[i]);
        double& feed = current[is_cut ? 0 : 1];
        if (feed > allowed || feed < kept_feed * allowed || allowed == own) {
            const double steps = std::ceil(std::log(allowed / own) / std::log(feed_ratio) - 1e-9);
            feed = std::max(moves.least[i], own * std::pow(feed_ratio, steps));
        }
        move.feed = feed < own ? feed : 0;
    }
}

double seconds_at_feed(const PathRun& run, const Operation& operation) {
    double seconds = 0;
    Vec3 at = run.start;
    for (const PathMove& move : run.moves) {
        seconds += norm(move.tip - at) / feed_of(operation, move);
        at = move.tip;
    }
    return seconds;
}

void settle_rounding(PathRun& run, double largest) {
    double current = 0;
    Vec3 at = run.start;
    for (std::size_t i = 0; i + 1 < run.moves.size(); ++i) {
        PathMove& move = run.moves[i];
        const double half = 0.5 * std::min(norm(move.tip - at), norm(run.moves[i + 1].tip - move.tip));
        at = move.tip;
        if (!(move.rounding > 0)) continue;
        const bool is_free = move.rounding >= largest;
        const double wanted = std::min(move.rounding, half);
        const bool is_kept = current > 0 && (is_free || current <= move.rounding) && 2 * current >= wanted;
        if (!is_kept) current = std::min(largest, settled(move.rounding));
        move.rounding = current;
    }
}

}  // namespace qchopper
