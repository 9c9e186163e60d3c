// Trapezoids of speed.

#include "sim/replay/path_time.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

// From speed u to speed v, at most `feed`, over a length.
double seconds_of(double length, double u, double v, double feed, double acceleration) {
    if (length <= 0) return 0;
    const double peak = std::min(feed, std::sqrt(acceleration * length + 0.5 * (u * u + v * v)));
    const double ramps = (2 * peak * peak - u * u - v * v) / (2 * acceleration);
    return (2 * peak - u - v) / acceleration + std::max(0.0, length - ramps) / peak;
}

double length_of(const TipLine& line) {
    return norm(line.to - line.from);
}

// The largest speed in the middle of a corner.
double corner_speed(const TipLine& line, const TipLine& next, const MotionLimits& limits) {
    if (line.rounding <= 0) return 0;
    const RoundedCorner corner = corner_of(line, next);
    if (corner.a <= 0) return 0;
    const double acceleration = std::min(line.acceleration, next.acceleration);
    double speed = std::min({line.feed, next.feed, std::sqrt(acceleration * corner.radius)});
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const double change = std::abs(static_cast<double>(next.first_rates[axis]) - line.last_rates[axis]);
        if (change <= 0 || limits.axis_acceleration[axis] <= 0) continue;
        speed = std::min(speed, std::sqrt(2 * corner.a * limits.axis_acceleration[axis] / change));
    }
    return speed;
}

double start_speed(const ToolPath& path, const std::vector<LineTime>& lines, std::size_t i) {
    return path.before(i) != nullptr ? lines[i - 1].end_speed : 0;
}

// The speed at the end of each line.
std::vector<LineTime> end_speeds(const ToolPath& path, const MotionLimits& limits) {
    std::vector<LineTime> lines(path.lines.size());
    const auto reached = [&](double speed, std::size_t i) {
        return std::sqrt(speed * speed + 2 * path.lines[i].acceleration * length_of(path.lines[i]));
    };
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const TipLine* const next = path.after(i);
        if (next == nullptr) continue;
        const double corner = corner_speed(path.lines[i], *next, limits);
        lines[i].end_speed = std::min(corner, reached(start_speed(path, lines, i), i));
    }
    for (std::size_t i = lines.size(); i-- > 1;) {
        if (path.before(i) == nullptr) continue;
        lines[i - 1].end_speed = std::min(lines[i - 1].end_speed, reached(lines[i].end_speed, i));
    }
    return lines;
}

}  // namespace

MotionLimits motion_limits(const CellMachine& machine) {
    MotionLimits limits{machine.program.interpolation_cycle_s, {}, machine.program.tool_change_s};
    for (std::size_t axis = 0; machine.robot && axis < axes_of_arm; ++axis) {
        limits.axis_acceleration[axis] = machine.robot->ranges[axis].acceleration;
    }
    return limits;
}

double tip_acceleration(const JointRates& rates, const MotionLimits& limits) {
    double acceleration = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const double rate = std::abs(static_cast<double>(rates[axis]));
        if (rate <= 0 || limits.axis_acceleration[axis] <= 0) continue;
        acceleration = std::min(acceleration, limits.axis_acceleration[axis] / rate);
    }
    return acceleration;
}

PathTime time_of(const ToolPath& path, const MotionLimits& limits) {
    PathTime time;
    time.lines = end_speeds(path, limits);
    for (std::size_t i = 0; i < path.lines.size(); ++i) {
        const TipLine& line = path.lines[i];
        LineTime& own = time.lines[i];
        const double start = start_speed(path, time.lines, i);
        const double moving = seconds_of(length_of(line), start, own.end_speed, line.feed, line.acceleration);
        own.seconds = std::max(limits.cycle_s, moving);
        time.seconds += own.seconds;
        time.line_mm += length_of(line);
    }
    for (const JointSweep& sweep : path.sweeps) time.seconds += sweep.seconds;
    time.seconds += limits.tool_change_s * static_cast<double>(path.tool_changes.size());
    return time;
}

}  // namespace qchopper
