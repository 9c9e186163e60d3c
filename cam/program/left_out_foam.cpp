// The tool stands for its way at places a radius apart, as a capsule from its tip up to the retract plane. O(moves *
// (1 + length / radius) * bodies).

#include "cam/program/left_out_foam.h"

#include <algorithm>
#include <cmath>

namespace qchopper {
namespace {

constexpr double clearance = 5;       // mm
constexpr double straight_up = 1e-6;  // of the sine of the angle to the tool axis

// Out of where the tool stands already: it meets nothing new.
bool is_retract(Vec3 from, Vec3 to, Vec3 tool_axis) {
    const Vec3 way = to - from;
    return dot(way, tool_axis) > 0 && norm(cross(way, tool_axis)) <= straight_up * norm(way);
}

}  // namespace

std::vector<Capsule> bodies_of_cut(Vec3 from, Vec3 to, Vec3 tool_axis, double radius, double retract) {
    const Vec3 way = to - from;
    const auto steps = static_cast<std::size_t>(std::ceil(norm(way) / radius));
    // Half way between two places the way is half a radius from the nearest.
    const double wide = std::hypot(radius, 0.5 * radius);
    std::vector<Capsule> bodies;
    for (std::size_t i = 0; i <= steps; ++i) {
        const Vec3 tip = steps > 0 ? from + (static_cast<double>(i) / static_cast<double>(steps)) * way : from;
        const double height = std::max(0.0, retract - dot(tool_axis, tip));
        bodies.push_back({tip, tip + height * tool_axis, wide});
    }
    return bodies;
}

std::size_t slow_moves_near(const std::vector<Capsule>& bodies, const CuttingTool& tool, double retract,
                            ProgramOperation& operation) {
    if (bodies.empty()) return 0;
    std::size_t slowed = 0;
    for (ProgramRun& run : operation.runs) {
        Vec3 from = run.start;
        for (ProgramMove& move : run.moves) {
            const Vec3 begin = from;
            from = move.tip;
            if (move.speed <= tool.feed_min_mm_per_s || is_retract(begin, move.tip, operation.tool_axis)) continue;
            const std::vector<Capsule> way =
                bodies_of_cut(begin, move.tip, operation.tool_axis, 0.5 * tool.diameter, retract);
            const bool is_near = std::any_of(way.begin(), way.end(), [&](const Capsule& own) {
                return std::any_of(bodies.begin(), bodies.end(),
                                   [&](const Capsule& body) { return distance(own, body) < clearance; });
            });
            if (!is_near) continue;
            move.speed = tool.feed_min_mm_per_s;
            ++slowed;
        }
    }
    return slowed;
}

}  // namespace qchopper
