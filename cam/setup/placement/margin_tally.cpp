// Comparisons and words.

#include "cam/setup/placement/margin_tally.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace qchopper {
namespace {

constexpr double rounding = 1e-9;  // of relative margins

const char* word(std::uint16_t part) {
    constexpr std::array<const char*, 4> words{"link", "spindle", "holder", "tool"};
    return words[std::min<std::size_t>(part, 3)];
}

// In whole steps, so that margins which are equal but for their last digits, as those of mirrored poses are, are ties
// on every machine: those digits depend on whether sines are computed with fused operations.
double relative_margin(const CheckRule& rule, double measured) {
    return std::round((measured - rule.needed) / rule.scale / rounding) * rounding;
}

}  // namespace

bool MarginTally::wants(PoseCheck check, double least) const {
    const CheckRule& rule = rule_of(check);
    const double relative = relative_margin(rule, least);
    if (keeps_all_) return relative < of(check).relative;
    return relative < (rule.is_placed ? score_ : -rounding);
}

void MarginTally::add(PoseCheck check, double measured, MarginPair pair) {
    const CheckRule& rule = rule_of(check);
    const double relative = relative_margin(rule, measured);
    const bool is_new_refusal = !rule.is_placed && relative < -rounding && !is_refused_;
    if (is_new_refusal) is_refused_ = true;
    if (is_new_refusal || (rule.is_placed && relative < score_)) worst_pose_ = pose_;
    if (rule.is_placed) score_ = std::min(score_, relative);
    TightestMargin& kept = tightest_[static_cast<std::size_t>(check)];
    if (!(relative < kept.relative)) return;
    kept = {measured - rule.needed, relative, pair, pose_};
}

std::string describe_pair(const Cell& cell, PoseCheck check, MarginPair pair) {
    const std::string first = std::to_string(pair.first);
    const std::string link = "link " + first;
    const std::string part = word(pair.first);
    const auto obstacle = [&] { return "the obstacle " + cell.machine->obstacles[pair.second].name; };
    switch (check) {
        case PoseCheck::joint_limit:
            return "axis " + first + " and its " + (pair.second == 0 ? "lower" : "upper") + " limit";
        case PoseCheck::cable:
            return "axis " + first + " and its cables, " + (pair.second == 0 ? "lower" : "upper") + " limit";
        case PoseCheck::joint_speed:
            return "axis " + first + " and its largest speed";
        case PoseCheck::travel:
            if (pair.first > 2) return "a gantry and a tilted tool";
            return std::string("the tip and the ") + (pair.second == 0 ? "-" : "+") + "xyz"[pair.first] +
                   " end of the travel";
        case PoseCheck::arm_to_block:
            return link + " and the block";
        case PoseCheck::arm_to_table:
            return link + " and the table";
        case PoseCheck::arm_to_floor:
            return link + " and the floor";
        case PoseCheck::arm_to_obstacle:
            return link + " and " + obstacle();
        case PoseCheck::arm_to_arm:
            return "link " + std::to_string(pair.second) + " and " + link;
        case PoseCheck::tool_to_block:
            return part + " and the block";
        case PoseCheck::holder_to_block:
            return "holder or spindle and the spoil layer";
        case PoseCheck::tool_to_table:
            return part + " and the table";
        case PoseCheck::tool_to_floor:
            return part + " and the floor";
        case PoseCheck::tool_to_obstacle:
            return part + " and " + obstacle();
        case PoseCheck::tool_to_arm:
            return part + " and link " + std::to_string(pair.second);
        case PoseCheck::block_on_table:
            return "the block and the edge of the table";
        case PoseCheck::reach:
            return "the wrist centre and the reach of the arm";
        case PoseCheck::shoulder:
            return "the wrist centre and axis 1";
        case PoseCheck::elbow:
            return "upper arm and forearm in line";
        case PoseCheck::wrist:
            return "axes 4 and 6 in line";
        case PoseCheck::axis_step:
            return "an axis between two poses beside each other";
        case PoseCheck::one_configuration:
            return "the poses of a region";
    }
    return {};
}

}  // namespace qchopper
