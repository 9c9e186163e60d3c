// Trapezoids of speed.

#include "sim/replay/path_time.h"

#include <algorithm>
#include <cmath>

namespace qchopper {
namespace {

// From speed u to speed v, at most `feed`, over a length.
double seconds_of(double length, double u, double v, double feed, double acceleration) {
    if (length <= 0) return 0;
    const double peak = std::min(feed, std::sqrt(acceleration * length + 0.5 * (u * u + v * v)));
    const double ramps = (2 * peak * peak - u * u - v * v) / (2 * acceleration);
    return (2 * peak - u - v) / acceleration + std::max(0.0, length - ramps) / peak;
}

}  // namespace

PathTime time_of(const ToolPath& path) {
    const std::size_t count = path.lines.size();
    std::vector<double> end_speed(count + 1, 0);  // at the end of line i
    const auto length = [&](std::size_t i) { return norm(path.lines[i].to - path.lines[i].from); };
    for (std::size_t i = 0; i < count; ++i) {
        const TipLine& a = path.lines[i];
        const TipLine* const b = path.after(i);
        if (b == nullptr || a.rounding <= 0) continue;
        const RoundedCorner corner = corner_of(a, *b);
        if (corner.a <= 0) continue;
        const double acceleration = std::min(a.acceleration, b->acceleration);
        end_speed[i] = std::min({a.feed, b->feed, std::sqrt(acceleration * corner.radius)});
    }
    const auto start_speed = [&](std::size_t i) { return i > 0 && path.lines[i].follows_line ? end_speed[i - 1] : 0; };
    for (std::size_t i = 0; i < count; ++i) {
        const double u = start_speed(i);
        end_speed[i] = std::min(end_speed[i], std::sqrt(u * u + 2 * path.lines[i].acceleration * length(i)));
    }
    for (std::size_t i = count; i-- > 1;) {
        if (!path.lines[i].follows_line) continue;
        const double v = end_speed[i];
        end_speed[i - 1] = std::min(end_speed[i - 1], std::sqrt(v * v + 2 * path.lines[i].acceleration * length(i)));
    }
    PathTime time;
    for (std::size_t i = 0; i < count; ++i) {
        const TipLine& line = path.lines[i];
        time.seconds += seconds_of(length(i), start_speed(i), end_speed[i], line.feed, line.acceleration);
        time.line_mm += length(i);
    }
    for (const JointSweep& sweep : path.sweeps) time.seconds += sweep.seconds;
    return time;
}

}  // namespace qchopper
