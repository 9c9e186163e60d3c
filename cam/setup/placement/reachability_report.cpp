// Judges every region once more, to its end. A region that is not held is judged pose by pose as well: if each pose
// could be held alone, what is missing is one configuration for all. O(regions * poses) beside the search of the
// placement.

#include "cam/setup/placement/reachability_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/units.h"
#include "cam/setup/holder_clearance.h"
#include "cam/setup/placement/stated_angle.h"

namespace qchopper {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-9;  // of scores

// Fills the report of one place.
class ReachabilityReporter {
 public:
    ReachabilityReporter(const Setup& setup, const Cell& cell, const std::vector<OrientationPoses>& orientations,
                         PlaceScorer& scorer, const PlaceScore& place)
        : setup_(setup), cell_(cell), orientations_(orientations), scorer_(scorer), place_(place) {}

    MachineReachability report() {
        MachineReachability reachability;
        reachability.is_arm_checked = true;
        reachability.placement = place_.placement;
        reachability.placement.turn = stated_angle(place_.placement.turn);
        for (double& angle : reachability.placement.table_angles) angle = stated_angle(angle);
        add_table(reachability);
        for (std::size_t d = 0; d < orientations_.size(); ++d) {
            for (std::size_t r = 0; r < orientations_[d].regions.size(); ++r) add_region(d, r, reachability);
        }
        add_home(reachability);
        std::sort(reachability.margins.begin(), reachability.margins.end(),
                  [](const ReachabilityMargin& a, const ReachabilityMargin& b) { return a.check < b.check; });
        return reachability;
    }

 private:
    static void keep(ReachabilityMargin margin, MachineReachability& reachability) {
        const auto own = std::find_if(reachability.margins.begin(), reachability.margins.end(),
                                      [&](const ReachabilityMargin& m) { return m.check == margin.check; });
        if (own == reachability.margins.end()) {
            reachability.margins.push_back(std::move(margin));
        } else if (margin.relative < own->relative) {
            *own = std::move(margin);
        }
    }

    void add_table(MachineReachability& reachability) const {
        const double inside = inside_table(cell_, setup_.block.size, place_.placement);
        const CheckRule& rule = rule_of(PoseCheck::block_on_table);
        ReachabilityMargin margin{rule.check, inside, inside / rule.scale, "the block and the edge of the table", {}};
        margin.pose.kind = PoseKind::corner;
        keep(std::move(margin), reachability);
    }

    void keep_all(const MarginTally& tally, const auto& pose_of, MachineReachability& reachability) const {
        for (std::size_t c = 0; c < pose_checks; ++c) {
            const auto check = static_cast<PoseCheck>(c);
            const TightestMargin& tightest = tally.of(check);
            if (!std::isfinite(tightest.relative)) continue;
            keep({check, tightest.margin, tightest.relative, describe_pair(cell_, check, tightest.pair),
                  pose_of(tightest.pose)},
                 reachability);
        }
    }

    ReachabilityPose pose_at(std::size_t d, const MillingPose& pose, const StandingBlock& block,
                             double redundancy_angle, const std::optional<Joints>& joints) const {
        ReachabilityPose own{pose.kind, d, pose.tip, {}, {}, place_.placement.table_angle(d), redundancy_angle, joints};
        own.tip_in_cell = apply(block.setup_in_cell, pose.tip);
        own.tool_axis_in_cell = rotate(block.setup_in_cell, orientations_[d].tool_axis);
        return own;
    }

    void add_region(std::size_t d, std::size_t r, MachineReachability& reachability) {
        const OrientationPoses& orientation = orientations_[d];
        const PoseRegion& region = orientation.regions[r];
        const StandingBlock block = scorer_.standing(place_.placement, d);
        ArmPosture posture;
        if (d < place_.postures.size() && r < place_.postures[d].size()) posture = place_.postures[d][r];
        posture.turns_freely = posture.turns_freely && scorer_.judge().turns_by_axis_6();
        MarginTally tally;
        PoseJudge& judge = scorer_.judge();
        judge.judge(block, orientation.tool_axis, region, region.poses.size(), posture, nothing, tally);
        keep_all(
            tally,
            [&](std::size_t i) {
                const auto joints = i < judge.joints().size() ? judge.joints()[i] : std::nullopt;
                return pose_at(d, region.poses[i], block, posture.redundancy_angle, joints);
            },
            reachability);
        reachability.poses += region.poses.size();
        const bool holds = tally.score() >= -rounding;
        if (judge.is_gantry()) return;
        reachability.regions.push_back(
            {d, region.poses.size(), holds, posture.configuration, posture.redundancy_angle, tally.score()});
        add_one_configuration(d, region, block, posture, holds, reachability);
    }

    // If every pose of a region that is not held could be held alone, it is the configuration that must change on the
    // way.
    void add_one_configuration(std::size_t d, const PoseRegion& region, const StandingBlock& block,
                               const ArmPosture& posture, bool holds, MachineReachability& reachability) {
        const CheckRule& rule = rule_of(PoseCheck::one_configuration);
        std::size_t held = region.poses.size();
        std::size_t first_refused = 0;
        if (!holds) {
            held = 0;
            for (std::size_t i = 0; i < region.poses.size(); ++i) {
                const PoseRegion alone{{{region.poses[i].kind, region.poses[i].tip, 0}}, 1};
                if (!is_held_by_any(d, alone, block)) return;
                if (is_held(d, alone, block, posture)) {
                    ++held;
                } else if (held == i) {
                    first_refused = i;
                }
            }
        }
        const double share = 100.0 * static_cast<double>(held) / static_cast<double>(region.poses.size());
        const double margin = share - rule.needed;
        keep({rule.check, margin, margin / rule.scale,
              "an arm configuration that holds " + std::to_string(held) + " of " + std::to_string(region.poses.size()) +
                  " poses",
              pose_at(d, region.poses[first_refused], block, posture.redundancy_angle, std::nullopt)},
             reachability);
    }

    bool is_held(std::size_t d, const PoseRegion& alone, const StandingBlock& block, ArmPosture posture) {
        MarginTally tally(false);
        scorer_.judge().judge(block, orientations_[d].tool_axis, alone, 1, posture, 0, tally);
        return tally.score() >= -rounding;
    }

    bool is_held_by_any(std::size_t d, const PoseRegion& alone, const StandingBlock& block) {
        const bool is_free = scorer_.judge().turns_by_axis_6();
        for (const ArmConfiguration& configuration : all_configurations()) {
            for (int turn = 0; turn < (is_free ? 1 : redundancy_angles); ++turn) {
                if (is_held(d, alone, block, {configuration, turn * 10 * degree, is_free})) return true;
            }
        }
        return false;
    }

    // Where the table stands at home, the first direction first, and where it comes to from 0 on the way to any.
    std::vector<double> home_angles() const {
        const BlockPlacement& placement = place_.placement;
        std::vector<double> angles{placement.table_angle(0)};
        for (std::size_t d = 0; d < orientations_.size() && scorer_.has_rotary(); ++d) {
            const double to = std::remainder(placement.table_angle(d), 2 * std::numbers::pi);
            const std::vector<double> own = judged_table_angles(0, to);
            angles.insert(angles.end(), own.begin(), own.end());
        }
        return angles;
    }

    void add_home(MachineReachability& reachability) {
        const Pose on_table = setup_in_table(place_.placement, setup_.spoil);
        const std::vector<double> angles = home_angles();
        const CellMachine& machine = *cell_.machine;
        const CuttingTool& own_tool = longest_tool(machine.tools);
        for (std::size_t t = 0; t < machine.tools.size(); ++t) {
            PoseJudge& judge = scorer_.home_judges()[t];
            ReachabilityPose pose;
            pose.kind = &machine.tools[t] == &own_tool ? PoseKind::home : PoseKind::tool_change;
            if (machine.robot) {
                const ToolArm arm = tool_arm(*machine.robot, machine.spindle, machine.tools[t]);
                const Pose tip = arm.base_in_cell * (forward(arm.geometry, machine.start.joints) * arm.tip_in_flange);
                pose.tip_in_cell = tip.shift;
                pose.tool_axis_in_cell = -Vec3{tip.row[0].z, tip.row[1].z, tip.row[2].z};
                pose.joints = machine.start.joints;
            } else {
                pose.tip_in_cell = machine.start.tip;
                pose.tool_axis_in_cell = {0, 0, 1};
            }
            pose.tip = pose.tip_in_cell;
            for (const double angle : angles) {
                MarginTally tally;
                judge.judge_home(scorer_.judge().standing(table_in_cell(cell_, angle) * on_table, setup_.block_box()),
                                 tally);
                pose.table_angle = angle;
                keep_all(
                    tally, [&](std::size_t) { return pose; }, reachability);
            }
            ++reachability.poses;
        }
    }

    const Setup& setup_;
    const Cell& cell_;
    const std::vector<OrientationPoses>& orientations_;
    PlaceScorer& scorer_;
    const PlaceScore& place_;
};

}  // namespace

MachineReachability reachability_at(const Setup& setup, const Cell& cell,
                                    const std::vector<OrientationPoses>& orientations, PlaceScorer& scorer,
                                    const PlaceScore& place) {
    return ReachabilityReporter(setup, cell, orientations, scorer, place).report();
}

}  // namespace qchopper
