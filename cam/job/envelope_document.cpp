// One function per object of the JSON.

#include "cam/job/envelope_document.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.h"
#include "base/json.h"

namespace qchopper {
namespace {

using namespace json_values;

constexpr const char* format_name = "qchopper envelope";
constexpr unsigned schema_version = 1;
constexpr double rounding = 1e-6;  // of all numbers but the placement

double rounded(double value) {
    return std::round(value * 1e6) / 1e6 + 0.0;  // no -0
}

double rounded_degrees(double radians) {
    return rounded(radians * 180 / std::numbers::pi);
}

Json from_rounded(Vec3 v) {
    return from_vector({rounded(v.x), rounded(v.y), rounded(v.z)});
}

const char* key_of(PoseKind kind) {
    constexpr const char* keys[] = {"tip", "corner", "edge", "retract", "home", "tool_change"};
    return keys[static_cast<std::size_t>(kind)];
}

const char* key_of(Remedy remedy) {
    constexpr const char* keys[] = {"none",        "tool_turn", "branch",     "table_turn",
                                    "block_shift", "base",      "directions", "cut"};
    return keys[static_cast<std::size_t>(remedy)];
}

Json from_joints(const std::optional<Joints>& joints) {
    if (!joints) return nullptr;
    Json list = Json::array();
    for (const double joint : *joints) list.push_back(rounded_degrees(joint));
    return list;
}

Json from_pose(const ReachabilityPose& pose) {
    const bool has_direction = pose.kind != PoseKind::home && pose.kind != PoseKind::tool_change;
    return {{"kind", key_of(pose.kind)},
            {"direction", has_direction ? Json(pose.orientation + 1) : Json(nullptr)},
            {"tip", has_direction ? from_rounded(pose.tip) : Json(nullptr)},
            {"tip_in_cell", from_rounded(pose.tip_in_cell)},
            {"out_in_cell", from_rounded(pose.tool_axis_in_cell)},
            {"table_angle_deg", rounded_degrees(pose.table_angle)},
            {"tool_turn_deg", rounded_degrees(pose.redundancy_angle)},
            {"joints_deg", from_joints(pose.joints)}};
}

Json from_margin(const ReachabilityMargin& margin) {
    const CheckRule& rule = rule_of(margin.check);
    return {{"check", rule.key},
            {"name", rule.name},
            {"unit", rule.unit},
            {"measured", rounded(margin.margin + rule.needed)},
            {"needed", rule.needed},
            {"margin", rounded(margin.margin)},
            {"relative_margin", rounded(margin.relative)},
            {"holds", is_held(margin)},
            {"between", margin.pair},
            {"pose", has_pose(margin) ? from_pose(margin.pose) : Json(nullptr)}};
}

Json from_region(const RegionReachability& region) {
    return {{"direction", region.orientation + 1},
            {"poses", region.poses},
            {"holds", region.holds},
            {"back", region.configuration.is_back},
            {"elbow_negative", region.configuration.is_elbow_negative},
            {"wrist_flipped", region.configuration.is_wrist_flipped},
            {"tool_turn_deg", rounded_degrees(region.redundancy_angle)},
            {"relative_margin", rounded(region.relative)}};
}

Json from_placement(const BlockPlacement& placement) {
    return {{"x", placement.x},
            {"y", placement.y},
            {"turn_rad", placement.turn},
            {"table_angles_rad", placement.table_angles}};
}

// Every verdict must be that of its margin.
bool are_all_held(const Json& checks) {
    bool all_held = true;
    for (const Json& check : checks) {
        const double margin = real(check, "margin");
        const bool holds = truth(check, "holds");
        if (holds ? margin < -rounding : margin > rounding) throw wrong("holds", "contradicts the margin");
        all_held = all_held && holds;
    }
    return all_held;
}

ReachabilitySummary to_summary(const Json& json) {
    if (text(json, "format") != format_name) throw wrong("format", "is not a qchopper envelope");
    if (whole<std::uint32_t>(json, "schema") != schema_version) {
        throw wrong("schema", "is not " + std::to_string(schema_version) + ", the one that this program reads");
    }
    ReachabilitySummary summary{text(json, "piece"), truth(json, "arm_checked"), truth(json, "holds"), {}};
    const Json& placement = member(json, "placement");
    summary.placement = {real(placement, "x"), real(placement, "y"), real(placement, "turn_rad"), {}};
    for (const Json& angle : items(placement, "table_angles_rad")) {
        if (!angle.is_number()) throw wrong("table_angles_rad", "is not a list of numbers");
        summary.placement.table_angles.push_back(angle.get<double>());
    }
    const Json& checks = items(json, "checks");
    if (checks.empty() == summary.is_arm_checked) throw wrong("checks", "contradicts arm_checked");
    if (are_all_held(checks) != summary.holds) throw wrong("holds", "contradicts the checks");
    return summary;
}

}  // namespace

std::string envelope_document(const JobInput& input) {
    const MachineReachability& reachability = input.machine_reachability;
    Json checks = Json::array();
    for (const ReachabilityMargin& margin : reachability.margins) checks.push_back(from_margin(margin));
    Json regions = Json::array();
    for (const RegionReachability& region : reachability.regions) regions.push_back(from_region(region));
    const Json json{
        {"format", format_name},
        {"schema", schema_version},
        {"piece", input.piece.name},
        {"cell", {{"name", input.cell.name}, {"id", input.cell.id}}},
        {"arm_checked", reachability.is_arm_checked},
        {"holds", reachability.holds()},
        {"summary", describe_reachability(input.piece.name, reachability)},
        {"cure", key_of(reachability.remedy)},
        {"tightest", reachability.is_arm_checked ? Json(rule_of(reachability.tightest().check).key) : Json(nullptr)},
        {"placement", from_placement(input.setup.placement)},
        {"poses", reachability.poses},
        {"places", reachability.places},
        {"checks", checks},
        {"regions", regions}};
    return written(json);
}

ReachabilitySummary read_envelope_document(std::string_view text, const std::string& source) {
    try {
        const Json json = parsed(text);
        ReachabilitySummary summary = to_summary(json);
        check_form(json, text);
        return summary;
    } catch (const std::runtime_error& error) {
        throw InputError(InputFault::mesh, source + ": envelope.json: " + error.what(),
                         "write the job again with qchopper prepare");
    }
}

}  // namespace qchopper
