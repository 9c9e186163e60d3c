// Looks names up in the table, letters and digits only. O(rows * characters of a name).

#include "cam/cell/known_arms.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "base/edit_distance.h"
#include "base/error.h"
#include "base/units.h"

namespace qchopper {
namespace {

constexpr double half_second = 0.5;
constexpr std::size_t nearest_names = 3;

constexpr std::array<MakerOfArms, 4> makers{
    {{Maker::kuka, "KUKA", {0, -90, 0, 0, 0, 0}, {-1, 1, 1, -1, 1, -1}, "krl", ""},
     {Maker::abb,
      "ABB",
      {0, 0, -90, 0, 0, 0},
      {1, 1, 1, 1, 1, 1},
      "rapid",
      "Programs in RAPID are not written yet: pieces are planned and checked, and carved without a program."},
     {Maker::fanuc,
      "Fanuc",
      {0, 0, -90, 0, 0, 180},
      {1, 1, -1, -1, -1, -1},
      "krl",
      "Fanuc's controllers read no KRL: the programs of this cell are for simulation and proof. Their J3 counts from "
      "the horizontal: joint 3 of this file is J3 + J2 of the pendant, and heights count from axis 2."},
     {Maker::staubli,
      "Staubli",
      {0, 0, 0, 0, 0, 0},
      {1, 1, 1, 1, 1, 1},
      "krl",
      "Staubli's controllers read no KRL: the programs of this cell are for simulation and proof. Heights count from "
      "axis 2."}}};

constexpr std::string_view parallel_axes =
    "three of its axes are parallel and its last three do not meet in one point, so it has no spherical wrist, and the "
    "inverse kinematics of this program do not hold for it";
constexpr std::string_view parallel_linkage =
    "a parallel linkage couples its axes 2 and 3, so their ranges hold together and not each alone, and the program "
    "would plan poses that the arm cannot take";
constexpr std::string_view seven_axes = "it has seven axes, and the program's kinematics are those of six";
constexpr std::string_view offset_wrist =
    "its last three axes do not meet in one point, so it has no spherical wrist, and the inverse kinematics of this "
    "program do not hold for it";

constexpr auto refused = std::to_array<RefusedArm>({{"ur", parallel_axes},
                                                    {"universalrobots", parallel_axes},
                                                    {"crx", offset_wrist},
                                                    {"fanuccrx", offset_wrist},
                                                    {"crb15000", offset_wrist},
                                                    {"gofa", offset_wrist},
                                                    {"lbr", seven_axes},
                                                    {"kukalbr", seven_axes},
                                                    {"iiwa", seven_axes},
                                                    {"yumi", seven_axes},
                                                    {"irb14000", seven_axes},
                                                    {"irb2400", parallel_linkage},
                                                    {"irb4400", parallel_linkage},
                                                    {"irb6660", parallel_linkage},
                                                    {"abbirb2400", parallel_linkage},
                                                    {"abbirb4400", parallel_linkage},
                                                    {"abbirb6660", parallel_linkage},
                                                    {"m900ia260l", parallel_linkage},
                                                    {"m410", parallel_linkage}});

// Letters and digits alone, in small letters.
std::string plain_name(std::string_view name) {
    std::string plain;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0) plain += static_cast<char>(std::tolower(byte));
    }
    return plain;
}

// The ids nearest to a name that no arm has.
std::string nearest_to(const std::string& plain) {
    std::vector<std::pair<std::size_t, std::string>> distances;
    for (const KnownArm& arm : known_arms()) {
        distances.emplace_back(edit_distance(plain, plain_name(arm.id)), std::string(arm.id));
    }
    std::stable_sort(distances.begin(), distances.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string names;
    for (std::size_t i = 0; i < std::min(nearest_names, distances.size()); ++i) {
        names += (i == 0 ? "" : ", ") + distances[i].second;
    }
    return names;
}

Joints joints_of(const ArmGeometry& arm, const Joints& angles) {
    Joints joints{};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        joints[axis] = arm.sign[axis] * (angles[axis] + arm.offset[axis]);
    }
    return joints;
}

}  // namespace

const MakerOfArms& maker_of(const KnownArm& arm) {
    return *std::find_if(makers.begin(), makers.end(), [&](const MakerOfArms& row) { return row.maker == arm.maker; });
}

ArmGeometry geometry_of(const KnownArm& arm) {
    const auto& [a1, a2, b, c1, c2, c3, c4] = arm.lengths;
    const MakerOfArms& maker = maker_of(arm);
    ArmGeometry geometry{a1, a2, b, c1, c2, c3, c4, {}, maker.sign};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) geometry.offset[axis] = radians(maker.offset_deg[axis]);
    return geometry;
}

JointRanges ranges_of(const KnownArm& arm) {
    JointRanges ranges;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const double speed = radians(arm.speed_deg_per_s[axis]);
        ranges[axis] = {radians(arm.min_deg[axis]), radians(arm.max_deg[axis]), speed, speed / half_second};
    }
    return ranges;
}

const KnownArm& known_arm(const std::string& name) {
    const std::string plain = plain_name(name);
    for (const KnownArm& arm : known_arms()) {
        if (plain == plain_name(arm.id) || plain == plain_name(arm.name)) return arm;
        if (plain == plain_name(maker_of(arm).name) + plain_name(arm.id)) return arm;
    }
    for (const RefusedArm& row : refused) {
        if (plain.compare(0, row.beginning.size(), row.beginning) != 0) continue;
        throw InputError(InputFault::use, "no cell file can be made for " + name + ": " + std::string(row.why),
                         "use an arm of six axes with a spherical wrist: qchopper cells robots lists those that are "
                         "known; or describe the cell as boxes (docs/user/cell-file.md), and carve without a program");
    }
    throw InputError(InputFault::use, "no robot is known as " + name + "; the nearest are " + nearest_to(plain),
                     "see qchopper cells robots; for another arm copy the file that is nearest and enter the lengths "
                     "of its data sheet (docs/user/cell-file.md)");
}

double reach_of(const KnownArm& arm) {
    const ArmGeometry geometry = geometry_of(arm);
    const JointRange range = ranges_of(arm)[1];
    const double ends[] = {geometry.sign[1] * range.min - geometry.offset[1],
                           geometry.sign[1] * range.max - geometry.offset[1]};
    const double lean = std::min(std::numbers::pi / 2, std::max(ends[0], ends[1]));
    return geometry.a1 + geometry.c2 * std::sin(lean) + std::hypot(geometry.a2, geometry.c3);
}

Joints straight_down_joints(const ArmGeometry& arm) {
    constexpr double right_angle = std::numbers::pi / 2;
    return joints_of(arm, {0, 0, right_angle, 0, right_angle, -arm.offset[5]});
}

std::array<Joints, 5> comparison_joints(const ArmGeometry& arm) {
    constexpr std::array<Joints, 5> moved{{{0, 0, 0, 0, 0, 0},
                                           {30, -10, 10, 0, 0, 0},
                                           {-25, 15, 0, 40, 0, 0},
                                           {0, -15, 0, 0, -35, 60},
                                           {20, 0, -15, -50, 0, 0}}};
    const Joints start = straight_down_joints(arm);
    std::array<Joints, 5> sets{};
    for (std::size_t i = 0; i < sets.size(); ++i) {
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            sets[i][axis] = start[axis] + arm.sign[axis] * radians(moved[i][axis]);
        }
    }
    return sets;
}

}  // namespace qchopper
