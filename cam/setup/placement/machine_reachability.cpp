// Tables of checks and words.

#include "cam/setup/placement/machine_reachability.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/text.h"

namespace qchopper {
namespace {

constexpr double rounding = 1e-9;  // of relative margins

constexpr std::array<CheckRule, pose_checks> rules{{
    {PoseCheck::block_on_table, "block_on_table", "block on the table", "mm", 0, 50, false},
    {PoseCheck::travel, "travel", "travel", "mm", 0, 50, true},
    {PoseCheck::reach, "reach", "reach", "mm", 0, 100, true},
    {PoseCheck::joint_limit, "joint_limit", "joint limit", "deg", 3, 10, true},
    {PoseCheck::cable, "cable", "cable limit", "deg", 3, 10, true},
    {PoseCheck::shoulder, "shoulder", "singularity of the shoulder", "mm", 100, 100, true},
    {PoseCheck::elbow, "elbow", "singularity of the elbow", "%", 2, 2, true},
    {PoseCheck::wrist, "wrist", "singularity of the wrist", "deg", 8, 10, true},
    {PoseCheck::joint_speed, "joint_speed", "joint speed at the feed", "deg/s", 0, 50, true},
    {PoseCheck::axis_step, "axis_step", "step of an axis from pose to pose", "deg", 0, 45, false},
    {PoseCheck::one_configuration, "one_configuration", "one arm configuration", "%", 100, 100, false},
    {PoseCheck::arm_to_block, "arm_to_block", "arm to block", "mm", 10, 50, true},
    {PoseCheck::arm_to_table, "arm_to_table", "arm to table", "mm", 10, 50, true},
    {PoseCheck::arm_to_floor, "arm_to_floor", "arm to floor", "mm", 10, 50, true},
    {PoseCheck::arm_to_obstacle, "arm_to_obstacle", "arm to obstacle", "mm", 10, 50, true},
    {PoseCheck::arm_to_arm, "arm_to_arm", "arm to itself", "mm", 10, 50, true},
    {PoseCheck::tool_to_block, "tool_to_block", "tool to block at home", "mm", 10, 50, true},
    {PoseCheck::holder_to_block, "holder_to_block", "holder and spindle to the spoil layer", "mm", -0.01, 50, false},
    {PoseCheck::tool_to_table, "tool_to_table", "tool, holder and spindle to table", "mm", 1, 50, false},
    {PoseCheck::tool_to_floor, "tool_to_floor", "tool, holder and spindle to floor", "mm", 1, 50, false},
    {PoseCheck::tool_to_obstacle, "tool_to_obstacle", "tool, holder and spindle to obstacle", "mm", 10, 50, true},
    {PoseCheck::tool_to_arm, "tool_to_arm", "tool, holder and spindle to arm", "mm", 10, 50, true},
}};

constexpr bool is_in_order() {
    for (std::size_t i = 0; i < rules.size(); ++i) {
        if (static_cast<std::size_t>(rules[i].check) != i) return false;
    }
    return true;
}
static_assert(is_in_order());

std::string tenths(double value) {
    return significant(std::round(value * 10) / 10, 15);
}

const char* describe(PoseKind kind) {
    constexpr std::array<const char*, 6> words{
        "tip on the piece", "corner of the block", "edge of the block", "tip above the block", "home", "tool change"};
    return words[static_cast<std::size_t>(kind)];
}

}  // namespace

const char* describe(Remedy remedy) {
    constexpr std::array<const char*, 8> words{"none",
                                               "turn the tool about its axis",
                                               "take another arm configuration",
                                               "turn the table",
                                               "shift or turn the block on the table",
                                               "lay the piece on another base",
                                               "take other tool orientations",
                                               "cut the piece otherwise"};
    return words[static_cast<std::size_t>(remedy)];
}

const char* to_word(Remedy remedy) {
    constexpr std::array<const char*, 8> words{"none",        "tool_turn", "arm_configuration", "table_turn",
                                               "block_shift", "base",      "orientations",      "cut"};
    return words[static_cast<std::size_t>(remedy)];
}

Pose tip_frame(Vec3 tip, Vec3 tool_axis, double turn) {
    const double st = std::hypot(tool_axis.x, tool_axis.y);
    const double ct = tool_axis.z;
    const double ca = st > 1e-12 ? -tool_axis.x / st : 1;
    const double sa = st > 1e-12 ? -tool_axis.y / st : 0;
    const Pose leaning{{Vec3{-ca * ct, -sa, ca * st}, Vec3{-sa * ct, ca, sa * st}, Vec3{-st, 0, -ct}}, tip};
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    return leaning * Pose{{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}, {}};
}

const CheckRule& rule_of(PoseCheck check) {
    return rules[static_cast<std::size_t>(check)];
}

bool is_held(const ReachabilityMargin& margin) {
    return margin.relative >= -rounding;
}

std::string describe_pose(const ReachabilityPose& pose) {
    std::string text = describe(pose.kind);
    if (pose.kind == PoseKind::home || pose.kind == PoseKind::tool_change) return text;
    return text + " at " + tenths(pose.tip.x) + ", " + tenths(pose.tip.y) + ", " + tenths(pose.tip.z) +
           " mm, orientation " + std::to_string(pose.orientation + 1);
}

std::string describe_margin(const ReachabilityMargin& margin) {
    const CheckRule& rule = rule_of(margin.check);
    const std::string text =
        std::string(rule.name) + ", " + margin.pair + ": " + tenths(margin.margin) + " " + rule.unit;
    return has_pose(margin) ? text + " (" + describe_pose(margin.pose) + ")" : text;
}

bool MachineReachability::holds() const {
    return std::all_of(margins.begin(), margins.end(), is_held);
}

const ReachabilityMargin& MachineReachability::tightest() const {
    assert(!margins.empty());
    const bool all_hold = holds();
    const auto key = [&](const ReachabilityMargin& margin) {
        const bool counts = all_hold ? rule_of(margin.check).is_placed : margin.relative < -rounding;
        return std::pair(!counts, margin.relative);
    };
    return *std::min_element(margins.begin(), margins.end(),
                             [&](const ReachabilityMargin& a, const ReachabilityMargin& b) { return key(a) < key(b); });
}

std::string describe_reachability(const std::string& piece, const MachineReachability& reachability) {
    if (!reachability.is_arm_checked) return "piece " + piece + ": arm not checked";
    const std::string tightest = describe_margin(reachability.tightest());
    if (!reachability.holds()) {
        return "piece " + piece + " cannot be carved: " + tightest + "; to do: " + describe(reachability.remedy);
    }
    std::string text = "piece " + piece + " can be carved, tightest: " + tightest;
    if (reachability.remedy != Remedy::none) text += std::string("; needed: ") + describe(reachability.remedy);
    return text;
}

}  // namespace qchopper
