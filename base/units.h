// Degrees and radians: the one place that converts them (tests/architecture/together_test.py).
//
// Angles are radians inside the program; degrees stand in files, options, programs and texts. The forms differ by
// rounding: x * degree and radians(x) are not always the same bits.

#pragma once

#include <numbers>

namespace qchopper {

constexpr double degree = std::numbers::pi / 180;  // in radians
constexpr double degrees_per_radian = 180 / std::numbers::pi;

constexpr double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

constexpr double degrees(double radians) {
    return radians * 180 / std::numbers::pi;
}

}  // namespace qchopper
