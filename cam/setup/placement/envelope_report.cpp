// Judges every region once more, to its end. A region that is not held is judged pose by pose as well: if each pose
// could be held alone, what is missing is one branch for all.

#include "cam/setup/placement/envelope_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "cam/setup/holder_limit.h"

namespace qchopper {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double nothing = -std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-9;  // of scores

// Fills the report of one place.
class EnvelopeReporter {
 public:
    EnvelopeReporter(const Setup& setup, const Cell& cell, const std::vector<DirectionPoses>& directions,
                     PlaceScorer& scorer, const PlaceScore& place)
        : setup_(setup), cell_(cell), directions_(directions), scorer_(scorer), place_(place) {}

    WorkEnvelope report() {
        WorkEnvelope envelope;
        envelope.is_arm_checked = true;
        envelope.placement = place_.placement;
        add_table(envelope);
        for (std::size_t d = 0; d < directions_.size(); ++d) {
            for (std::size_t r = 0; r < directions_[d].regions.size(); ++r) add_region(d, r, envelope);
        }
        add_home(envelope);
        std::sort(envelope.margins.begin(), envelope.margins.end(),
                  [](const EnvelopeMargin& a, const EnvelopeMargin& b) { return a.check < b.check; });
        return envelope;
    }

 private:
    static void keep(EnvelopeMargin margin, WorkEnvelope& envelope) {
        const auto own = std::find_if(envelope.margins.begin(), envelope.margins.end(),
                                      [&](const EnvelopeMargin& m) { return m.check == margin.check; });
        if (own == envelope.margins.end()) {
            envelope.margins.push_back(std::move(margin));
        } else if (margin.relative < own->relative) {
            *own = std::move(margin);
        }
    }

    void add_table(WorkEnvelope& envelope) const {
        const double inside = inside_table(cell_, setup_.block.size, place_.placement);
        const CheckRule& rule = rule_of(PoseCheck::block_on_table);
        EnvelopeMargin margin{rule.check, inside, inside / rule.scale, "the block and the edge of the table", {}};
        margin.pose.kind = PoseKind::corner;
        keep(std::move(margin), envelope);
    }

    void keep_all(const MarginTally& tally, const auto& pose_of, WorkEnvelope& envelope) const {
        for (std::size_t c = 0; c < pose_checks; ++c) {
            const auto check = static_cast<PoseCheck>(c);
            const TightestMargin& tightest = tally.of(check);
            if (!std::isfinite(tightest.relative)) continue;
            keep({check, tightest.margin, tightest.relative, describe_pair(cell_, check, tightest.pair),
                  pose_of(tightest.pose)},
                 envelope);
        }
    }

    EnvelopePose pose_at(std::size_t d, const CarvingPose& pose, const StandingBlock& block, double tool_turn,
                         const std::optional<Joints>& joints) const {
        EnvelopePose own{pose.kind, d, pose.tip, {}, {}, place_.placement.table_angle(d), tool_turn, joints};
        own.tip_in_cell = apply(block.setup_in_cell, pose.tip);
        own.out_in_cell = rotate(block.setup_in_cell, directions_[d].out);
        return own;
    }

    void add_region(std::size_t d, std::size_t r, WorkEnvelope& envelope) {
        const DirectionPoses& direction = directions_[d];
        const PoseRegion& region = direction.regions[r];
        const StandingBlock block = scorer_.standing(place_.placement, d);
        RegionHold hold;
        if (d < place_.holds.size() && r < place_.holds[d].size()) hold = place_.holds[d][r];
        hold.turns_freely = hold.turns_freely && scorer_.judge().turns_by_axis_6();
        MarginTally tally;
        PoseJudge& judge = scorer_.judge();
        judge.judge(block, direction.out, region, region.poses.size(), hold, nothing, tally);
        keep_all(
            tally,
            [&](std::size_t i) {
                const auto joints = i < judge.joints().size() ? judge.joints()[i] : std::nullopt;
                return pose_at(d, region.poses[i], block, hold.tool_turn, joints);
            },
            envelope);
        envelope.poses += region.poses.size();
        const bool holds = tally.score() >= -rounding;
        if (judge.is_gantry()) return;
        envelope.regions.push_back({d, region.poses.size(), holds, hold.branch, hold.tool_turn, tally.score()});
        add_one_branch(d, region, block, hold, holds, envelope);
    }

    // If every pose of a region that is not held could be held alone, it is the branch that must change on the way.
    void add_one_branch(std::size_t d, const PoseRegion& region, const StandingBlock& block, const RegionHold& hold,
                        bool holds, WorkEnvelope& envelope) {
        const CheckRule& rule = rule_of(PoseCheck::one_branch);
        std::size_t held = region.poses.size();
        std::size_t first_refused = 0;
        if (!holds) {
            held = 0;
            for (std::size_t i = 0; i < region.poses.size(); ++i) {
                const PoseRegion alone{{{region.poses[i].kind, region.poses[i].tip, 0}}, 1};
                if (!is_held_by_any(d, alone, block)) return;
                if (is_held(d, alone, block, hold)) {
                    ++held;
                } else if (held == i) {
                    first_refused = i;
                }
            }
        }
        const double share = 100.0 * static_cast<double>(held) / static_cast<double>(region.poses.size());
        const double margin = share - rule.needed;
        keep({rule.check, margin, margin / rule.scale,
              "a branch that holds " + std::to_string(held) + " of " + std::to_string(region.poses.size()) + " poses",
              pose_at(d, region.poses[first_refused], block, hold.tool_turn, std::nullopt)},
             envelope);
    }

    bool is_held(std::size_t d, const PoseRegion& alone, const StandingBlock& block, RegionHold hold) {
        MarginTally tally(false);
        scorer_.judge().judge(block, directions_[d].out, alone, 1, hold, 0, tally);
        return tally.score() >= -rounding;
    }

    bool is_held_by_any(std::size_t d, const PoseRegion& alone, const StandingBlock& block) {
        const bool is_free = scorer_.judge().turns_by_axis_6();
        for (const ArmBranch& branch : all_branches()) {
            for (int turn = 0; turn < (is_free ? 1 : tool_turns); ++turn) {
                if (is_held(d, alone, block, {branch, turn * 10 * degree, is_free})) return true;
            }
        }
        return false;
    }

    void add_home(WorkEnvelope& envelope) {
        const StandingBlock block = scorer_.standing(place_.placement, 0);
        const CellMachine& machine = *cell_.machine;
        const CarvingTool& own_tool = longest_tool(machine.tools);
        for (std::size_t t = 0; t < machine.tools.size(); ++t) {
            PoseJudge& judge = scorer_.home_judges()[t];
            MarginTally tally;
            judge.judge_home(block, tally);
            EnvelopePose pose;
            pose.kind = &machine.tools[t] == &own_tool ? PoseKind::home : PoseKind::tool_change;
            pose.table_angle = place_.placement.table_angle(0);
            if (machine.robot) {
                const ToolArm arm = tool_arm(*machine.robot, machine.spindle, machine.tools[t]);
                const Pose tip = arm.base_in_cell * (forward(arm.geometry, machine.start.joints) * arm.tip_in_flange);
                pose.tip_in_cell = tip.shift;
                pose.out_in_cell = -Vec3{tip.row[0].z, tip.row[1].z, tip.row[2].z};
                pose.joints = machine.start.joints;
            } else {
                pose.tip_in_cell = machine.start.tip;
                pose.out_in_cell = {0, 0, 1};
            }
            pose.tip = pose.tip_in_cell;
            keep_all(
                tally, [&](std::size_t) { return pose; }, envelope);
            ++envelope.poses;
        }
    }

    const Setup& setup_;
    const Cell& cell_;
    const std::vector<DirectionPoses>& directions_;
    PlaceScorer& scorer_;
    const PlaceScore& place_;
};

}  // namespace

WorkEnvelope envelope_at(const Setup& setup, const Cell& cell, const std::vector<DirectionPoses>& directions,
                         PlaceScorer& scorer, const PlaceScore& place) {
    return EnvelopeReporter(setup, cell, directions, scorer, place).report();
}

}  // namespace qchopper
