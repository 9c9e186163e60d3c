// The quaternion of a rotation by the largest of its components, so that nothing is divided by a small number.

#include "cam/post/rapid_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"

namespace qchopper {
namespace {

constexpr double max_degrees = 3600;
constexpr double max_signal = 1e6;
constexpr std::size_t longest_string = 80;

// w, x, y, z; w is not negative.
std::array<double, 4> quaternion_of(const Pose& pose) {
    const auto& r = pose.row;
    const std::array<double, 4> squared{1 + r[0].x + r[1].y + r[2].z, 1 + r[0].x - r[1].y - r[2].z,
                                        1 - r[0].x + r[1].y - r[2].z, 1 - r[0].x - r[1].y + r[2].z};
    const auto largest = std::max_element(squared.begin(), squared.end()) - squared.begin();
    const double x = r[2].y - r[1].z;
    const double y = r[0].z - r[2].x;
    const double z = r[1].x - r[0].y;
    const double xy = r[0].y + r[1].x;
    const double xz = r[0].z + r[2].x;
    const double yz = r[1].z + r[2].y;
    const std::array<std::array<double, 4>, 4> rows{
        {{squared[0], x, y, z}, {x, squared[1], xy, xz}, {y, xy, squared[2], yz}, {z, xz, yz, squared[3]}}};
    std::array<double, 4> q = rows[static_cast<std::size_t>(largest)];
    const double size = std::copysign(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])), q[0]);
    for (double& component : q) component /= size;
    return q;
}

}  // namespace

namespace rapid {

void begin_module(const std::string& name, ProgramLines& text) {
    if (name.size() > longest_name) {
        throw InputError(InputFault::use, "the program name " + name + " has more than 32 characters");
    }
    for (const char* line : {"%%%", "  VERSION:1", "  LANGUAGE:ENGLISH", "%%%"}) text.line(line);
    text.line("MODULE " + name);
}

std::string position(Vec3 point, int decimals) {
    return written_mm("X", point.x, decimals) + "," + written_mm("Y", point.y, decimals) + "," +
           written_mm("Z", point.z, decimals);
}

std::string quaternion(const Pose& pose) {
    std::string text = "[";
    for (const double component : quaternion_of(pose)) {
        text += (text.size() > 1 ? "," : "") + written_number("quaternion", component, 8, 1.1);
    }
    return text + "]";
}

std::string frame(const Pose& pose) {
    return "[[" + position(pose.shift, 3) + "]," + quaternion(pose) + "]";
}

std::string external_axes(std::optional<int> axis, double angle) {
    std::string text = "[";
    for (int i = 1; i <= 6; ++i) {
        text += i > 1 ? "," : "";
        text += axis == i ? written_number("external axis", degrees_per_radian * angle, 3, max_degrees) : "9E9";
    }
    return text + "]";
}

std::string configuration(const Joints& joints) {
    std::string text = "[";
    for (const std::size_t axis : {0U, 3U, 5U}) {
        text += std::to_string(static_cast<int>(std::floor(degrees_per_radian * joints[axis] / 90))) + ",";
    }
    return text + "0]";
}

void switch_signal(const std::optional<Signal>& signal, bool is_on, ProgramLines& text) {
    if (!signal) return;
    if (signal->kind == SignalKind::call) return text.line(signal->target + ";");
    text.line("SetDO " + signal->target + "," + (is_on ? "1;" : "0;"));
}

void set_speed(const Signal& signal, double rpm, ProgramLines& text) {
    const std::string value = written_number("speed of the spindle", rpm * signal.scale, 5, max_signal);
    text.line(signal.kind == SignalKind::call ? signal.target + " " + value + ";"
                                              : "SetAO " + signal.target + "," + value + ";");
}

void ask(std::string_view question, const std::string& key, ProgramLines& text) {
    std::string rest = as_ascii("ASK " + std::string(question));
    std::replace_if(
        rest.begin(), rest.end(), [](char c) { return c == '"' || c == '\\'; }, '_');
    while (!rest.empty()) {
        std::size_t length = std::min(longest_string, rest.size());
        if (length < rest.size()) {
            const std::size_t space = rest.rfind(' ', length);
            if (space != std::string::npos && space > 0) length = space;
        }
        text.line("TPWrite \"" + rest.substr(0, length) + "\";");
        rest.erase(0, length);
        if (!rest.empty() && rest.front() == ' ') rest.erase(0, 1);
    }
    text.line("TPReadFK " + key + ",\"Go on?\",stEmpty,stEmpty,stEmpty,stEmpty,\"Done\";");
}

}  // namespace rapid

}  // namespace qchopper
