// Text and JSON from values.

#include "app/report/joint_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/report_json.h"
#include "base/text.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

std::string name_list(const std::vector<std::size_t>& indices, const ProjectJoints& of) {
    std::string names;
    for (const std::size_t i : indices) names += (names.empty() ? "" : ", ") + of.pieces[i];
    return names;
}

Json name_json(const std::vector<std::size_t>& indices, const ProjectJoints& of) {
    return list_of(indices, [&](std::size_t i) { return Json(of.pieces[i]); });
}

const char* fault_word(JointFault fault) {
    switch (fault) {
        case JointFault::none:
            return "none";
        case JointFault::can_be_swapped:
            return "can_be_swapped";
        case JointFault::can_be_turned:
            return "can_be_turned";
        case JointFault::no_dowel:
            return "no_dowel";
    }
    return "none";
}

std::string step_line(const AssemblyStep& step, std::size_t number, const ProjectJoints& of) {
    std::string line = std::to_string(number) + ". Move " + name_list(step.moved, of) + " to " +
                       name_list(step.standing, of) + " along (" + fixed(step.direction.x, 3) + ", " +
                       fixed(step.direction.y, 3) + ", " + fixed(step.direction.z, 3) + "), against cut " +
                       std::to_string(step.cut);
    if (step.solids > 1) line += "; its " + std::to_string(step.solids) + " solids interlock and move together";
    if (step.joints.empty()) line += "; it touches nothing yet: hold it";
    if (!step.is_clear) line += "; SOMETHING IS IN THE WAY";
    return line + ".";
}

// "12 sawn-sawn, 3 sawn-milled, 0 milled-milled"
std::string faces_line(const ProjectJoints& of) {
    constexpr auto names = names_of(JointFaces{});
    std::string line;
    for (const auto& [faces, name] : names.rows) {
        const auto count = std::count(of.faces.begin(), of.faces.end(), faces);
        line += (line.empty() ? "Joints: " : ", ") + std::to_string(count) + " " + name;
    }
    return line + "; a base that is parted counts as sawn.";
}

std::string chain_line(const ProjectJoints& of) {
    return "Longest chain of joints: " + std::to_string(of.chain.joints()) + ", " + name_list(of.chain.pieces, of) +
           "; its ends are off by " + fixed(of.chain.largest_deviation(of.accuracy), 1) + " mm at most, usually " +
           fixed(of.chain.usual_deviation(of.accuracy), 1) + " mm, where each joint is off by " +
           significant(of.accuracy, 3) + " mm (saw.accuracy).";
}

Json joint_json(std::size_t j, const ProjectJoints& of) {
    const PieceJoint& joint = of.joints[j];
    const auto dowel_json = [](const Dowel& dowel) {
        return Json{
            {"diameter_mm", dowel.size.diameter}, {"depth_mm", dowel.size.depth}, {"point_mm", json_of(dowel.point)}};
    };
    return {{"cut", joint.cut},
            {"below", of.pieces[joint.below]},
            {"above", of.pieces[joint.above]},
            {"area_mm2", joint.contact.area_mm2},
            {"regions", joint.contact.regions.size()},
            {"made_by", of.faces.empty() ? Json() : Json(names_of(of.faces[j])(of.faces[j]))},
            {"dowels", list_of(joint.dowels, dowel_json)},
            {"fault", fault_word(joint.fault)},
            {"note", of.faults[j]}};
}

}  // namespace

std::vector<std::string> joint_lines(const ProjectJoints& of) {
    if (of.joints.empty()) return {};
    std::vector<std::vector<std::string>> rows{{"joint", "cut", "cm2", "dowels mm"}};
    if (!of.faces.empty()) rows.front().emplace_back("faces");
    std::size_t sound = 0;
    for (std::size_t j = 0; j < of.joints.size(); ++j) {
        const PieceJoint& joint = of.joints[j];
        rows.push_back({of.pieces[joint.below] + "-" + of.pieces[joint.above], std::to_string(joint.cut),
                        fixed(joint.contact.area_mm2 / 100, 1), describe_dowels(joint)});
        if (!of.faces.empty()) rows.back().emplace_back(names_of(of.faces[j])(of.faces[j]));
        sound += joint.fault == JointFault::none ? 1 : 0;
    }
    std::vector<std::string> lines = columns(rows);
    lines.push_back(std::to_string(sound) + " of " + counted(of.joints.size(), "joint") +
                    " can neither be turned nor swapped; seams " + fixed(of.seam.mm / 1000, 2) + " m, visible " +
                    fixed(of.seam.visible_mm / 1000, 2) + " m.");
    for (const std::string& fault : of.faults) {
        if (!fault.empty()) lines.push_back(fault + ".");
    }
    if (!of.faces.empty()) lines.push_back(faces_line(of));
    lines.push_back(chain_line(of));
    lines.push_back("Assembly in " + counted(of.assembly.steps.size(), "step") + ":");
    for (std::size_t i = 0; i < of.assembly.steps.size(); ++i) {
        lines.push_back(step_line(of.assembly.steps[i], i + 1, of));
    }
    return lines;
}

Json joints_json(const ProjectJoints& of) {
    Json joints = Json::array();
    for (std::size_t j = 0; j < of.joints.size(); ++j) joints.push_back(joint_json(j, of));
    const Json chain{{"chain_joints", of.chain.joints()},
                     {"way", name_json(of.chain.pieces, of)},
                     {"largest_mm", of.chain.largest_deviation(of.accuracy)},
                     {"usual_mm", of.chain.usual_deviation(of.accuracy)}};
    return {
        {"joints", joints}, {"seam_mm", of.seam.mm}, {"visible_seam_mm", of.seam.visible_mm}, {"longest_chain", chain}};
}

Json assembly_json(const ProjectJoints& of) {
    Json steps = Json::array();
    for (const AssemblyStep& step : of.assembly.steps) {
        Json joints = Json::array();
        for (const std::size_t j : step.joints) {
            joints.push_back(of.pieces[of.joints[j].below] + "-" + of.pieces[of.joints[j].above]);
        }
        steps.push_back({{"cut", step.cut},
                         {"moved", name_json(step.moved, of)},
                         {"standing", name_json(step.standing, of)},
                         {"solids", step.solids},
                         {"direction", json_of(step.direction)},
                         {"distance_mm", step.distance_mm},
                         {"joints", joints},
                         {"clear", step.is_clear}});
    }
    return steps;
}

}  // namespace qchopper
