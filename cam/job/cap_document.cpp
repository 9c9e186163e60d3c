// One table per object of the JSON. O(holes).

#include "cam/job/cap_document.h"

#include <set>

#include "base/enum_names.h"
#include "base/json_fields.h"
#include "base/json_schema.h"

namespace qchopper {
namespace {

using namespace json_values;

enum class Driller { robot, hand };
constexpr auto names_of(Driller) {
    return EnumNames<Driller, 2>{{{Driller::robot, "robot"}, {Driller::hand, "hand"}}};
}

constexpr auto is_length = [](double value) { return value >= 1e-3 ? nullptr : "is out of range"; };

void check_hole(const JobHole& hole, const Pose& cap_in_setup, std::size_t number) {
    if (hole.number != number) throw wrong("number", "does not count the holes from 1");
    const Vec3 point = apply(cap_in_setup, {hole.on_cap.x, hole.on_cap.y, 0});
    if (!(norm(point - hole.point) <= 1e-6)) throw wrong("point", "is not that of on_cap");
    if (!(norm(rotate(cap_in_setup, {0, 0, -1}) - hole.axis) <= 1e-6)) throw wrong("axis", "is not that of the cap");
}

}  // namespace

template <class V, Of<JobHole> T>
void fields(V& v, T& hole) {
    v("number", hole.number);
    v("diameter_mm", hole.diameter, is_length);
    v("depth_mm", hole.depth, is_length);
    v.converted(
        "on_cap", hole.on_cap,
        [](Point2 p) {
            return std::array{p.x, p.y};
        },
        [](const auto& p) {
            return Point2{p[0], p[1]};
        });
    v("point", hole.point);
    v("axis", hole.axis);
    v.converted(
        "drilled_by", hole.by_robot, [](bool by_robot) { return by_robot ? Driller::robot : Driller::hand; },
        [](Driller by) { return by == Driller::robot; });
    v("by_hand_because", hole.by_hand);
    v.check(hole.by_robot == hole.by_hand.empty(), "by_hand_because", "contradicts drilled_by");
}

template <class V, Of<CapJoint> T>
void fields(V& v, T& joint) {
    v("neighbour", joint.neighbour);
    v("area_mm2", joint.area_mm2, not_negative);
    v("note", joint.note);
    v("holes", joint.holes);
}

template <class V, Of<JobCap> T>
void fields(V& v, T& cap) {
    v("cut", cap.cut);
    v.check(cap.cut >= 0, "cut", "is not a whole number in bounds");
    v("cap_in_piece", cap.cap_in_piece);
    v("joints", cap.joints);
}

void put(Json& at, const JobCap& cap) {
    put<JobCap>(at, cap);
}

void take(const Json& json, const std::string& key, JobCap& cap) {
    take<JobCap>(json, key, cap);
}

void put_schema(Json& at, const JobCap& cap) {
    put_schema<JobCap>(at, cap);
}

std::string template_name(std::int32_t cut, const std::string& ending) {
    return "template-" + std::to_string(cut) + "." + ending;
}

std::vector<JobHole> holes_of(const std::vector<JobCap>& caps) {
    std::vector<JobHole> holes;
    for (const JobCap& cap : caps) {
        for (const CapJoint& joint : cap.joints) holes.insert(holes.end(), joint.holes.begin(), joint.holes.end());
    }
    return holes;
}

void check_caps(const std::vector<JobCap>& caps, const Pose& piece_in_setup) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < caps.size(); ++i) {
        if (i > 0 && caps[i - 1].cut >= caps[i].cut) throw wrong("caps", "are not in order");
        const Pose cap_in_setup = piece_in_setup * caps[i].cap_in_piece;
        for (const CapJoint& joint : caps[i].joints) {
            for (const JobHole& hole : joint.holes) check_hole(hole, cap_in_setup, ++number);
        }
    }
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
