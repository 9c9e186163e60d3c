// Numbers, angles and comments of KRL.

#include "cam/post/krl_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <numbers>
#include <sstream>

#include "base/error.h"
#include "cam/cell/cell.h"
#include "cam/cell/kuka_angles.h"
#include "tests/cam/post/scanned_krl.h"

namespace qchopper {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(KrlNumber, HasFixedDecimalsAndNoMinusZero) {
    EXPECT_EQ(written_number("X", 1.005, 2, 5000), "1.00");
    EXPECT_EQ(written_number("X", -12.345678, 2, 5000), "-12.35");
    EXPECT_EQ(written_number("X", -0.004, 2, 5000), "0.00");
    EXPECT_EQ(written_number("X", -0.0, 3, 5000), "0.000");
    EXPECT_EQ(written_number("X", 1e-20, 4, 5000), "0.0000");
    EXPECT_EQ(written_number("X", 4999.999, 2, 5000), "5000.00");
}

TEST(KrlNumber, RefusesWhatIsNotFiniteOrTooLarge) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 5000.0, -5000.0, 1e300}) {
        try {
            written_number("coordinate X", bad, 2, 5000);
            ADD_FAILURE() << bad;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("coordinate X"), std::string::npos);
        }
    }
}

TEST(KrlNumber, KnowsNoLocale) {
    const test_krl::CommaLocale comma;
    std::ostringstream stream;
    stream << 1234.5;
    EXPECT_EQ(stream.str(), "1.234,5");
    EXPECT_EQ(written_number("X", 1234.5, 2, 5000), "1234.50");
}

// Poses of a KR 120 R2500 pro.
TEST(KrlAngles, AreThoseOfKnownPoses) {
    const Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr120-r2500-pro-rotary.toml");
    const auto flange = [&](Joints joints) {
        for (double& joint : joints) joint *= degree;
        return forward(cell.machine->robot->geometry, joints);
    };
    EXPECT_EQ(krl::position(flange({0, -90, 90, 0, 0, 0}).shift, 2) + krl::angles(flange({0, -90, 90, 0, 0, 0}), 3),
              "X 1565.00,Y 0.00,Z 1784.00,A 0.000,B 90.000,C 0.000");
    EXPECT_EQ(krl::position(flange({0, -90, 90, 0, 90, 0}).shift, 2), "X 1350.00,Y 0.00,Z 1569.00");
    const std::string down = krl::angles(flange({0, -90, 90, 0, 90, 0}), 3);
    EXPECT_TRUE(down == ",A 180.000,B 0.000,C 180.000" || down == ",A -180.000,B 0.000,C 180.000") << down;
    EXPECT_EQ(krl::position(flange({30, -60, 80, 20, 45, -70}).shift, 3), "X 1658.134,Y -1017.365,Z 1104.141");
}

KukaAngles read_back(const std::string& text) {
    KukaAngles abc;
    EXPECT_EQ(std::sscanf(text.c_str(), ",A %lf,B %lf,C %lf", &abc.a, &abc.b, &abc.c), 3) << text;
    return {abc.a * degree, abc.b * degree, abc.c * degree};
}

double apart(const Pose& a, const Pose& b) {
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) largest = std::max(largest, norm(a.row[i] - b.row[i]));
    return largest;
}

TEST(KrlAngles, GiveTheSameRotationAtTheGimbalAndBesideIt) {
    for (const double sign : {1.0, -1.0}) {
        for (const double beside : {0.0, 1e-10, 1e-6, 1e-4, 2e-4, 4e-4, 6e-4, 1e-3, 0.1}) {
            for (const double a : {-170.0, -30.0, 0.0, 12.3, 155.0}) {
                for (const double c : {-140.0, 0.0, 77.7, 180.0}) {
                    const Pose pose = pose_of({a * degree, sign * (90 - beside) * degree, c * degree}, {});
                    const std::string text = krl::angles(pose, 3);
                    EXPECT_LT(apart(pose_of(read_back(text), {}), pose), 3e-5) << text;
                    const bool is_upright = text.find("90.000") != std::string::npos;
                    EXPECT_TRUE(!is_upright || text.ends_with(",C 0.000")) << text;
                    EXPECT_EQ(text.find("-180.000"), std::string::npos) << text;
                }
            }
        }
    }
}

TEST(KrlText, CommentsAreAscii) {
    KrlText text;
    text.comment("a ball of \xc3\xa9\t20 mm");
    EXPECT_EQ(text.bytes(), ";a ball of ___20 mm\r\n");
    EXPECT_EQ(text.lines(), 1U);
}

}  // namespace
}  // namespace qchopper
