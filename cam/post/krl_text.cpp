// Digits by fixed() of base/text.h, which no locale changes.

#include "cam/post/krl_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "cam/cell/kuka_angles.h"

namespace qchopper {
namespace {

constexpr double farthest = 5000;  // mm
constexpr double max_degrees = 3600;

// An angle of A, B, C in degrees; -180 and 180 are the same, and 180 is written.
std::string angle(const char* name, double value, int decimals) {
    const std::string text = krl::number(name, degrees_per_radian * value, decimals, max_degrees);
    return text == "-" + fixed(180, decimals) ? text.substr(1) : text;
}

// Where the decimals make 90 or -90 degrees of B, only A - C or A + C is left: C is 0, as everywhere in a program.
KukaAngles rounded_gimbal(KukaAngles abc, int decimals) {
    const double size = std::abs(degrees_per_radian * abc.b);
    if (size < 89 || fixed(size, decimals) != fixed(90, decimals)) return abc;
    const double turn = abc.b > 0 ? abc.a - abc.c : abc.a + abc.c;
    return {std::remainder(turn, 2 * std::numbers::pi), abc.b, 0};
}

}  // namespace

void KrlText::line(std::string_view text) {
    bytes_ += text;
    bytes_ += "\r\n";
    ++lines_;
}

void KrlText::comment(std::string_view text) {
    std::string ascii = ";" + std::string(text);
    std::replace_if(
        ascii.begin(), ascii.end(), [](char c) { return c < ' ' || c > '~'; }, '_');
    line(ascii);
}

void KrlText::append(const KrlText& other) {
    bytes_ += other.bytes_;
    lines_ += other.lines_;
}

namespace krl {

std::string number(std::string_view what, double value, int decimals, double largest) {
    if (!(std::abs(value) < largest)) {
        throw InputError(InputFault::use, std::string(what) + " = " + significant(value, 6) +
                                              " cannot be written into a program: not below " +
                                              significant(largest, 6) + " in size");
    }
    return fixed(value, decimals);
}

std::string position(Vec3 point, int decimals) {
    return "X " + number("X", point.x, decimals, farthest) + ",Y " + number("Y", point.y, decimals, farthest) + ",Z " +
           number("Z", point.z, decimals, farthest);
}

std::string angles(const Pose& pose, int decimals) {
    const KukaAngles abc = rounded_gimbal(kuka_angles(pose), decimals);
    return ",A " + angle("A", abc.a, decimals) + ",B " + angle("B", abc.b, decimals) + ",C " +
           angle("C", abc.c, decimals);
}

std::string frame(const Pose& pose) {
    return "{" + position(pose.shift, 3) + angles(pose, 4) + "}";
}

std::string joints(const Joints& joints) {
    std::string text;
    for (std::size_t i = 0; i < axes_of_arm; ++i) {
        const std::string name = "A" + std::to_string(i + 1);
        text += (i > 0 ? "," : "") + name + " " + number(name, degrees_per_radian * joints[i], 3, max_degrees);
    }
    return text;
}

std::string external(int axis, double angle) {
    const std::string name = "E" + std::to_string(axis);
    return name + " " + number(name, degrees_per_radian * angle, 3, max_degrees);
}

}  // namespace krl

}  // namespace qchopper
