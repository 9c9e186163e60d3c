// The drawing of an arm states its lengths, as SVG that is well-formed for any name.

#include "app/pictures/arm_drawing.h"

#include <gtest/gtest.h>

#include "cam/cell/known_arms.h"

namespace qchopper {
namespace {

Robot robot_of(const char* id) {
    const KnownArm& arm = known_arm(id);
    Robot robot;
    robot.name = arm.name;
    robot.geometry = geometry_of(arm);
    robot.ranges = ranges_of(arm);
    return robot;
}

TEST(ArmDrawing, StatesEveryLengthAndEveryAxis) {
    const std::string svg = draw_arm(robot_of("irb6640-185-2.8"));
    for (const char* text : {"a1 = 320<", "a2 = -200<", "b = 0,", "c1 = 780<", "c2 = 1075<", "c3 = 1392<", "c4 = 200<",
                             ">ABB IRB 6640-185/2.8<", ">-90<", ">joint -90 deg<", ">-300<"}) {
        EXPECT_NE(svg.find(text), std::string::npos) << text;
    }
}

TEST(ArmDrawing, NoNameBreaksTheFile) {
    Robot robot = robot_of("kr60-ha");
    robot.name = "<arm & \"co\">";
    const std::string svg = draw_arm(robot);
    EXPECT_NE(svg.find("&lt;arm &amp; &quot;co&quot;&gt;"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

// Every line and word of every known arm lies in the picture.
TEST(ArmDrawing, NothingLiesOutside) {
    for (const KnownArm& arm : known_arms()) {
        const std::string svg = draw_arm(robot_of(std::string(arm.id).c_str()));
        for (const std::string key : {" x1=\"", " x2=\"", " x=\""}) {
            for (std::size_t at = svg.find(key); at != std::string::npos; at = svg.find(key, at + 1)) {
                const double x = std::stod(svg.substr(at + key.size()));
                EXPECT_GE(x, 0) << arm.id;
                EXPECT_LE(x, 1000) << arm.id;
            }
        }
        for (const std::string key : {" y1=\"", " y2=\"", " y=\""}) {
            for (std::size_t at = svg.find(key); at != std::string::npos; at = svg.find(key, at + 1)) {
                const double y = std::stod(svg.substr(at + key.size()));
                EXPECT_GE(y, 0) << arm.id;
                EXPECT_LE(y, 1120) << arm.id;
            }
        }
    }
}

}  // namespace
}  // namespace qchopper
