// Finds the arm configuration and the redundancy angle by which it holds runs of a toolpath.
//
// mm, radians, in setup coordinates. Every end of a move and poses between are judged by PoseJudge: joint and cable
// limits, singularities, steps of the axes, distances of arm, spindle and holder, each with the margin of
// machine_reachability.h, the arm against the whole block. A speed that a joint cannot follow does not refuse a posture
// unless a cut would become slower than the tool allows. Not for several threads at once.

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/program/program.h"
#include "cam/program/sampled_path.h"
#include "cam/setup/placement/machine_reachability.h"
#include "cam/setup/placement/pose_judge.h"
#include "cam/setup/setup.h"

namespace qchopper {

// How far one posture carries runs.
struct ReachablePath {
    ArmPosture posture;
    std::size_t runs = 0;        // carried, from the first on
    std::size_t poses = 0;       // held, from the first on; also those of a run that is not carried
    std::vector<Joints> joints;  // of the poses of the runs carried; none of a gantry
};

class PostureSearch {
 public:
    // For one operation; everything outlives this object. Precondition: the cell has a machine.
    PostureSearch(const Setup& setup, const MachineReachability& reachability, const Cell& cell,
                  const Operation& operation);
    PostureSearch(const PostureSearch&) = delete;
    PostureSearch& operator=(const PostureSearch&) = delete;

    // By the posture that carries most runs from the first on: the first one that carries all of them, beginning with
    // those of the envelope. The path is that of the runs.
    ReachablePath longest(std::span<const PathRun> runs, const SampledPath& path);

    // What refuses the pose behind those that the last longest() held: check, pair, margin and pose.
    const std::string& refusal() const { return refusal_; }

    // The runs carried, with their joints and with lower speeds where a joint would be too fast.
    ProgramOperation operation(std::span<const PathRun> runs, const SampledPath& path,
                               const ReachablePath& reachable) const;

    Vec3 tool_axis() const { return tool_axis_; }

 private:
    // The number of poses that a posture keeps, and their joints in judge_.
    std::size_t reachable_poses(const PoseRegion& region, ArmPosture& posture);
    std::size_t within_turns(const ArmPosture& posture, std::size_t poses) const;
    // The number of poses before the first cut that is too slow.
    std::size_t fast_poses(std::span<const PathRun> runs, const SampledPath& path, std::size_t poses) const;
    ReachablePath final_path(std::span<const PathRun> runs, const SampledPath& path, ReachablePath reachable);
    void describe_refusal(const MarginTally& tally, const PoseRegion& region);
    // The speed wanted, or a lower one that every joint can follow from pose `first` to `last` of the path.
    double speed_between(const SampledPath& path, const ReachablePath& reachable, std::size_t first, std::size_t last,
                         double wanted, double least) const;
    ProgramRun run_of(const PathRun& run, const SampledPath& path, const ReachablePath& reachable, std::size_t index,
                      std::size_t& lowered) const;

    const Cell& cell_;
    const Operation& operation_;
    CuttingTool slow_tool_;  // whose feed no joint is too slow for
    PoseJudge judge_;
    StandingBlock standing_;
    Vec3 tool_axis_;
    std::vector<ArmPosture> candidates_;
    std::string refusal_;
};

// The tool with a feed that no joint is too slow for: a judge that is given it leaves speeds to be looked at apart.
CuttingTool slowed(CuttingTool tool);

// The largest speed of a tip that goes a length while the joints go from one pose to another: infinite if none turns.
double followed_speed(const JointRanges& ranges, const Joints& from, const Joints& to, double length);

}  // namespace qchopper
