// Aggregates by their places. A quaternion becomes A, B, C by its rotation matrix. O(characters).

#include <cmath>

#include "base/units.h"
#include "sim/program/rapid_parts.h"

namespace qchopper {
namespace {

constexpr double farthest = 5000;  // mm

void need_comma(ProgramLine& line) {
    line.need(',');
}

Vec3 read_point(ProgramLine& line, double largest = farthest) {
    Vec3 point;
    line.need('[');
    for (int i = 0; i < 3; ++i) {
        if (i > 0) need_comma(line);
        point[i] = line.number(-largest, largest);
    }
    line.need(']');
    return point;
}

// Of w, x, y, z; normalised to double precision first, so that the matrix is a rotation.
Vec3 abc_of(std::array<double, 4> q) {
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double w = q[0] / size;
    const double x = q[1] / size;
    const double y = q[2] / size;
    const double z = q[3] / size;
    const double r11 = 1 - 2 * (y * y + z * z);
    const double r21 = 2 * (x * y + w * z);
    const double r31 = 2 * (x * z - w * y);
    const double b = std::atan2(-r31, std::hypot(r11, r21));
    if (std::hypot(r11, r21) < 1e-9) return {std::atan2(-2 * (x * y - w * z), 1 - 2 * (x * x + z * z)), b, 0};
    return {std::atan2(r21, r11), b, std::atan2(2 * (y * z + w * x), 1 - 2 * (x * x + y * y))};
}

Vec3 read_quaternion(ProgramLine& line) {
    constexpr double tolerance = 1e-6;
    std::array<double, 4> q{};
    line.need('[');
    for (std::size_t i = 0; i < 4; ++i) {
        if (i > 0) need_comma(line);
        q[i] = line.number(-1, 1);
    }
    line.need(']');
    const double squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (std::abs(squared - 1) > tolerance) line.refuse("the quaternion is not normalised");
    return abc_of(q);
}

bool is_nowhere(const ProgramFrame& frame) {
    return frame == ProgramFrame{};
}

// [9E9,...]: one axis at most is given.
void read_external(ProgramLine& line, RapidTarget& target) {
    line.need('[');
    for (std::uint32_t i = 1; i <= 6; ++i) {
        if (i > 1) need_comma(line);
        if (line.takes_text("9e9")) continue;
        if (target.external_axis != 0) line.refuse("two external axes are given");
        target.external_axis = i;
        target.external = degree * line.number(-3600, 3600);
    }
    line.need(']');
}

std::string read_string(ProgramLine& line) {
    line.need('"');
    return std::string(line.until_quote());
}

// [[x,y,z],[q1,q2,q3,q4]]. Coordinates are below 5 m.
ProgramFrame read_pose(ProgramLine& line) {
    ProgramFrame frame;
    line.need('[');
    frame.shift = read_point(line);
    need_comma(line);
    frame.abc = read_quaternion(line);
    line.need(']');
    return frame;
}

}  // namespace

void need_assignment(ProgramLine& line) {
    line.need(':');
    line.need('=');
}

// [TRUE,[[x,y,z],[q]],[mass,[cog],[q],ix,iy,iz]]
RapidTool read_tooldata(ProgramLine& line) {
    constexpr double largest_inertia = 1000;
    RapidTool tool;
    line.need('[');
    if (!line.takes_word("true")) line.refuse("the robot must hold the tool: TRUE");
    need_comma(line);
    tool.frame = read_pose(line);
    need_comma(line);
    line.need('[');
    tool.load.mass_kg = line.number(0, 1000);
    need_comma(line);
    tool.load.centre.shift = read_point(line);
    need_comma(line);
    tool.load.centre.abc = read_quaternion(line);
    for (int i = 0; i < 3; ++i) {
        need_comma(line);
        tool.load.inertia[i] = line.number(0, largest_inertia);
    }
    line.need(']');
    line.need(']');
    return tool;
}

// [FALSE,TRUE,"",[[x,y,z],[q]],[[0,0,0],[1,0,0,0]]] or [FALSE,FALSE,"STN1",[[0,0,0],[1,0,0,0]],[[x,y,z],[q]]]
RapidWork read_wobjdata(ProgramLine& line) {
    RapidWork work;
    line.need('[');
    if (!line.takes_word("false")) line.refuse("the robot must not hold the work object: FALSE");
    need_comma(line);
    const bool stands = line.takes_word("true");
    if (!stands) line.need_word("false");
    need_comma(line);
    const std::string unit = lower_case(read_string(line));
    const bool is_unit = unit.size() == 4 && unit.starts_with("stn") && unit[3] >= '1' && unit[3] <= '6';
    if (stands ? !unit.empty() : !is_unit) line.refuse("the mechanical unit is none, or STN1 to STN6 of a table");
    if (!stands) work.unit = static_cast<std::uint32_t>(unit[3] - '0');
    need_comma(line);
    const ProgramFrame user = read_pose(line);
    need_comma(line);
    const ProgramFrame object = read_pose(line);
    line.need(']');
    if (!is_nowhere(stands ? object : user)) line.refuse("one of the two frames must be [[0,0,0],[1,0,0,0]]");
    work.base = stands ? user : object;
    return work;
}

RapidSpeed read_speeddata(ProgramLine& line) {
    RapidSpeed speed;
    line.need('[');
    speed.tcp = line.number(0.1, 3000);
    need_comma(line);
    speed.turn = degree * line.number(0.1, 3600);
    for (int i = 0; i < 2; ++i) {
        need_comma(line);
        line.number(0.1, 5000);
    }
    line.need(']');
    return speed;
}

double read_zonedata(ProgramLine& line) {
    line.need('[');
    if (!line.takes_word("false")) line.refuse("a zone is no stop point: FALSE");
    need_comma(line);
    const double zone = line.number(0, 1000);
    for (int i = 0; i < 5; ++i) {
        need_comma(line);
        line.number(0, 1000);
    }
    line.need(']');
    return zone;
}

RapidTarget read_robtarget(ProgramLine& line) {
    RapidTarget target;
    line.need('[');
    target.point = read_point(line);
    need_comma(line);
    target.abc = read_quaternion(line);
    need_comma(line);
    line.need('[');
    for (int i = 0; i < 4; ++i) {
        if (i > 0) need_comma(line);
        line.number(-8, 8);
    }
    line.need(']');
    need_comma(line);
    read_external(line, target);
    line.need(']');
    return target;
}

std::array<double, 6> read_jointtarget(ProgramLine& line, RapidTarget& external) {
    std::array<double, 6> joints{};
    line.need('[');
    line.need('[');
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (i > 0) need_comma(line);
        joints[i] = degree * line.number(-720, 720);
    }
    line.need(']');
    need_comma(line);
    read_external(line, external);
    line.need(']');
    return joints;
}

}  // namespace qchopper
