// Speeds at corners are limited by the corner, then backwards and forwards by what can be reached from the next and
// the one before; so each move knows its speeds at both ends. O(moves).

#include "cam/toolpath/time_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace qchopper {
namespace {

struct Leg {
    Vec3 along;  // unit
    double length = 0;
    double feed = 0;
    MoveKind kind = MoveKind::cut;
    bool is_rounded = false;
};

double feed_of(const Operation& operation, MoveKind kind) {
    if (kind == MoveKind::cut) return operation.feed;
    return kind == MoveKind::approach ? operation.approach_feed : operation.link_feed;
}

std::vector<Leg> legs_of(const Operation& operation, const PathRun& run) {
    std::vector<Leg> legs;
    legs.reserve(run.moves.size());
    Vec3 at = run.start;
    for (const PathMove& move : run.moves) {
        const double length = norm(move.tip - at);
        if (length > 0) {
            legs.push_back(
                {(1 / length) * (move.tip - at), length, feed_of(operation, move.kind), move.kind, move.is_rounded});
        }
        at = move.tip;
    }
    return legs;
}

// A parabola that leaves a leg at a distance a before the corner and comes to the next at a behind it, turned by 2 t,
// is bent most in its middle: with the radius a cos(t)^2 / sin(t).
double corner_speed(const Leg& before, const Leg& after, double rounding, double acceleration) {
    const double most = std::min(before.feed, after.feed);
    const double cosine = std::clamp(dot(before.along, after.along), -1.0, 1.0);
    const double sine_half = std::sqrt(0.5 * (1 - cosine));
    if (sine_half < 1e-4) return most;
    if (!before.is_rounded) return 0;
    const double a = std::min({rounding, 0.5 * before.length, 0.5 * after.length});
    return std::min(most, std::sqrt(acceleration * a * 0.5 * (1 + cosine) / sine_half));
}

// Of the beginning of each leg, and of the end of the last.
std::vector<double> speeds_of(const std::vector<Leg>& legs, double rounding, double acceleration) {
    std::vector<double> speed(legs.size() + 1, 0);
    for (std::size_t i = 1; i < legs.size(); ++i) {
        speed[i] = corner_speed(legs[i - 1], legs[i], rounding, acceleration);
    }
    const auto reached = [&](double from, const Leg& leg) {
        return std::sqrt(from * from + 2 * acceleration * leg.length);
    };
    for (std::size_t i = legs.size(); i-- > 0;) speed[i] = std::min(speed[i], reached(speed[i + 1], legs[i]));
    for (std::size_t i = 0; i < legs.size(); ++i) speed[i + 1] = std::min(speed[i + 1], reached(speed[i], legs[i]));
    return speed;
}

void add_run(const Operation& operation, const PathRun& run, double acceleration, TimeEstimate& estimate) {
    const std::vector<Leg> legs = legs_of(operation, run);
    const std::vector<double> speed = speeds_of(legs, operation.rounding, acceleration);
    for (std::size_t i = 0; i < legs.size(); ++i) {
        const Leg& leg = legs[i];
        const double seconds = move_seconds(leg.length, leg.feed, speed[i], speed[i + 1], acceleration);
        if (leg.kind == MoveKind::cut) {
            estimate.cut_s += seconds;
            estimate.cut_mm += leg.length;
        } else if (leg.kind == MoveKind::approach) {
            estimate.approach_s += seconds;
        } else {
            estimate.link_s += seconds;
            estimate.link_mm += leg.length;
        }
    }
}

}  // namespace

double move_seconds(double length, double feed, double from_speed, double to_speed, double acceleration) {
    if (length <= 0) return 0;
    const double squares = from_speed * from_speed + to_speed * to_speed;
    const double peak = std::min(feed, std::sqrt(acceleration * length + 0.5 * squares));
    const double bent = (2 * peak * peak - squares) / (2 * acceleration);  // length at changing speed
    const double level = std::max(0.0, length - bent);
    return (2 * peak - from_speed - to_speed) / acceleration + (peak > 0 ? level / peak : 0);
}

TimeEstimate time_estimate(const Toolpath& toolpath, const TimeSettings& settings) {
    TimeEstimate estimate;
    for (std::size_t i = 0; i < toolpath.operations.size(); ++i) {
        const Operation& operation = toolpath.operations[i];
        estimate.change_s += settings.direction_s;
        if (i > 0 && operation.tool != toolpath.operations[i - 1].tool) estimate.change_s += settings.tool_change_s;
        for (std::size_t k = 0; k < operation.runs.size(); ++k) {
            add_run(operation, operation.runs[k], settings.acceleration, estimate);
            if (k == 0) continue;
            const Vec3 from = operation.runs[k - 1].moves.back().tip;
            const Vec3 to = operation.runs[k].start;
            estimate.link_s += settings.between_runs
                                   ? settings.between_runs(operation, from, to)
                                   : move_seconds(norm(to - from), operation.link_feed, 0, 0, settings.acceleration);
        }
    }
    return estimate;
}

}  // namespace qchopper
