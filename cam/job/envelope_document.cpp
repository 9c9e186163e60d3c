// One table per object of the JSON. Of what is written, the reader gets what it compares. O(checks).

#include "cam/job/envelope_document.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/json_fields.h"
#include "base/json_schema.h"
#include "base/units.h"
#include "cam/job/document_schemas.h"
#include "cam/job/setup_fields.h"

namespace qchopper {
namespace {

using namespace json_values;

constexpr double rounding = 1e-6;  // of all numbers but the placement

double rounded(double value) {
    return std::round(value * 1e6) / 1e6 + 0.0;  // no -0
}

double rounded_degrees(double angle) {
    return rounded(degrees(angle));
}

Vec3 rounded(Vec3 v) {
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

const char* key_of(PoseKind kind) {
    constexpr const char* keys[] = {"tip", "corner", "edge", "retract", "home", "tool_change"};
    return keys[static_cast<std::size_t>(kind)];
}

Joints rounded_degrees(Joints joints) {
    for (double& joint : joints) joint = rounded_degrees(joint);
    return joints;
}

// The verdict of a margin stands beside it.
struct StatedMargin {
    ReachabilityMargin margin;
    bool holds = true;
};

struct EnvelopeDocument {
    ReachabilitySummary summary;
    std::vector<StatedMargin> checks;
    const JobInput* input = nullptr;  // of one that is written
};

}  // namespace

// Of what is written alone.
template <class V, Of<ReachabilityPose> T>
void fields(V& v, T& pose) {
    const bool has_orientation = pose.kind != PoseKind::home && pose.kind != PoseKind::tool_change;
    v("kind", key_of(pose.kind));
    v("orientation", has_orientation ? std::optional(pose.orientation + 1) : std::nullopt);
    v("tip", has_orientation ? std::optional(rounded(pose.tip)) : std::nullopt);
    v("tip_in_cell", rounded(pose.tip_in_cell));
    v("tool_axis_in_cell", rounded(pose.tool_axis_in_cell));
    v("table_angle_deg", rounded_degrees(pose.table_angle));
    v("tool_turn_deg", rounded_degrees(pose.redundancy_angle));
    v("joints_deg", pose.joints ? std::optional(rounded_degrees(*pose.joints)) : std::nullopt);
}

template <class V, Of<RegionReachability> T>
void fields(V& v, T& region) {
    v("orientation", region.orientation + 1);
    v("poses", region.poses);
    v("holds", region.holds);
    v("back", region.configuration.is_back);
    v("elbow_negative", region.configuration.is_elbow_negative);
    v("wrist_flipped", region.configuration.is_wrist_flipped);
    v("tool_turn_deg", rounded_degrees(region.redundancy_angle));
    v("relative_margin", rounded(region.relative));
}

namespace {

template <class V, Of<StatedMargin> T>
void fields(V& v, T& check) {
    auto& margin = check.margin;
    const CheckRule& rule = rule_of(margin.check);
    v.written("check", [&] { return rule.key; });
    v.written("name", [&] { return rule.name; });
    v.written("unit", [&] { return rule.unit; });
    v.written("measured", [&] { return rounded(margin.margin + rule.needed); });
    v.written("needed", [&] { return rule.needed; });
    v.converted(
        "margin", margin.margin, [](double mm) { return rounded(mm); }, [](double mm) { return mm; });
    v.written("relative_margin", [&] { return rounded(margin.relative); });
    v("holds", check.holds);
    v.check(check.holds ? margin.margin >= -rounding : margin.margin <= rounding, "holds", "contradicts the margin");
    v.written("between", [&] { return margin.pair; });
    v.written("pose", [&] { return has_pose(margin) ? std::optional(margin.pose) : std::nullopt; });
}

template <class V, Of<EnvelopeDocument> T>
void fields(V& v, T& document) {
    auto& summary = document.summary;
    const auto reachability = [&]() -> const MachineReachability& { return document.input->machine_reachability; };
    v.constant("format", "qchopper envelope", "is not a qchopper envelope");
    v.version("schema", 2);
    v("piece", summary.piece);
    v.object("cell", [&](auto& cell) {
        cell.written("name", [&] { return document.input->cell.name; });
        cell.written("id", [&] { return document.input->cell.id; });
    });
    v("arm_checked", summary.is_arm_checked);
    v("holds", summary.holds);
    v.written("summary", [&] { return describe_reachability(summary.piece, reachability()); });
    v.written("remedy", [&] { return to_word(reachability().remedy); });
    v.written("tightest", [&] {
        return summary.is_arm_checked ? std::optional<std::string>(rule_of(reachability().tightest().check).key)
                                      : std::nullopt;
    });
    v("placement", summary.placement);
    v.written("poses", [&] { return reachability().poses; });
    v.written("places", [&] { return reachability().places; });
    v("checks", document.checks);
    v.check(document.checks.empty() != summary.is_arm_checked, "checks", "contradicts arm_checked");
    const auto holds = [](const StatedMargin& check) { return check.holds; };
    v.check(std::all_of(document.checks.begin(), document.checks.end(), holds) == summary.holds, "holds",
            "contradicts the checks");
    v.written("regions", [&] { return reachability().regions; });
}

}  // namespace

std::string envelope_document(const JobInput& input) {
    const MachineReachability& reachability = input.machine_reachability;
    EnvelopeDocument document;
    document.summary = {input.piece.name, reachability.is_arm_checked, reachability.holds(), input.setup.placement};
    for (const ReachabilityMargin& margin : reachability.margins) document.checks.push_back({margin, is_held(margin)});
    document.input = &input;
    return to_document(document);
}

std::string envelope_schema() {
    return schema_of_document<EnvelopeDocument>("work envelope of a job of qchopper");
}

ReachabilitySummary read_envelope_document(std::string_view text, const std::string& source) {
    try {
        EnvelopeDocument document;
        from_document(text, document);
        return document.summary;
    } catch (const std::runtime_error& error) {
        throw InputError(InputFault::mesh, source + ": envelope.json: " + error.what(),
                         "write the job again with qchopper prepare");
    }
}

}  // namespace qchopper
