// Each candidate changes the arm or the reading of the display, fits its one unknown by least squares where it has one,
// and explains the poses if no pose is farther off than the tolerance. An angle is fitted by trying all whole degrees
// and bisecting the best with golden sections; a length is linear in the positions.

#include "cam/cell/taught_poses.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <optional>

#include "base/text.h"
#include "base/units.h"
#include "cam/cell/kuka_angles.h"

namespace qchopper {
namespace {

constexpr double largest_distance = 1;  // mm
constexpr double largest_angle = 0.1 * degree;
constexpr double lever = 1000;       // mm: an angle of 1 radian weighs as much as so many mm
constexpr double still = 5;          // degrees
constexpr double same_share = 1e-3;  // of a value that another unit would give

struct Posed {
    Joints joints{};
    Pose flange;
};

using Poses = std::vector<Posed>;
using Reading = std::function<Posed(const TaughtPose&)>;

Posed as_shown(const TaughtPose& taught) {
    Posed posed;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) posed.joints[axis] = radians(taught.joints_deg[axis]);
    const auto& [a, b, c] = taught.abc_deg;
    posed.flange = pose_of({radians(a), radians(b), radians(c)}, taught.position);
    return posed;
}

Poses read(std::span<const TaughtPose> taught, const Reading& reading) {
    Poses poses;
    for (const TaughtPose& pose : taught) poses.push_back(reading(pose));
    return poses;
}

PoseDeviation deviation(const Pose& a, const Pose& b) {
    const Pose between = inverse(a) * b;
    const double trace = between.row[0].x + between.row[1].y + between.row[2].z;
    const Vec3 axis{between.row[2].y - between.row[1].z, between.row[0].z - between.row[2].x,
                    between.row[1].x - between.row[0].y};
    return {norm(a.shift - b.shift), std::atan2(norm(axis), trace - 1)};
}

std::vector<PoseDeviation> deviations(const ArmGeometry& arm, const Poses& poses) {
    std::vector<PoseDeviation> all;
    for (const Posed& pose : poses) all.push_back(deviation(forward(arm, pose.joints), pose.flange));
    return all;
}

bool is_small(const PoseDeviation& d) {
    return d.distance <= largest_distance && d.angle <= largest_angle;
}

bool explains(const ArmGeometry& arm, const Poses& poses) {
    return std::ranges::all_of(deviations(arm, poses), is_small);
}

double squares(const ArmGeometry& arm, const Poses& poses) {
    double sum = 0;
    for (const PoseDeviation& d : deviations(arm, poses)) {
        sum += d.distance * d.distance + lever * lever * d.angle * d.angle;
    }
    return sum;
}

// The offset of an axis that fits best, in -pi..pi.
double fitted_offset(ArmGeometry arm, std::size_t axis, const Poses& poses) {
    const auto cost = [&](double offset) {
        arm.offset[axis] = offset;
        return squares(arm, poses);
    };
    double best = 0;
    for (int i = -180; i < 180; ++i) {
        if (cost(i * degree) < cost(best)) best = i * degree;
    }
    constexpr double golden = 0.6180339887498949;
    double low = best - degree;
    double high = best + degree;
    while (high - low > 1e-9) {
        const double left = high - golden * (high - low);
        const double right = low + golden * (high - low);
        (cost(left) < cost(right) ? high : low) = cost(left) < cost(right) ? right : left;
    }
    return (low + high) / 2;
}

struct Length {
    const char* key;
    double ArmGeometry::*value;
};

constexpr std::array<Length, 7> lengths{{{"a1", &ArmGeometry::a1},
                                         {"a2", &ArmGeometry::a2},
                                         {"b", &ArmGeometry::b},
                                         {"c1", &ArmGeometry::c1},
                                         {"c2", &ArmGeometry::c2},
                                         {"c3", &ArmGeometry::c3},
                                         {"c4", &ArmGeometry::c4}}};

// The value of a length that fits best: the flange moves along a line with it.
double fitted_length(const ArmGeometry& arm, const Length& length, const Poses& poses) {
    ArmGeometry longer = arm;
    longer.*length.value += 1;
    double wanted = 0;
    for (const Posed& pose : poses) {
        const Vec3 here = forward(arm, pose.joints).shift;
        const Vec3 along = forward(longer, pose.joints).shift - here;  // of length 1
        wanted += dot(pose.flange.shift - here, along);
    }
    return arm.*length.value + wanted / static_cast<double>(poses.size());
}

std::string number(double value) {
    return significant(value, 6);
}

bool is_same(double a, double b) {
    return std::abs(a - b) <= same_share * std::max(std::abs(a), std::abs(b));
}

// But for whole turns, in degrees.
bool is_one_angle(double a, double b) {
    return std::abs(std::remainder(a - b, 360)) < 0.1;
}

std::string should_be(const std::string& what, double is, double should) {
    return what + " is " + number(is) + " and should be " + number(should);
}

std::string of_axis(std::size_t axis) {
    return "axis " + std::to_string(axis + 1);
}

std::string listed(const std::vector<int>& axes) {
    std::string text;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        text += (i == 0 ? "" : i + 1 == axes.size() ? " and " : ", ") + std::to_string(axes[i]);
    }
    return text;
}

// Candidates without an unknown, first the units.

void add_units_of_arm(const ArmGeometry& arm, const Poses& poses, std::vector<ArmFault>& faults) {
    constexpr std::pair<const char*, double> units[] = {{"metres", 1000}, {"centimetres", 10}, {"inches", 25.4}};
    for (const auto& [unit, mm] : units) {
        ArmGeometry scaled = arm;
        for (const Length& length : lengths) scaled.*length.value *= mm;
        if (!explains(scaled, poses)) continue;
        faults.push_back({"a1 to c4", {}, "a1 to c4 stand in " + std::string(unit) + " and should be in mm"});
    }
    ArmGeometry turned = arm;
    std::vector<int> axes;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        if (arm.offset[axis] != 0) axes.push_back(static_cast<int>(axis) + 1);
        turned.offset[axis] = degrees(arm.offset[axis]);
    }
    if (axes.size() > 1 && explains(turned, poses)) {
        faults.push_back({"offset_deg", axes, "offset_deg stands in radians and should be in degrees"});
    }
}

void add_readings(const ArmGeometry& arm, std::span<const TaughtPose> taught, std::vector<ArmFault>& faults) {
    const auto add = [&](const char* parameter, const char* sentence, const Reading& reading) {
        if (explains(arm, read(taught, reading))) faults.push_back({parameter, {}, sentence});
    };
    add("position", "X, Y, Z of the poses stand in metres and should be in mm", [](TaughtPose pose) {
        pose.position = 1000 * pose.position;
        return as_shown(pose);
    });
    add("joints", "the joints of the poses stand in radians and should be in degrees", [](TaughtPose pose) {
        for (double& joint : pose.joints_deg) joint = degrees(joint);
        return as_shown(pose);
    });
    add("abc", "A, B, C of the poses stand in radians and should be in degrees", [](TaughtPose pose) {
        for (double& angle : pose.abc_deg) angle = degrees(angle);
        return as_shown(pose);
    });
    add("abc", "the angles of the poses are given about x, y, z and should be in the order A, B, C about z, y, x",
        [](TaughtPose pose) {
            std::swap(pose.abc_deg[0], pose.abc_deg[2]);
            return as_shown(pose);
        });
    add("joints", "joint 3 of the poses counts from the horizontal, as on Fanuc's pendants, and should be J3 + J2",
        [](TaughtPose pose) {
            pose.joints_deg[2] += pose.joints_deg[1];
            return as_shown(pose);
        });
}

// Sign patterns with `count` signs turned round.
void add_signs(const ArmGeometry& arm, const Poses& poses, int count, std::vector<ArmFault>& faults) {
    for (unsigned pattern = 1; pattern < 1U << axes_of_arm; ++pattern) {
        if (std::popcount(pattern) != count) continue;
        ArmGeometry turned = arm;
        std::vector<int> axes;
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            if ((pattern >> axis & 1U) == 0) continue;
            turned.sign[axis] = -arm.sign[axis];
            axes.push_back(static_cast<int>(axis) + 1);
        }
        if (!explains(turned, poses)) continue;
        const auto first = static_cast<std::size_t>(axes[0] - 1);
        faults.push_back({"sign", axes,
                          count == 1 ? should_be("sign of axis " + listed(axes), arm.sign[first], turned.sign[first])
                                     : "the signs of axes " + listed(axes) + " should all be turned round"});
    }
}

// What shows the same as a wrong offset or length at the ends of the chain.
std::string also(std::size_t axis) {
    if (axis == 0) return "; or the controller shows poses in a base that is turned by as much";
    return axis == 5 ? "; or a tool is active in the controller that is turned by as much" : "";
}

std::string also(const std::string& key) {
    if (key == "c1") return "; or the controller counts heights from another base";
    return key == "c4" ? "; or a tool is active in the controller, longer by as much" : "";
}

void add_offsets(const ArmGeometry& arm, const Poses& poses, bool with_sign, std::vector<ArmFault>& faults) {
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        ArmGeometry changed = arm;
        if (with_sign) changed.sign[axis] = -arm.sign[axis];
        changed.offset[axis] = fitted_offset(changed, axis, poses);
        if (!explains(changed, poses)) continue;
        const double is = degrees(arm.offset[axis]);
        const double should = std::round(1e3 * degrees(changed.offset[axis])) / 1e3;
        std::string sentence = should_be("offset_deg of " + of_axis(axis), is, should);
        if (is != 0 && is_one_angle(degrees(is), should)) sentence += ": it stands in radians";
        if (with_sign) sentence += ", and its sign should be " + std::to_string(changed.sign[axis]);
        faults.push_back({"offset_deg", {static_cast<int>(axis) + 1}, sentence + also(axis)});
    }
}

void add_lengths(const ArmGeometry& arm, const Poses& poses, std::vector<ArmFault>& faults) {
    for (const Length& length : lengths) {
        ArmGeometry changed = arm;
        changed.*length.value = fitted_length(arm, length, poses);
        if (!explains(changed, poses)) continue;
        const double is = arm.*length.value;
        const double should = std::round(10 * changed.*length.value) / 10;
        std::string sentence = should_be(length.key, is, should);
        if (is != 0 && is_same(1000 * is, should)) sentence += ": it stands in metres";
        if (is != 0 && is_same(-is, should)) sentence += ": its sign is wrong";
        faults.push_back({length.key, {}, sentence + also(length.key)});
    }
}

std::string describe(const Pose& pose) {
    const KukaAngles abc = kuka_angles(pose);
    return "X " + fixed(pose.shift.x, 1) + ", Y " + fixed(pose.shift.y, 1) + ", Z " + fixed(pose.shift.z, 1) + ", A " +
           fixed(degrees(abc.a), 2) + ", B " + fixed(degrees(abc.b), 2) + ", C " + fixed(degrees(abc.c), 2);
}

// The same motion before or after the arm in all poses.
void add_frames(const ArmGeometry& arm, const Poses& poses, std::vector<ArmFault>& faults) {
    const auto base_of = [&](const Posed& pose) { return pose.flange * inverse(forward(arm, pose.joints)); };
    const auto tool_of = [&](const Posed& pose) { return inverse(forward(arm, pose.joints)) * pose.flange; };
    const auto is_one = [&](const auto& frame_of) {
        return std::ranges::all_of(
            poses, [&](const Posed& pose) { return is_small(deviation(frame_of(pose), frame_of(poses[0]))); });
    };
    if (is_one(tool_of)) {
        faults.push_back({"tool",
                          {},
                          "a tool is active in the controller: " + describe(tool_of(poses[0])) +
                              "; show the poses of the flange, without a tool"});
    }
    if (is_one(base_of)) {
        faults.push_back({"base",
                          {},
                          "the controller shows the poses in another base, in which the robot stands at " +
                              describe(base_of(poses[0])) + "; show them in the robot's own base"});
    }
}

std::vector<ArmFault> simplest_faults(const ArmGeometry& arm, std::span<const TaughtPose> taught) {
    const Poses poses = read(taught, as_shown);
    std::vector<ArmFault> faults;
    add_units_of_arm(arm, poses, faults);
    add_readings(arm, taught, faults);
    if (!faults.empty()) return faults;
    add_signs(arm, poses, 1, faults);
    add_lengths(arm, poses, faults);
    add_offsets(arm, poses, false, faults);
    if (!faults.empty()) return faults;
    add_frames(arm, poses, faults);
    add_offsets(arm, poses, true, faults);
    for (int count = 2; faults.empty() && count <= static_cast<int>(axes_of_arm); ++count) {
        add_signs(arm, poses, count, faults);
    }
    return faults;
}

}  // namespace

TaughtPoseCheck check_taught_poses(const ArmGeometry& arm, std::span<const TaughtPose> poses) {
    TaughtPoseCheck check;
    check.deviations = deviations(arm, read(poses, as_shown));
    check.agrees = std::ranges::all_of(check.deviations, is_small);
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const auto [least, most] =
            std::ranges::minmax(poses, {}, [axis](const TaughtPose& pose) { return pose.joints_deg[axis]; });
        if (most.joints_deg[axis] - least.joints_deg[axis] < still) {
            check.still_axes.push_back(static_cast<int>(axis) + 1);
        }
    }
    if (!check.agrees) check.faults = simplest_faults(arm, poses);
    return check;
}

}  // namespace qchopper
