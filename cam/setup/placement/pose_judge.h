// Judges the poses of a setup while its block stands at one place: joints, and how near each check comes to refusing.
//
// mm and radians. For the search of place_block.h: nothing is allocated per pose, and a region is left as soon as it is
// known to be worse than asked for. Not for several threads at once (tests/cam/setup/placement/pose_judge_test.cpp
// compares with a plain second implementation).

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cam/cell/machine_bodies.h"
#include "cam/cell/reach_map.h"
#include "cam/setup/placement/machine_reachability.h"
#include "cam/setup/placement/margin_tally.h"
#include "cam/setup/placement/milling_poses.h"

namespace qchopper {

// Where the block stands while one direction is milled.
struct StandingBlock {
    Pose setup_in_cell;
    PlacedBox block;
};

// How a region is to be held.
struct ArmPosture {
    ArmConfiguration configuration;
    double redundancy_angle = 0;
    // Where a redundancy angle moves axis 6 alone: that it is chosen so that axis 6 stays in the middle.
    bool turns_freely = false;
};

// Where a turn of a rotary table from one angle to another is judged: at both, and at the multiples of 5 degrees
// between them. So a turn on the way from 0 is judged where that from 0 is, but for its ends.
std::vector<double> judged_table_angles(double from, double to);

class PoseJudge {
 public:
    // Precondition: the cell has a machine; it outlives this object, as the tool does.
    PoseJudge(const Cell& cell, const CuttingTool& tool);

    bool is_gantry() const { return !arm_.has_value(); }
    // Whether the tool axis is the axis of joint 6, so that a turn about it moves that joint alone.
    bool turns_by_axis_6() const { return turns_by_axis_6_; }

    StandingBlock standing(const Pose& setup_in_cell, const Box& block_in_setup) const;

    // Adds the margins of the first `count` poses of a region to the tally. Ends early, with some of them not added,
    // once the score is below `bound`. With turns_freely, `posture` gets the turn.
    void judge(const StandingBlock& block, Vec3 tool_axis, const PoseRegion& region, std::size_t count,
               ArmPosture& posture, double bound, MarginTally& tally);
    // The joints of the poses of the last judge(), as far as it came; nothing for a pose that is not reached.
    const std::vector<std::optional<Joints>>& joints() const { return joints_; }

    // Adds the margins of home, with the tool of this judge.
    void judge_home(const StandingBlock& block, MarginTally& tally);
    // The same for any joints, on the way through the air: limits and distances. Precondition: not a gantry.
    void judge_joints(const StandingBlock& block, const Joints& joints, MarginTally& tally);

 private:
    struct JointExtent {
        double min = 0;
        double max = 0;
        std::size_t min_pose = 0;
        std::size_t max_pose = 0;
    };
    struct Walk;

    std::optional<Joints> joints_at(const Walk& walk, std::size_t index, Vec3 tip_in_base, MarginTally& tally) const;
    void judge_pose(const StandingBlock& block, double feed, const Joints& joints, double bound, MarginTally& tally);
    void judge_travel(Vec3 tip, Vec3 tool_axis, MarginTally& tally) const;
    void judge_limit(std::size_t axis, double joint, std::uint16_t side, MarginTally& tally) const;
    void judge_singularity(const Joints& joints, MarginTally& tally) const;
    void judge_speed(const Joints& joints, double feed, MarginTally& tally) const;
    // While foam is milled the wrist may come where it has been removed (bodies_over_tip()).
    void judge_links(const StandingBlock& block, bool is_milling, MarginTally& tally) const;
    void judge_tool(const StandingBlock& block, bool is_home, MarginTally& tally) const;
    void finish_turning_axes(ArmPosture& posture, MarginTally& tally);
    // Fill links_ and on_axis_.
    void place_links(const Joints& joints);
    void place_axis(Vec3 tip, Vec3 tool_axis);

    const Cell& cell_;
    const CellMachine& machine_;
    double feed_ = 0;
    std::optional<ToolArm> arm_;
    bool turns_by_axis_6_ = false;
    StandingBodies standing_;
    std::vector<AxisBody> axis_bodies_;      // in the frame of the tip
    double lowest_holder_ = 0;               // of the pose's direction: height of holder and spindle over the tip
    std::vector<LinkCapsule> links_;         // of the pose
    std::vector<std::uint8_t> is_over_tip_;  // by link of links_: is_about_tool_axis()
    std::vector<AxisBody> on_axis_;          // of the pose
    std::vector<std::optional<Joints>> joints_;
};

}  // namespace qchopper
