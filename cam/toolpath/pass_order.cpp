// Entries lie in squares; rings of squares about the place are looked at until no nearer entry can be farther out.
// O(entries in the rings).

#include "cam/toolpath/pass_order.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

constexpr std::size_t entries_of_closed = 16;
constexpr int most_rounds = 30;             // of turning stretches about
constexpr std::size_t most_turned = 1'000;  // passes in a stretch
constexpr double least_gain = 1e-6;         // mm

double distance(Vec3 a, Vec3 b) {
    return std::hypot(b.x - a.x, b.y - a.y);
}

// A pass from its beginning to its end.
struct Leg {
    PassEntry entry;
    Vec3 begin;
    Vec3 end;
};

Leg leg_of(std::span<const Pass> passes, PassEntry entry) {
    const std::vector<PassPoint>& points = passes[entry.pass].points;
    const std::size_t end = passes[entry.pass].is_closed ? entry.point : points.size() - 1 - entry.point;
    return {entry, points[entry.point].tip, points[end].tip};
}

// Turns the legs from `first` to `last` about, each of them too.
void turn_about(std::vector<Leg>& legs, std::size_t first, std::size_t last, std::span<const Pass> passes) {
    std::reverse(legs.begin() + static_cast<std::ptrdiff_t>(first),
                 legs.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    for (std::size_t i = first; i <= last; ++i) {
        Leg& leg = legs[i];
        if (passes[leg.entry.pass].is_closed) continue;
        leg.entry.point = passes[leg.entry.pass].points.size() - 1 - leg.entry.point;
        std::swap(leg.begin, leg.end);
    }
}

// One round over all stretches. Whether any was turned about.
bool shorten(std::vector<Leg>& legs, Vec3 from, std::span<const Pass> passes) {
    bool is_shorter = false;
    for (std::size_t first = 0; first < legs.size(); ++first) {
        const Vec3 before = first > 0 ? legs[first - 1].end : from;
        const std::size_t end = std::min(legs.size(), first + most_turned);
        for (std::size_t last = first; last < end; ++last) {
            double gain = distance(before, legs[first].begin) - distance(before, legs[last].end);
            if (last + 1 < legs.size()) {
                const Vec3 after = legs[last + 1].begin;
                gain += distance(legs[last].end, after) - distance(legs[first].begin, after);
            }
            if (gain < least_gain) continue;
            turn_about(legs, first, last, passes);
            is_shorter = true;
        }
    }
    return is_shorter;
}

}  // namespace

PassOrder::PassOrder(std::span<const Pass> passes)
    : passes_(passes), is_taken_(passes.size(), false), left_(passes.size()) {
    if (passes.empty()) return;
    box_ = {passes[0].points[0].tip, passes[0].points[0].tip};
    for (const Pass& pass : passes) {
        for (const PassPoint& point : pass.points) extend(box_, point.tip);
    }
    const Vec3 size = box_.size();
    side_ = std::max(
        {1.0, std::sqrt(size.x * size.y / static_cast<double>(passes.size())), std::max(size.x, size.y) / 1000});
    columns_ = static_cast<std::ptrdiff_t>(size.x / side_) + 1;
    rows_ = static_cast<std::ptrdiff_t>(size.y / side_) + 1;
    squares_.resize(static_cast<std::size_t>(columns_ * rows_));
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const std::size_t last = passes[i].points.size() - 1;
        if (!passes[i].is_closed) {
            add(i, 0);
            add(i, last);
            continue;
        }
        const std::size_t step = std::max<std::size_t>(1, last / entries_of_closed);
        for (std::size_t k = 0; k < last; k += step) add(i, k);
    }
}

std::pair<std::ptrdiff_t, std::ptrdiff_t> PassOrder::square_of(Vec3 at) const {
    return {std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>((at.x - box_.min.x) / side_), 0, columns_ - 1),
            std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>((at.y - box_.min.y) / side_), 0, rows_ - 1)};
}

void PassOrder::add(std::size_t pass, std::size_t point) {
    const Vec3 at = passes_[pass].points[point].tip;
    const auto [column, row] = square_of(at);
    squares_[static_cast<std::size_t>(row * columns_ + column)].push_back({{pass, point}, at});
}

void PassOrder::look_at(std::ptrdiff_t column, std::ptrdiff_t row, Vec3 from, double& least, const Entry*& nearest) {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return;
    std::vector<Entry>& entries = squares_[static_cast<std::size_t>(row * columns_ + column)];
    std::erase_if(entries, [&](const Entry& entry) { return is_taken_[entry.entry.pass]; });
    for (const Entry& entry : entries) {
        const double distance = std::hypot(entry.at.x - from.x, entry.at.y - from.y);
        const bool is_first = nearest != nullptr && distance == least && entry.entry.pass < nearest->entry.pass;
        if (distance >= least && !is_first) continue;
        least = distance;
        nearest = &entry;
    }
}

std::optional<PassEntry> PassOrder::take_nearest(Vec3 from) {
    if (left_ == 0) return std::nullopt;
    const auto [column, row] = square_of(from);
    double least = std::numeric_limits<double>::infinity();
    const Entry* nearest = nullptr;
    // A place beside the box is nearer to the squares of its own rim than the rings tell: its distance is added.
    const Vec3 inside{std::clamp(from.x, box_.min.x, box_.max.x), std::clamp(from.y, box_.min.y, box_.max.y), 0};
    for (std::ptrdiff_t ring = 0; ring <= std::max(columns_, rows_); ++ring) {
        const double beyond = static_cast<double>(ring - 1) * side_;
        if (nearest != nullptr && beyond > least + std::hypot(inside.x - from.x, inside.y - from.y)) break;
        for (std::ptrdiff_t k = -ring; k <= ring; ++k) {
            look_at(column + k, row - ring, from, least, nearest);
            if (ring > 0) look_at(column + k, row + ring, from, least, nearest);
            if (std::abs(k) == ring) continue;
            look_at(column - ring, row + k, from, least, nearest);
            look_at(column + ring, row + k, from, least, nearest);
        }
    }
    assert(nearest != nullptr);
    const PassEntry taken = nearest->entry;
    is_taken_[taken.pass] = true;
    --left_;
    return taken;
}

std::vector<PassEntry> short_order(std::span<const Pass> passes, Vec3 from) {
    std::vector<Leg> legs;
    legs.reserve(passes.size());
    PassOrder nearest(passes);
    Vec3 at = from;
    while (const std::optional<PassEntry> entry = nearest.take_nearest(at)) {
        legs.push_back(leg_of(passes, *entry));
        at = legs.back().end;
    }
    for (int round = 0; round < most_rounds && shorten(legs, from, passes); ++round) {
    }
    std::vector<PassEntry> order;
    order.reserve(legs.size());
    for (const Leg& leg : legs) order.push_back(leg.entry);
    return order;
}

Pass begun_at(const Pass& pass, std::size_t point) {
    Pass begun = pass;
    if (pass.is_closed) {
        begun.points.pop_back();
        std::rotate(begun.points.begin(), begun.points.begin() + static_cast<std::ptrdiff_t>(point),
                    begun.points.end());
        begun.points.push_back(begun.points.front());
    } else if (point > 0) {
        std::reverse(begun.points.begin(), begun.points.end());
    }
    return begun;
}

}  // namespace qchopper
