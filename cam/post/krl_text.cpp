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

constexpr double max_degrees = 3600;
constexpr std::size_t longest_name = 24;

// An angle of A, B, C in degrees; -180 and 180 are the same, and 180 is written.
std::string angle(const char* name, double value, int decimals) {
    const std::string text = written_number(name, degrees_per_radian * value, decimals, max_degrees);
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

namespace krl {

std::string position(Vec3 point, int decimals) {
    return "X " + written_mm("X", point.x, decimals) + ",Y " + written_mm("Y", point.y, decimals) + ",Z " +
           written_mm("Z", point.z, decimals);
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
        text += (i > 0 ? "," : "") + name + " " + written_number(name, degrees_per_radian * joints[i], 3, max_degrees);
    }
    return text;
}

std::string external(int axis, double angle) {
    const std::string name = "E" + std::to_string(axis);
    return name + " " + written_number(name, degrees_per_radian * angle, 3, max_degrees);
}

std::string load(const LoadData& load) {
    constexpr double max_kg = 10'000;
    const Vec3 inertia = load.inertia_kg_m2;
    return "{M " + written_number("M", load.mass_kg, 3, max_kg) + ",CM " + frame(load.centre_in_flange) + ",J {X " +
           written_number("J", inertia.x, 4, max_kg) + ",Y " + written_number("J", inertia.y, 4, max_kg) + ",Z " +
           written_number("J", inertia.z, 4, max_kg) + "}}";
}

void begin_program(const std::string& name, KrlText& text) {
    if (name.size() > longest_name) {
        throw InputError(InputFault::use, "the program name " + name + " has more than 24 characters");
    }
    text.line("&ACCESS RVP");
    text.line("&REL 1");
    text.line("&PARAM EDITMASK = *");
    text.line("DEF " + name + "( )");
}

}  // namespace krl

}  // namespace qchopper
