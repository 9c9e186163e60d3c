// The tables of the robot: one function each; degrees become radians here. O(capsules).

#include <algorithm>
#include <cmath>

#include "cam/cell/cell_tables.h"
#include "cam/cell/kuka_angles.h"

namespace qchopper {
namespace {

constexpr double longest_link = 5'000;  // mm
constexpr double max_turns = 720;       // degrees
constexpr std::size_t max_capsules = 100;

std::string axis_name(std::size_t axis) {
    return "axis " + std::to_string(axis + 1);
}

Joints read_joints(const TomlReader& reader, std::string_view key, double least, double most) {
    const std::vector<double> values = reader.numbers(key, axes_of_arm, least, most);
    Joints joints{};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) joints[axis] = values[axis] * degree;
    return joints;
}

ArmGeometry read_geometry(const TomlReader& reader) {
    ArmGeometry g;
    g.a1 = reader.number("a1", -longest_link, longest_link);
    g.a2 = reader.number("a2", -longest_link, longest_link);
    g.b = reader.number("b", -longest_link, longest_link);
    g.c1 = reader.number("c1", 0, longest_link);
    g.c2 = reader.number("c2", smallest, longest_link);
    g.c3 = reader.number("c3", smallest, longest_link);
    g.c4 = reader.number("c4", 0, longest_link);
    g.offset = read_joints(reader, "offset_deg", -360, 360);
    const std::vector<double> signs = reader.numbers("sign", axes_of_arm, -1, 1);
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        if (std::abs(signs[axis]) != 1) reader.refuse("sign", "must be 1 or -1, and is not for " + axis_name(axis));
        g.sign[axis] = signs[axis] > 0 ? 1 : -1;
    }
    return g;
}

JointRanges read_ranges(const TomlReader& reader) {
    const Joints min = read_joints(reader, "min_deg", -max_turns, max_turns);
    const Joints max = read_joints(reader, "max_deg", -max_turns, max_turns);
    const Joints speed = read_joints(reader, "speed_deg_per_s", smallest, 5'000);
    const Joints acceleration = read_joints(reader, "acceleration_deg_per_s2", smallest, 100'000);
    JointRanges ranges;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        if (min[axis] >= max[axis]) {
            reader.refuse("max_deg", "must be larger than robot.min_deg, and is not for " + axis_name(axis));
        }
        ranges[axis] = {min[axis], max[axis], speed[axis], acceleration[axis]};
    }
    return ranges;
}

void narrow(JointRange& joint, const AngleRange& cable) {
    joint.min = std::max(joint.min, cable.min);
    joint.max = std::min(joint.max, cable.max);
}

// An interval of two numbers, the first below the second.
AngleRange read_angle_range(const TomlReader& reader, std::string_view key) {
    const std::vector<double> range = reader.numbers(key, 2, -max_turns, max_turns);
    if (range[0] >= range[1]) reader.refuse(key, "the first number must be below the second");
    return {range[0] * degree, range[1] * degree};
}

CableLimits read_cable(const TomlReader& reader, const JointRanges& ranges) {
    const CableLimits cable{read_angle_range(reader, "axis_4_deg"), read_angle_range(reader, "axis_6_deg")};
    const JointRanges both = ranges_with_cable(ranges, cable);
    const std::string why = "lies outside of the axis' range, robot.min_deg to robot.max_deg";
    if (both[3].min >= both[3].max) reader.refuse("axis_4_deg", why);
    if (both[5].min >= both[5].max) reader.refuse("axis_6_deg", why);
    return cable;
}

LinkCapsule read_capsule(const TomlReader& reader) {
    return {static_cast<int>(reader.whole("link", 0, axes_of_arm)),
            {reader.vector("from", -farthest_2, farthest_2), reader.vector("to", -farthest_2, farthest_2),
             reader.number("radius", smallest, farthest_2)}};
}

std::vector<LinkCapsule> read_capsules(const TomlReader& reader, Origins& origins) {
    std::vector<LinkCapsule> capsules;
    for (const TomlReader& row : reader.tables("capsule", keys_2::capsule)) {
        if (capsules.size() == max_capsules) reader.refuse("capsule", "more than a hundred capsules");
        capsules.push_back(read_capsule(row));
        add_origins(row, keys_2::capsule, "robot.capsule " + std::to_string(capsules.size()), origins);
    }
    return capsules;
}

void check_start(const TomlReader& reader, const Joints& joints, const Robot& robot) {
    const JointRanges ranges = ranges_with_cable(robot.ranges, robot.cable);
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        if (joints[axis] >= ranges[axis].min && joints[axis] <= ranges[axis].max) continue;
        reader.refuse("joints_deg", axis_name(axis) + " is outside of its range",
                      "see robot.min_deg, robot.max_deg and robot.cable");
    }
}

}  // namespace

JointRanges ranges_with_cable(const JointRanges& ranges, const std::optional<CableLimits>& cable) {
    JointRanges both = ranges;
    if (!cable) return both;
    narrow(both[3], cable->axis_4);
    narrow(both[5], cable->axis_6);
    return both;
}

Pose read_pose(const TomlReader& reader) {
    const std::vector<double> abc = reader.numbers("abc_deg", 3, -360, 360);
    const Vec3 position = reader.vector("position", -farthest_2, farthest_2);
    return pose_of({abc[0] * degree, abc[1] * degree, abc[2] * degree}, position);
}

Robot read_robot(const TomlReader& root, Origins& origins) {
    const TomlReader reader = root.table("robot", keys_2::robot);
    Robot robot;
    robot.name = reader.text("name");
    robot.geometry = read_geometry(reader);
    robot.ranges = read_ranges(reader);
    robot.payload_kg = reader.number("payload_kg", smallest, 10'000);
    add_origins(reader, keys_2::robot, "robot", origins);
    const TomlReader base = reader.table("base", keys_2::base);
    robot.base_in_cell = read_pose(base);
    add_origins(base, keys_2::base, "robot.base", origins);
    if (reader.has("cable")) {
        const TomlReader cable = reader.table("cable", keys_2::cable);
        robot.cable = read_cable(cable, robot.ranges);
        add_origins(cable, keys_2::cable, "robot.cable", origins);
    }
    if (reader.has("capsule")) robot.capsules = read_capsules(reader, origins);
    return robot;
}

StartPose read_start(const TomlReader& root, const std::optional<Robot>& robot, const Box& workspace) {
    const TomlReader reader = root.table("start", keys_2::start);
    StartPose start;
    if (robot) {
        if (reader.has("tip")) reader.refuse("tip", "belongs to a gantry", "a robot starts from joints_deg");
        start.joints = read_joints(reader, "joints_deg", -max_turns, max_turns);
        check_start(reader, start.joints, *robot);
        return start;
    }
    if (reader.has("joints_deg")) reader.refuse("joints_deg", "belongs to a robot", "a gantry starts from tip");
    start.tip = reader.vector("tip", -farthest_2, farthest_2);
    for (int axis = 0; axis < 3; ++axis) {
        if (start.tip[axis] >= workspace.min[axis] && start.tip[axis] <= workspace.max[axis]) continue;
        reader.refuse("tip", "lies outside of the reach");
    }
    return start;
}

}  // namespace qchopper
