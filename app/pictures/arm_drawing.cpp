// Writes lines and words at places in mm, scaled to the height of the stretched arm. O(1).

#include "app/pictures/arm_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "base/units.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

constexpr double width = 1000;
constexpr double height = 1120;
constexpr double ground = 820;           // y of z = 0
constexpr double axis_1 = 260;           // x of axis 1
constexpr double tallest = 720;          // of the stretched arm
constexpr double first_dimension = 560;  // x of the dimension lines of heights
constexpr double table_top = 900;

std::string n(double value) {
    return fixed(value, 1);
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
    return "<line x1=\"" + n(x1) + "\" y1=\"" + n(y1) + "\" x2=\"" + n(x2) + "\" y2=\"" + n(y2) + "\" class=\"" +
           style + "\"/>\n";
}

std::string word(double x, double y, const std::string& text, const std::string& style = "") {
    return "<text x=\"" + n(x) + "\" y=\"" + n(y) + "\"" + (style.empty() ? "" : " class=\"" + style + "\"") + ">" +
           svg_text(text) + "</text>\n";
}

std::string mm(double length) {
    return significant(length, 7);
}

// The joints of the arm in the drawing.
struct ArmPoints {
    explicit ArmPoints(const ArmGeometry& arm) {
        scale = tallest / (arm.c1 + arm.c2 + arm.c3 + arm.c4);
        shoulder_x = axis_1 + scale * arm.a1;
        wrist_x = shoulder_x + scale * arm.a2;
        shoulder_y = ground - scale * arm.c1;
        elbow_y = shoulder_y - scale * arm.c2;
        wrist_y = elbow_y - scale * arm.c3;
        flange_y = wrist_y - scale * arm.c4;
    }
    double scale = 1;  // units per mm
    double shoulder_x = 0;
    double wrist_x = 0;
    double shoulder_y = 0;
    double elbow_y = 0;
    double wrist_y = 0;
    double flange_y = 0;
};

// With the number beside it and helping lines from the arm.
std::string upright_dimension(double from_x, double from_y, double to_x, double to_y, const std::string& name,
                              double length) {
    const double x = first_dimension;
    return line(from_x, from_y, x + 8, from_y, "help") + line(to_x, to_y, x + 8, to_y, "help") +
           line(x, from_y, x, to_y, "dimension") + word(x + 14, (from_y + to_y) / 2 + 5, name + " = " + mm(length));
}

// From axis 1 or 3 to what lies beside it; `y` is the height of the dimension line.
std::string level_dimension(double from_x, double to_x, double y, double arm_y, const std::string& name,
                            double length) {
    return line(from_x, arm_y, from_x, y, "help") + line(to_x, arm_y, to_x, y, "help") +
           line(from_x, y, to_x, y, "dimension") + word(std::min(from_x, to_x) - 120, y + 5, name + " = " + mm(length));
}

std::string axis_mark(double x, double y, const std::string& name) {
    return "<circle cx=\"" + n(x) + "\" cy=\"" + n(y) + "\" r=\"7\" class=\"joint\"/>\n" + word(x - 70, y + 5, name);
}

std::string picture_of(const ArmGeometry& arm) {
    const ArmPoints p(arm);
    std::string svg = line(axis_1 - 80, ground, axis_1 + 120, ground, "ground");
    svg += line(axis_1, ground, axis_1, p.shoulder_y, "arm") +
           line(axis_1, p.shoulder_y, p.shoulder_x, p.shoulder_y, "arm");
    svg += line(p.shoulder_x, p.shoulder_y, p.shoulder_x, p.elbow_y, "arm");
    svg += line(p.shoulder_x, p.elbow_y, p.wrist_x, p.elbow_y, "arm") +
           line(p.wrist_x, p.elbow_y, p.wrist_x, p.wrist_y, "arm");
    svg += line(p.wrist_x, p.wrist_y, p.wrist_x, p.flange_y, "arm");
    svg += line(p.wrist_x - 24, p.flange_y, p.wrist_x + 24, p.flange_y, "arm");
    svg += axis_mark(p.shoulder_x, p.shoulder_y, "axis 2") + axis_mark(p.shoulder_x, p.elbow_y, "axis 3") +
           axis_mark(p.wrist_x, p.wrist_y, "axis 5");
    svg += word(axis_1 - 70, ground - 12, "axis 1") + word(p.wrist_x + 30, p.flange_y + 5, "flange");
    svg += upright_dimension(axis_1, ground, p.shoulder_x, p.shoulder_y, "c1", arm.c1);
    svg += upright_dimension(p.shoulder_x, p.shoulder_y, p.shoulder_x, p.elbow_y, "c2", arm.c2);
    svg += upright_dimension(p.shoulder_x, p.elbow_y, p.wrist_x, p.wrist_y, "c3", arm.c3);
    svg += upright_dimension(p.wrist_x, p.wrist_y, p.wrist_x, p.flange_y, "c4", arm.c4);
    svg += level_dimension(axis_1, p.shoulder_x, ground + 28, p.shoulder_y, "a1", arm.a1);
    svg += level_dimension(p.shoulder_x, p.wrist_x, p.elbow_y - 30, p.elbow_y, "a2", arm.a2);
    svg += word(first_dimension + 140, ground + 5, "b = " + mm(arm.b) + ", along y, away from the viewer");
    // The frame of the robot's base.
    svg += line(axis_1, ground, axis_1 + 70, ground, "frame") + line(axis_1, ground, axis_1, ground - 70, "frame");
    return svg + word(axis_1 + 74, ground - 6, "x") + word(axis_1 + 8, ground - 62, "z");
}

std::string table_of(const Robot& robot) {
    constexpr std::array<double, 7> columns{60, 140, 260, 340, 440, 540, 640};
    const auto row = [&](double y, const std::array<std::string, 7>& words, const std::string& style) {
        std::string svg;
        for (std::size_t i = 0; i < columns.size(); ++i) svg += word(columns[i], y, words[i], style);
        return svg;
    };
    std::string svg =
        row(table_top, {"axis", "offset deg", "sign", "min deg", "max deg", "deg/s", "at all angles zero"}, "bold");
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const JointRange& range = robot.ranges[axis];
        const auto in_degrees = [](double angle) { return significant(degrees(angle), 6); };
        const int sign = robot.geometry.sign[axis];
        svg += row(table_top + 30 * static_cast<double>(axis + 1),
                   {std::to_string(axis + 1), in_degrees(robot.geometry.offset[axis]), std::to_string(sign),
                    in_degrees(range.min), in_degrees(range.max), in_degrees(range.speed),
                    "joint " + in_degrees(sign * robot.geometry.offset[axis]) + " deg"},
                   "");
    }
    return svg;
}

}  // namespace

std::string draw_arm(const Robot& robot) {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + fixed(width, 0) + "\" height=\"" + fixed(height, 0) +
           "\" viewBox=\"0 0 " + fixed(width, 0) + " " + fixed(height, 0) +
           "\">\n<style>text{font:15px "
           "sans-serif;fill:#222}.title{font-size:22px;font-weight:bold}.bold{font-weight:bold}"
           "line{fill:none}.arm{stroke:#d55e00;stroke-width:9;stroke-linecap:round}.joint{fill:#fff;stroke:#222;"
           "stroke-width:2}.ground{stroke:#222;stroke-width:3}.dimension{stroke:#005ca9;stroke-width:2}.help{stroke:#"
           "999;"
           "stroke-width:1;stroke-dasharray:4 4}.frame{stroke:#222;stroke-width:1.5}</style>\n<rect width=\"100%\" "
           "height=\"100%\" fill=\"#fff\"/>\n" +
           word(40, 40, robot.name, "title") +
           word(40, 66,
                "Lengths in mm, from the side, straight up: all angles zero. joint = sign * (angle + offset).") +
           picture_of(robot.geometry) + table_of(robot) + "</svg>\n";
}

}  // namespace qchopper
