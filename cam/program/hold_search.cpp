// Candidates are tried on the outermost poses first, then on all; the first pose that is refused ends a candidate. 5 to
// 10 microseconds a pose of the candidate that is taken.

#include "cam/program/hold_search.h"

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
constexpr double rounding = 1e-9;       // of relative margins
constexpr double speed_steps = 20;      // lowered speeds are whole twentieths of that of the operation
constexpr double no_speed_mm_s = 1e-3;  // of the judge: speeds are looked at apart

bool is_same(const RegionHold& a, const RegionHold& b) {
    return a.branch == b.branch && a.tool_turn == b.tool_turn && a.turns_freely == b.turns_freely;
}

std::vector<RegionHold> hold_candidates(const WorkEnvelope& envelope, const Cell& cell, std::size_t direction,
                                        bool turns_by_axis_6) {
    std::vector<RegionHold> all;
    const auto add = [&](const RegionHold& hold) {
        if (std::none_of(all.begin(), all.end(), [&](const RegionHold& own) { return is_same(own, hold); })) {
            all.push_back(hold);
        }
    };
    if (!cell.machine->robot) return {RegionHold{}};
    for (const HeldRegion& region : envelope.regions) {
        if (region.direction == direction && region.holds) add({region.branch, region.tool_turn, false});
    }
    std::vector<ArmBranch> branches = all_branches();
    const ArmBranch home = branch_of(cell.machine->robot->geometry, cell.machine->start.joints);
    std::stable_partition(branches.begin(), branches.end(), [&](const ArmBranch& own) { return own == home; });
    for (const ArmBranch& branch : branches) {
        for (int turn = 0; turn < (turns_by_axis_6 ? 1 : tool_turns); ++turn) {
            add({branch, turn * full_turn / tool_turns, turns_by_axis_6});
        }
    }
    return all;
}

CarvingTool slowed(CarvingTool tool) {
    tool.feed_max_mm_per_s = no_speed_mm_s;
    return tool;
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

double followed_speed(const JointRanges& ranges, const Joints& from, const Joints& to, double length) {
    double speed = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const double turned = std::abs(to[axis] - from[axis]);
        if (turned > 0) speed = std::min(speed, length * ranges[axis].speed / turned);
    }
    return speed;
}

HoldSearch::HoldSearch(const Setup& setup, const WorkEnvelope& envelope, const Cell& cell, const Operation& operation)
    : cell_(cell),
      operation_(operation),
      slow_tool_(slowed(cell.machine->tools[operation.tool])),
      judge_(cell, slow_tool_),
      out_(setup.tool_axis(operation.direction)) {
    standing_ =
        judge_.standing(setup_in_cell(cell, setup.spoil, setup.placement, operation.direction), setup.block_box());
    candidates_ = hold_candidates(envelope, cell, operation.direction, judge_.turns_by_axis_6());
}

double HoldSearch::speed_of(MoveKind kind) const {
    if (kind == MoveKind::approach) return operation_.approach_feed;
    return kind == MoveKind::cut ? operation_.feed : operation_.link_feed;
}

// Where axis 4 or 6 leaves what its range holds, whichever whole turn is taken.
std::size_t HoldSearch::within_turns(const RegionHold& hold, std::size_t poses) const {
    const CellMachine& machine = *cell_.machine;
    const ToolArm arm = tool_arm(*machine.robot, machine.spindle, slow_tool_);
    std::size_t held = poses;
    for (const std::size_t axis : {std::size_t{3}, std::size_t{5}}) {
        const double low = arm.ranges[axis].min + arm.margin;
        const double high = arm.ranges[axis].max - arm.margin;
        const bool is_free = axis == 5 && hold.turns_freely;
        double min = std::numeric_limits<double>::infinity();
        double max = -min;
        for (std::size_t i = 0; i < held; ++i) {
            min = std::min(min, (*judge_.joints()[i])[axis]);
            max = std::max(max, (*judge_.joints()[i])[axis]);
            const double shift = full_turn * std::ceil((low - min) / full_turn - rounding);
            const bool fits = is_free ? max - min <= high - low : max + shift <= high + rounding;
            if (!fits) held = i;
        }
    }
    return held;
}

std::size_t HoldSearch::held_poses(const PoseRegion& region, RegionHold& hold) {
    MarginTally tally(false);
    judge_.judge(standing_, out_, region, region.poses.size(), hold, -rounding, tally);
    if (tally.score() >= -rounding) return region.poses.size() - 1;
    if (judge_.is_gantry()) return tally.worst_pose();
    return within_turns(hold, judge_.joints().back() ? region.poses.size() - 1 : tally.worst_pose());
}

std::size_t HoldSearch::fast_poses(std::span<const PathRun> runs, const SampledPath& path, std::size_t poses) const {
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
HeldPath HoldSearch::final_path(std::span<const PathRun> runs, const SampledPath& path, HeldPath held) {
    held.runs = path.runs_within(held.poses);
    if (held.runs == 0) return held;
    const PoseRegion region = first_poses(path.region, path.last[held.runs - 1] + 1);
    const std::size_t again = held_poses(region, held.hold);
    if (again < region.poses.size() - 1 || fast_poses(runs, path, again) < again) {
        held.runs = 0;
        return held;
    }
    if (judge_.is_gantry()) return held;
    held.joints.reserve(again);
    for (std::size_t i = 0; i < again; ++i) held.joints.push_back(*judge_.joints()[i]);
    return held;
}

HeldPath HoldSearch::longest(std::span<const PathRun> runs, const SampledPath& path) {
    const PoseRegion extremes = extreme_poses(path);
    HeldPath best;
    for (const bool is_second_round : {false, true}) {
        for (const RegionHold& candidate : candidates_) {
            RegionHold hold = candidate;
            const bool is_promising = judge_.is_gantry() || held_poses(extremes, hold) > 0;
            if (!is_promising) continue;
            // What no extreme pose refuses first; then what carries a part.
            const bool has_extremes = judge_.is_gantry() || judge_.joints().back().has_value();
            if (has_extremes == is_second_round) continue;
            hold = candidate;
            std::size_t poses = held_poses(path.region, hold);
            if (poses <= best.poses) continue;
            poses = fast_poses(runs, path, poses);
            if (poses <= best.poses) continue;
            best = {candidate, 0, poses, {}};
            if (poses == path.poses()) return final_path(runs, path, std::move(best));
        }
    }
    RegionHold hold = best.hold;
    MarginTally tally;
    judge_.judge(standing_, out_, path.region, std::min(best.poses + 1, path.region.poses.size()), hold, -rounding,
                 tally);
    describe_refusal(tally, path.region);
    return final_path(runs, path, std::move(best));
}

void HoldSearch::describe_refusal(const MarginTally& tally, const PoseRegion& region) {
    EnvelopeMargin margin;
    margin.check = refusing_check(tally);
    if (tally.of(margin.check).relative >= -rounding) {
        refusal_ = "joint speed: a cut would be slower than the least feed of the tool";
        return;
    }
    margin.margin = tally.of(margin.check).margin;
    margin.relative = tally.of(margin.check).relative;
    margin.pair = describe_pair(cell_, margin.check, tally.of(margin.check).pair);
    margin.pose.kind = PoseKind::tip;
    margin.pose.direction = operation_.direction;
    margin.pose.tip = region.poses[tally.of(margin.check).pose].tip;
    refusal_ = describe_margin(margin);
}

// Lowered speeds are whole twentieths of the one that is wanted, so that few lines are needed to state them.
double HoldSearch::speed_between(const SampledPath& path, const HeldPath& held, std::size_t first, std::size_t last,
                                 double wanted, double least) const {
    double speed = wanted;
    for (std::size_t i = first; i < last && !judge_.is_gantry(); ++i) {
        const double length = norm(path.region.poses[i + 1].tip - path.region.poses[i].tip);
        if (length == 0) continue;
        const JointRanges& ranges = cell_.machine->robot->ranges;
        speed = std::min(speed, followed_speed(ranges, held.joints[i], held.joints[i + 1], length));
    }
    if (speed >= wanted) return wanted;
    return std::max(std::floor(speed_steps * speed / wanted) / speed_steps * wanted, std::min(least, speed));
}

ProgramRun HoldSearch::run_of(const PathRun& run, const SampledPath& path, const HeldPath& held, std::size_t index,
                              std::size_t& lowered) const {
    const double least = cell_.machine->tools[operation_.tool].feed_min_mm_per_s;
    ProgramRun made;
    made.start = run.start;
    made.hole = run.hole;
    std::size_t at = path.first[index];
    if (!judge_.is_gantry()) made.start_joints = held.joints[at], made.end_joints = held.joints[path.last[index]];
    const std::size_t before = index > 0 ? path.last[index - 1] : at;
    made.link_speed = speed_between(path, held, before, at, operation_.link_feed, 0.5 * least);
    if (made.link_speed < operation_.link_feed) ++lowered;
    Vec3 tip = run.start;
    made.moves.reserve(run.moves.size());
    for (const PathMove& move : run.moves) {
        const std::size_t end = at + sample_steps(tip, move.tip);
        const double wanted = speed_of(move.kind);
        const double slowest = move.kind == MoveKind::cut ? least : 0.5 * least;
        const double speed = speed_between(path, held, at, end, wanted, slowest);
        if (speed < wanted) ++lowered;
        made.moves.push_back({move.tip, move.kind, move.is_rounded, speed});
        tip = move.tip;
        at = end;
    }
    return made;
}

ProgramSection HoldSearch::section(std::span<const PathRun> runs, const SampledPath& path, const HeldPath& held) const {
    ProgramSection section;
    section.tool = operation_.tool;
    section.direction = operation_.direction;
    section.out = out_;
    section.branch = held.hold.branch;
    section.tool_turn = held.hold.tool_turn;
    section.rpm = operation_.rpm;
    section.rounding = operation_.rounding;
    section.link_feed = operation_.link_feed;
    section.runs.reserve(held.runs);
    for (std::size_t r = 0; r < held.runs; ++r) {
        section.runs.push_back(run_of(runs[r], path, held, r, section.lowered_moves));
    }
    return section;
}

}  // namespace qchopper
