// Text and JSON from a value.

#include "app/report/cell/machine_reachability_report.h"

#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/report_json.h"
#include "base/text.h"
#include "base/units.h"
#include "cam/job/setup_fields.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

Json tightest_json(const ReachabilityMargin& margin) {
    const CheckRule& rule = rule_of(margin.check);
    return {{"check", rule.key},
            {"between", margin.pair},
            {"margin", margin.margin},
            {"unit", rule.unit},
            {"pose", has_pose(margin) ? Json(describe_pose(margin.pose)) : Json()}};
}

}  // namespace

std::string margin_word(const MachineReachability& reachability) {
    if (!reachability.is_arm_checked) return "-";
    const ReachabilityMargin& tightest = reachability.tightest();
    return tightest.pair + " " + fixed(tightest.margin, 1) + " " + rule_of(tightest.check).unit;
}

std::string place_word(const BlockPlacement& placement) {
    std::string text = "x " + fixed(placement.x, 0) + ", y " + fixed(placement.y, 0) + " mm";
    if (placement.turn != 0) text += ", turned " + fixed(degrees(placement.turn), 0) + " degrees";
    return text;
}

std::vector<std::string> lines(const std::string& piece, const MachineReachability& reachability) {
    if (!reachability.is_arm_checked) return {};
    std::vector<std::string> text{"Work envelope: " + describe_reachability(piece, reachability) + "."};
    text.push_back(counted(reachability.poses, "pose") + ", block at " + place_word(reachability.placement) +
                   " from the middle of the table; the tightest margin of each check:");
    std::vector<std::vector<std::string>> rows{{"check", "between", "margin", "unit", "pose"}};
    for (const ReachabilityMargin& margin : reachability.margins) {
        const CheckRule& rule = rule_of(margin.check);
        rows.push_back({rule.name, margin.pair, fixed(margin.margin, 1), rule.unit,
                        has_pose(margin) ? describe_pose(margin.pose) : ""});
    }
    for (const std::string& line : columns(rows)) text.push_back(line);
    return text;
}

Json json_of(const MachineReachability& reachability) {
    if (!reachability.is_arm_checked) return {{"arm_checked", false}, {"holds", true}};
    Json margins = Json::object();
    for (const ReachabilityMargin& margin : reachability.margins) margins[rule_of(margin.check).key] = margin.margin;
    return {{"arm_checked", true},
            {"holds", reachability.holds()},
            {"remedy", to_word(reachability.remedy)},
            {"tightest", tightest_json(reachability.tightest())},
            {"margins", margins},
            {"poses", reachability.poses},
            {"placement", json_of(reachability.placement)}};
}

}  // namespace qchopper
