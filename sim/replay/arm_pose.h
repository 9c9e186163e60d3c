// The arm at one pose of a replay: what is wrong with its joints and with the place of its bodies.
//
// O(bodies squared) per pose; what allocates is reserved once (tests/sim/replay/replay_test.cpp).

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cam/cell/machine_bodies.h"
#include "sim/replay/finding.h"
#include "sim/replay/scene.h"

namespace qchopper {

// Degrees and mm below which a pose is refused; docs/user/envelope.md says with which margins setups are planned.
struct ArmThresholds {
    double wrist_deg = 5;     // of axis 5 from 0 and 180
    double shoulder_mm = 50;  // wrist centre from axis 1
    double elbow = 0.005;     // 1 - reach / largest
};

class ArmPoses {
 public:
    ArmPoses(const Cell& cell, FindingLog& log) : cell_(cell), log_(log), standing_(standing_bodies(cell)) {}

    void check_joints(const Joints& joints, SourcePlace place);
    // Only while the arm follows a line: a PTP may pass a singularity.
    void check_singularity(const Joints& joints, SourcePlace place);
    // Links, spindle, holder and tool against table, floor, obstacles and links, and links against the block as it was
    // before the program, where `block` is given in the cell. While foam is milled the wrist, which comes over the tip
    // as the spindle does, is left to mill_stock.h.
    void check_bodies(const Joints& joints, const CuttingTool& tool, const PlacedBox& block, bool is_milling,
                      SourcePlace place);
    // Those joints of `flange` (in the robot's base) on the configuration of `now` that are nearest to it; nothing if
    // there are none.
    std::optional<Joints> follow(const Pose& flange, const Joints& now) const;

 private:
    void check_links(const MovingBodies& bodies, SourcePlace place);
    void check_block(const MovingBodies& bodies, const PlacedBox& block, bool is_milling, SourcePlace place);
    void check_axis_body(const MovingBodies& bodies, const AxisBody& body, SourcePlace place);
    void collide(const std::string& what, SourcePlace place);
    template <class Shape>
    bool meets_table(const Shape& shape) const;

    const Cell& cell_;
    FindingLog& log_;
    StandingBodies standing_;
};

}  // namespace qchopper
