// A state per hole; of each line the offset from the axes and the depth along them are compared with bounds. O(lines of
// drills * holes).

#include "sim/replay/hole_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"

namespace qchopper {
namespace {

constexpr double aligned = 0.002;  // radians between a hole and the way of the drill
constexpr double beside = 5;       // mm from its axis: farther away no hole is meant

// Distance from the axis.
double offset_of(const SceneHole& hole, Vec3 point) {
    const Vec3 from = point - hole.mouth;
    return norm(from - dot(from, hole.axis) * hole.axis);
}

double offset_of(const SceneHole& hole, const TipLine& line) {
    return std::max(offset_of(hole, line.from), offset_of(hole, line.to));
}

bool is_parallel(const SceneHole& hole, const TipLine& line, const ReplayScene& scene) {
    return norm(hole.axis + scene.orientations[line.orientation].tool_axis) <= aligned;
}

std::string name_of(const SceneHole& hole) {
    return "hole " + std::to_string(hole.number);
}

}  // namespace

bool is_along(const SceneHole& hole, const TipLine& line, const ReplayScene& scene) {
    return is_parallel(hole, line, scene) && offset_of(hole, line) <= hole_tolerance;
}

HoleSpace::HoleSpace(const ReplayScene& scene) {
    for (const SceneHole& hole : scene.holes) {
        if (!hole.is_robots) continue;
        double point = 0;
        for (const CuttingTool& tool : scene.cell->machine->tools) {
            const bool is_drill_of_it = is_drill(tool) && std::abs(tool.diameter - hole.diameter) <= drill_tolerance;
            if (is_drill_of_it) point = std::max(point, point_height(tool));
        }
        holes_.push_back({&hole, hole.depth + point + hole_margin});
    }
}

bool HoleSpace::has(Vec3 point) const {
    return std::any_of(holes_.begin(), holes_.end(), [&](const Space& space) {
        const double depth = dot(point - space.hole->mouth, space.hole->axis);
        if (depth < -hole_margin || depth > space.depth) return false;
        return offset_of(*space.hole, point) <= 0.5 * space.hole->diameter + hole_margin;
    });
}

HoleCheck::HoleCheck(const ReplayScene& scene, FindingLog& log)
    : scene_(scene), log_(log), states_(scene.holes.size()) {
    stroke_.hole = scene.holes.size();
    figures_.due = static_cast<std::size_t>(
        std::count_if(scene.holes.begin(), scene.holes.end(), [](const SceneHole& hole) { return hole.is_due; }));
}

void HoleCheck::extra(const TipLine& line, const std::string& why) {
    log_.add(FindingKind::extra_hole, line.place, "the drill goes into foam " + why);
}

std::optional<std::size_t> HoleCheck::hole_of(const TipLine& line) const {
    std::optional<std::size_t> found;
    double nearest = beside;
    for (std::size_t i = 0; i < scene_.holes.size(); ++i) {
        const SceneHole& hole = scene_.holes[i];
        if (!is_parallel(hole, line, scene_)) continue;
        if (line.hole > 0 && hole.number == line.hole && hole.is_due) return i;
        const double offset = offset_of(hole, line);
        if (offset > nearest) continue;
        nearest = offset;
        found = i;
    }
    return found;
}

void HoleCheck::take_line(const TipLine& line, bool removes_foam) {
    const std::optional<std::size_t> hole = hole_of(line);
    if (removes_foam) take_cut(line, hole);
    follow(line, hole);
}

void HoleCheck::take_cut(const TipLine& line, std::optional<std::size_t> index) {
    if (!index) return extra(line, "where the job has no hole");
    const SceneHole& hole = scene_.holes[*index];
    if (!hole.is_robots) return extra(line, "at " + name_of(hole) + ", which is to be drilled by hand");
    if (!hole.is_due) return extra(line, "at " + name_of(hole) + ", which another part drills");
    take_hole(*index, line, scene_.cell->machine->tools[line.tool]);
}

void HoleCheck::follow(const TipLine& line, std::optional<std::size_t> index) {
    const bool is_on_axis = index && offset_of(scene_.holes[*index], line) <= beside;
    const std::size_t hole = is_on_axis ? *index : scene_.holes.size();
    if (!line.follows_line || run_ == 0 || hole != stroke_.hole) {
        end_stroke();
        ++run_;
        stroke_.hole = hole;
    }
    if (!is_on_axis) return;
    const auto depth_of = [&](Vec3 tip) { return dot(tip - scene_.holes[hole].mouth, scene_.holes[hole].axis); };
    const double depth = depth_of(line.to);
    if (depth <= depth_of(line.from)) return end_stroke();
    if (depth > hole_tolerance) stroke_.depth = depth, stroke_.place = line.place;
}

void HoleCheck::end_stroke() {
    const double depth = std::exchange(stroke_.depth, 0);
    if (depth == 0) return;
    const SceneHole& hole = scene_.holes[stroke_.hole];
    State& state = states_[stroke_.hole];
    const bool is_deeper_peck = state.run == run_ && depth > state.deepest + hole_tolerance;
    if (hole.is_due && state.run > 0 && !is_deeper_peck) {
        state.is_refused = true;
        log_.add(FindingKind::repeated_hole, stroke_.place, depth, depth, [&] {
            return name_of(hole) + " is drilled again: the tip goes " + fixed(depth, 2) +
                   " mm below the cap, it has been " + fixed(state.deepest, 2) + " mm below it" +
                   (state.run == run_ ? "" : " and has left the hole");
        });
    }
    state.run = run_;
    state.deepest = std::max(state.deepest, depth);
}

void HoleCheck::take_hole(std::size_t index, const TipLine& line, const CuttingTool& tool) {
    const SceneHole& hole = scene_.holes[index];
    State& state = states_[index];
    const double offset = offset_of(hole, line);
    figures_.largest_offset = std::max(figures_.largest_offset, offset);
    if (offset > hole_tolerance) {
        state.is_refused = true;
        log_.add(FindingKind::shifted_hole, line.place, offset, offset, [&] {
            return name_of(hole) + " is drilled " + fixed(offset, 2) + " mm beside its axis, at most " +
                   fixed(hole_tolerance, 2) + " are allowed";
        });
    }
    const double wider = tool.diameter - hole.diameter;
    if (std::abs(wider) > drill_tolerance) {
        state.is_refused = true;
        log_.add(FindingKind::hole_diameter, line.place, tool.diameter, std::abs(wider), [&] {
            return name_of(hole) + " is drilled with tool " + std::to_string(tool.number) + " of " +
                   fixed(tool.diameter, 2) + " mm, it is to be " + fixed(hole.diameter, 2) + " mm wide";
        });
    }
    const double tip = std::max(dot(line.from - hole.mouth, hole.axis), dot(line.to - hole.mouth, hole.axis));
    const double depth = tip - point_height(tool);
    if (depth > state.reached || state.place.line == 0) state.reached = depth, state.place = line.place;
    if (depth <= hole.depth + hole_tolerance) return;
    state.is_refused = true;
    log_.add(FindingKind::hole_depth, line.place, depth, depth - hole.depth, [&] {
        return name_of(hole) + " is drilled " + fixed(depth, 2) + " mm deep, it is to be " + fixed(hole.depth, 2) +
               " mm deep";
    });
}

HoleFigures HoleCheck::finish() {
    end_stroke();
    for (std::size_t i = 0; i < states_.size(); ++i) {
        const SceneHole& hole = scene_.holes[i];
        const State& state = states_[i];
        if (!hole.is_due) continue;
        if (state.place.line == 0) {
            log_.add(FindingKind::missing_hole, {}, 0, hole.depth, [&] { return name_of(hole) + " is not drilled"; });
            continue;
        }
        const double lacks = hole.depth - state.reached;
        if (lacks > hole_tolerance) {
            log_.add(FindingKind::hole_depth, state.place, state.reached, lacks, [&] {
                return name_of(hole) + " is drilled only " + fixed(state.reached, 2) + " mm deep, it is to be " +
                       fixed(hole.depth, 2) + " mm deep";
            });
        }
        if (lacks <= hole_tolerance && !state.is_refused) ++figures_.drilled;
    }
    return figures_;
}

}  // namespace qchopper
