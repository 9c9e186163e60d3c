// Candidates are tried on the outermost poses first, then on all; the first pose that is refused ends a candidate. 5 to
// 10 microseconds a pose of the candidate that is taken.

#include "cam/program/posture_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "cam/cell/reach_map.h"
#include "cam/setup/placement/place_score.h"

namespace qchopper {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr double rounding = 1e-9;   // of relative margins
constexpr double speed_steps = 20;  // lowered speeds are whole twentieths of that of the operation

bool is_same(const ArmPosture& a, const ArmPosture& b) {
    return a.configuration == b.configuration && a.redundancy_angle == b.redundancy_angle &&
           a.turns_freely == b.turns_freely;
}

std::vector<ArmPosture> posture_candidates(const MachineReachability& reachability, const Cell& cell,
                                           std::size_t orientation, bool turns_by_axis_6) {
    std::vector<ArmPosture> all;
    const auto add = [&](const ArmPosture& posture) {
        if (std::none_of(all.begin(), all.end(), [&](const ArmPosture& own) { return is_same(own, posture); })) {
            all.push_back(posture);
        }
    };
    if (!cell.machine->robot) return {ArmPosture{}};
    for (const RegionReachability& region : reachability.regions) {
        if (region.orientation == orientation && region.holds)
            add({region.configuration, region.redundancy_angle, false});
    }
    std::vector<ArmConfiguration> configurations = all_configurations();
    const ArmConfiguration home = configuration_of(cell.machine->robot->geometry, cell.machine->start.joints);
    std::stable_partition(configurations.begin(), configurations.end(),
                          [&](const ArmConfiguration& own) { return own == home; });
    for (const ArmConfiguration& configuration : configurations) {
        for (int turn = 0; turn < (turns_by_axis_6 ? 1 : redundancy_angles); ++turn) {
            add({configuration, turn * full_turn / redundancy_angles, turns_by_axis_6});
        }
    }
    return all;
}

PoseRegion first_poses(const PoseRegion& region, std::size_t count) {
    PoseRegion first;
    first.poses.assign(region.poses.begin(), region.poses.begin() + static_cast<std::ptrdiff_t>(count));
    first.poses.push_back(first.poses.back());
    first.poses.back().beside = count - 1;
    return first;
}

PoseCheck refusing_check(const MarginTally& tally) {
    std::size_t worst = 0;
    for (std::size_t i = 0; i < pose_checks; ++i) {
        const auto relative = [&](std::size_t k) { return tally.of(static_cast<PoseCheck>(k)).relative; };
        if (relative(i) < relative(worst)) worst = i;
    }
    return static_cast<PoseCheck>(worst);
}

}  // namespace

CuttingTool slowed(CuttingTool tool) {
    tool.feed_max_mm_per_s = 1e-3;
    return tool;
}

double followed_speed(const JointRanges& ranges, const Joints& from, const Joints& to, double length) {
    double speed = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const double turned = std::abs(to[axis] - from[axis]);
        if (turned > 0) speed = std::min(speed, length * ranges[axis].speed / turned);
    }
    return speed;
}

PostureSearch::PostureSearch(const Setup& setup, const MachineReachability& reachability, const Cell& cell,
                             const Operation& operation)
    : cell_(cell),
      operation_(operation),
      slow_tool_(slowed(cell.machine->tools[operation.tool])),
      judge_(cell, slow_tool_),
      tool_axis_(setup.tool_axis(operation.orientation)) {
    standing_ =
        judge_.standing(setup_in_cell(cell, setup.spoil, setup.placement, operation.orientation), setup.block_box());
    candidates_ = posture_candidates(reachability, cell, operation.orientation, judge_.turns_by_axis_6());
}

// Where axis 4 or 6 leaves what its range holds, whichever whole turn is taken.
std::size_t PostureSearch::within_turns(const ArmPosture& posture, std::size_t poses) const {
    const CellMachine& machine = *cell_.machine;
    const ToolArm arm = tool_arm(*machine.robot, machine.spindle, slow_tool_);
    std::size_t reachable = poses;
    for (const std::size_t axis : {std::size_t{3}, std::size_t{5}}) {
        const double low = arm.ranges[axis].min + arm.margin;
        const double high = arm.ranges[axis].max - arm.margin;
        const bool is_free = axis == 5 && posture.turns_freely;
        double min = std::numeric_limits<double>::infinity();
        double max = -min;
        for (std::size_t i = 0; i < reachable; ++i) {
            min = std::min(min, (*judge_.joints()[i])[axis]);
            max = std::max(max, (*judge_.joints()[i])[axis]);
            const double shift = full_turn * std::ceil((low - min) / full_turn - rounding);
            const bool fits = is_free ? max - min <= high - low : max + shift <= high + rounding;
            if (!fits) reachable = i;
        }
    }
    return reachable;
}

std::size_t PostureSearch::reachable_poses(const PoseRegion& region, ArmPosture& posture) {
    MarginTally tally(false);
    judge_.judge(standing_, tool_axis_, region, region.poses.size(), posture, -rounding, tally);
    if (tally.score() >= -rounding) return region.poses.size() - 1;
    if (judge_.is_gantry()) return tally.worst_pose();
    return within_turns(posture, judge_.joints().back() ? region.poses.size() - 1 : tally.worst_pose());
}

std::size_t PostureSearch::fast_poses(std::span<const PathRun> runs, const SampledPath& path, std::size_t poses) const {
    if (judge_.is_gantry()) return poses;
    const JointRanges& ranges = cell_.machine->robot->ranges;
    const double least = cell_.machine->tools[operation_.tool].feed_min_mm_per_s;
    for (std::size_t r = 0; r < runs.size() && path.last[r] < poses; ++r) {
        std::size_t at = path.first[r];
        Vec3 tip = runs[r].start;
        for (const PathMove& move : runs[r].moves) {
            const std::size_t steps = sample_steps(tip, move.tip);
            const double length = norm(move.tip - tip) / static_cast<double>(steps);
            tip = move.tip;
            for (std::size_t i = 0; i < steps; ++i, ++at) {
                if (move.kind != MoveKind::cut || length == 0) continue;
                const Joints& from = *judge_.joints()[at];
                if (followed_speed(ranges, from, *judge_.joints()[at + 1], length) < least) return at + 1;
            }
        }
    }
    return poses;
}

// Judges the runs that are carried alone, so that their joints lie in the middle of their ranges.
ReachablePath PostureSearch::final_path(std::span<const PathRun> runs, const SampledPath& path,
                                        ReachablePath reachable) {
    reachable.runs = path.runs_within(reachable.poses);
    if (reachable.runs == 0) return reachable;
    const PoseRegion region = first_poses(path.region, path.last[reachable.runs - 1] + 1);
    const std::size_t again = reachable_poses(region, reachable.posture);
    if (again < region.poses.size() - 1 || fast_poses(runs, path, again) < again) {
        reachable.runs = 0;
        return reachable;
    }
    if (judge_.is_gantry()) return reachable;
    reachable.joints.reserve(again);
    for (std::size_t i = 0; i < again; ++i) reachable.joints.push_back(*judge_.joints()[i]);
    return reachable;
}

ReachablePath PostureSearch::longest(std::span<const PathRun> runs, const SampledPath& path) {
    const PoseRegion extremes = extreme_poses(path);
    ReachablePath best;
    for (const bool is_second_round : {false, true}) {
        for (const ArmPosture& candidate : candidates_) {
            ArmPosture posture = candidate;
            const bool is_promising = judge_.is_gantry() || reachable_poses(extremes, posture) > 0;
            if (!is_promising) continue;
            // What no extreme pose refuses first; then what carries a part.
            const bool has_extremes = judge_.is_gantry() || judge_.joints().back().has_value();
            if (has_extremes == is_second_round) continue;
            posture = candidate;
            std::size_t poses = reachable_poses(path.region, posture);
            if (poses <= best.poses) continue;
            poses = fast_poses(runs, path, poses);
            if (poses <= best.poses) continue;
            best = {candidate, 0, poses, {}};
            if (poses == path.poses()) return final_path(runs, path, std::move(best));
        }
    }
    ArmPosture posture = best.posture;
    MarginTally tally;
    judge_.judge(standing_, tool_axis_, path.region, std::min(best.poses + 1, path.region.poses.size()), posture,
                 -rounding, tally);
    describe_refusal(tally, path.region);
    return final_path(runs, path, std::move(best));
}

void PostureSearch::describe_refusal(const MarginTally& tally, const PoseRegion& region) {
    ReachabilityMargin margin;
    margin.check = refusing_check(tally);
    if (tally.of(margin.check).relative >= -rounding) {
        refusal_ = "joint speed: a cut would be slower than the least feed of the tool";
        return;
    }
    margin.margin = tally.of(margin.check).margin;
    margin.relative = tally.of(margin.check).relative;
    margin.pair = describe_pair(cell_, margin.check, tally.of(margin.check).pair);
    margin.pose.kind = PoseKind::tip;
    margin.pose.orientation = operation_.orientation;
    margin.pose.tip = region.poses[tally.of(margin.check).pose].tip;
    refusal_ = describe_margin(margin);
}

// Lowered speeds are whole twentieths of the one that is wanted, so that few lines are needed to state them.
double PostureSearch::speed_between(const SampledPath& path, const ReachablePath& reachable, std::size_t first,
                                    std::size_t last, double wanted, double least) const {
    double speed = wanted;
    for (std::size_t i = first; i < last && !judge_.is_gantry(); ++i) {
        const double length = norm(path.region.poses[i + 1].tip - path.region.poses[i].tip);
        if (length == 0) continue;
        const JointRanges& ranges = cell_.machine->robot->ranges;
        speed = std::min(speed, followed_speed(ranges, reachable.joints[i], reachable.joints[i + 1], length));
    }
    if (speed >= wanted) return wanted;
    return std::max(std::floor(speed_steps * speed / wanted) / speed_steps * wanted, std::min(least, speed));
}

ProgramRun PostureSearch::run_of(const PathRun& run, const SampledPath& path, const ReachablePath& reachable,
                                 std::size_t index, std::size_t& lowered) const {
    const double least = cell_.machine->tools[operation_.tool].feed_min_mm_per_s;
    ProgramRun made;
    made.start = run.start;
    made.hole = run.hole;
    std::size_t at = path.first[index];
    if (!judge_.is_gantry())
        made.start_joints = reachable.joints[at], made.end_joints = reachable.joints[path.last[index]];
    const std::size_t before = index > 0 ? path.last[index - 1] : at;
    made.link_speed = speed_between(path, reachable, before, at, operation_.link_feed, 0.5 * least);
    if (made.link_speed < operation_.link_feed) ++lowered;
    Vec3 tip = run.start;
    made.moves.reserve(run.moves.size());
    for (const PathMove& move : run.moves) {
        const std::size_t end = at + sample_steps(tip, move.tip);
        const double wanted = feed_of(operation_, move);
        const double slowest = move.kind == MoveKind::cut ? least : 0.5 * least;
        const double speed = speed_between(path, reachable, at, end, wanted, slowest);
        if (speed < wanted) ++lowered;
        made.moves.push_back({move.tip, move.kind, move.rounding, speed});
        tip = move.tip;
        at = end;
    }
    return made;
}

ProgramOperation PostureSearch::operation(std::span<const PathRun> runs, const SampledPath& path,
                                          const ReachablePath& reachable) const {
    ProgramOperation operation;
    operation.tool = operation_.tool;
    operation.orientation = operation_.orientation;
    operation.tool_axis = tool_axis_;
    operation.configuration = reachable.posture.configuration;
    operation.redundancy_angle = reachable.posture.redundancy_angle;
    operation.rpm = operation_.rpm;
    operation.link_feed = operation_.link_feed;
    operation.runs.reserve(reachable.runs);
    for (std::size_t r = 0; r < reachable.runs; ++r) {
        operation.runs.push_back(run_of(runs[r], path, reachable, r, operation.lowered_moves));
    }
    return operation;
}

}  // namespace qchopper
