// One function per object of the JSON, first to write and then to read it. O(holes).

#include "cam/job/cap_document.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "base/json.h"
#include "cam/job/pose_json.h"

namespace qchopper {
namespace {

using namespace json_values;

constexpr double most = std::numeric_limits<double>::max();

Json from_hole(const JobHole& hole) {
    return {{"number", hole.number},
            {"diameter", hole.diameter},
            {"depth", hole.depth},
            {"on_cap", Json::array({hole.on_cap.x, hole.on_cap.y})},
            {"point", from_vector(hole.point)},
            {"axis", from_vector(hole.axis)},
            {"drilled_by", hole.by_robot ? "robot" : "hand"},
            {"by_hand_because", hole.by_hand}};
}

Json from_joint(const CapJoint& joint) {
    Json holes = Json::array();
    for (const JobHole& hole : joint.holes) holes.push_back(from_hole(hole));
    return {{"neighbour", joint.neighbour}, {"area_mm2", joint.area_mm2}, {"note", joint.note}, {"holes", holes}};
}

void read_driller(const Json& json, JobHole& hole) {
    const std::string by = text(json, "drilled_by");
    if (by != "robot" && by != "hand") throw wrong("drilled_by", "is neither robot nor hand");
    hole.by_robot = by == "robot";
    hole.by_hand = text(json, "by_hand_because");
    if (hole.by_robot != hole.by_hand.empty()) throw wrong("by_hand_because", "contradicts drilled_by");
}

JobHole to_hole(const Json& json, const Pose& cap_in_setup, std::size_t number) {
    JobHole hole;
    hole.number = number;
    if (whole<std::uint64_t>(json, "number") != number) throw wrong("number", "does not count the holes from 1");
    hole.diameter = real_within(json, "diameter", 1e-3, most);
    hole.depth = real_within(json, "depth", 1e-3, most);
    const Json& on_cap = items(json, "on_cap");
    if (on_cap.size() != 2 || !on_cap[0].is_number() || !on_cap[1].is_number()) {
        throw wrong("on_cap", "is not two numbers");
    }
    hole.on_cap = {on_cap[0].get<double>(), on_cap[1].get<double>()};
    hole.point = vector(json, "point");
    hole.axis = vector(json, "axis");
    read_driller(json, hole);
    const Vec3 point = apply(cap_in_setup, {hole.on_cap.x, hole.on_cap.y, 0});
    if (!(norm(point - hole.point) <= 1e-6)) throw wrong("point", "is not that of on_cap");
    if (!(norm(rotate(cap_in_setup, {0, 0, -1}) - hole.axis) <= 1e-6)) throw wrong("axis", "is not that of the cap");
    return hole;
}

CapJoint to_joint(const Json& json, const Pose& cap_in_setup, std::size_t& holes) {
    CapJoint joint{text(json, "neighbour"), real_within(json, "area_mm2", 0, most), text(json, "note"), {}};
    for (const Json& hole : items(json, "holes")) {
        joint.holes.push_back(to_hole(hole, cap_in_setup, ++holes));
    }
    return joint;
}

JobCap to_cap(const Json& json, const Pose& piece_in_setup, std::size_t& holes) {
    JobCap cap;
    cap.cut = static_cast<std::int32_t>(whole_up_to(json, "cut", std::numeric_limits<std::int32_t>::max()));
    cap.cap_in_piece = to_pose(member(json, "cap_in_piece"), "cap_in_piece");
    for (const Json& joint : items(json, "joints")) {
        cap.joints.push_back(to_joint(joint, piece_in_setup * cap.cap_in_piece, holes));
    }
    return cap;
}

}  // namespace

std::string template_name(std::int32_t cut, const std::string& ending) {
    return "template-" + std::to_string(cut) + "." + ending;
}

Json from_caps(const std::vector<JobCap>& caps) {
    Json list = Json::array();
    for (const JobCap& cap : caps) {
        Json joints = Json::array();
        for (const CapJoint& joint : cap.joints) joints.push_back(from_joint(joint));
        list.push_back({{"cut", cap.cut}, {"cap_in_piece", from_pose(cap.cap_in_piece)}, {"joints", joints}});
    }
    return list;
}

std::vector<JobHole> holes_of(const std::vector<JobCap>& caps) {
    std::vector<JobHole> holes;
    for (const JobCap& cap : caps) {
        for (const CapJoint& joint : cap.joints) holes.insert(holes.end(), joint.holes.begin(), joint.holes.end());
    }
    return holes;
}

std::vector<JobCap> to_caps(const Json& json, const Pose& piece_in_setup) {
    if (!json.is_array()) throw wrong("caps", "is not a list");
    std::vector<JobCap> caps;
    std::size_t holes = 0;
    for (const Json& cap : json) {
        caps.push_back(to_cap(cap, piece_in_setup, holes));
        if (caps.size() > 1 && caps[caps.size() - 2].cut >= caps.back().cut) throw wrong("caps", "are not in order");
    }
    return caps;
}

std::string fault_of_templates(const std::vector<JobCap>& caps, const std::map<std::string, Bytes>& files) {
    std::set<std::string> expected;
    for (const JobCap& cap : caps) {
        for (const char* ending : {"svg", "pdf"}) {
            const std::string name = template_name(cap.cut, ending);
            if (!files.contains(name)) return name + " is missing";
            expected.insert(name);
        }
    }
    for (const auto& [name, bytes] : files) {
        if (name.starts_with("template-") && !expected.contains(name)) return name + " is the template of no cap";
    }
    return {};
}

}  // namespace qchopper
