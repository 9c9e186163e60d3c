// The holes of a job against what a drill does in a replay: each where the job says, as wide and as deep, and no other.
//
// mm, setup coordinates. A hole is judged by the lines of the tip along which a drill removes foam: both ends of a line
// lie on the axis of the hole that it drills, and the deepest end is as deep as the hole and the point of the drill. A
// line belongs to the hole that its program names in a comment, else to the nearest one. A hole is drilled in one run,
// in strokes that go deeper each time: once the drill has left the axis it may not go into that hole again. Foam inside
// a hole of the robot is neither gouge nor leftover (gouge.h, volumes.h). tests/sim/replay/hole_check_test.cpp.

#pragma once

#include <optional>
#include <vector>

#include "cam/cell/cutting_tool.h"
#include "sim/replay/finding.h"
#include "sim/replay/scene.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

constexpr double hole_tolerance = 0.2;    // mm, of the axis and of the depth
constexpr double drill_tolerance = 0.05;  // mm, of the diameter
constexpr double hole_margin = 0.25;      // mm around a hole within which foam may be missing

// Whether a line stays on the axis of a hole, at right angles to its cap.
bool is_along(const SceneHole& hole, const TipLine& line, const ReplayScene& scene);

// Whether a point lies in one of the robot's holes, with the point of its drill and hole_margin around it.
class HoleSpace {
 public:
    explicit HoleSpace(const ReplayScene& scene);
    bool has(Vec3 point) const;
    bool is_empty() const { return holes_.empty(); }

 private:
    struct Space {
        const SceneHole* hole = nullptr;
        double depth = 0;
    };
    std::vector<Space> holes_;
};

struct HoleFigures {
    std::size_t due = 0;        // that the program is to drill
    std::size_t drilled = 0;    // of them, as the job says
    double largest_offset = 0;  // of what was drilled, from the axis
};

class HoleCheck {
 public:
    // Both outlive this object.
    HoleCheck(const ReplayScene& scene, FindingLog& log);

    // A line of a drill, in their order.
    void take_line(const TipLine& line, bool removes_foam);

    // After the last line.
    HoleFigures finish();

 private:
    struct State {
        double reached = 0;  // of the full diameter
        SourcePlace place;
        bool is_refused = false;
        std::size_t run = 0;  // in which the last stroke was; 0: there was none
        double deepest = 0;   // of the tip in all strokes
    };
    // The way of the drill down into a hole, until it comes up again or leaves the axis.
    struct Stroke {
        std::size_t hole = 0;  // index; that of no hole: the drill is on no axis
        double depth = 0;      // of the tip; 0: it is not below the cap
        SourcePlace place;
    };
    std::optional<std::size_t> hole_of(const TipLine& line) const;
    void take_cut(const TipLine& line, std::optional<std::size_t> index);
    void follow(const TipLine& line, std::optional<std::size_t> index);
    void end_stroke();
    void take_hole(std::size_t index, const TipLine& line, const CuttingTool& tool);
    void extra(const TipLine& line, const std::string& why);

    const ReplayScene& scene_;
    FindingLog& log_;
    std::vector<State> states_;  // per hole of the scene
    Stroke stroke_;
    std::size_t run_ = 0;  // changes whenever the drill leaves an axis
    HoleFigures figures_;
};

}  // namespace qchopper
