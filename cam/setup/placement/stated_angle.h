// Angles of placements and tables as documents state them.
//
// An angle in radians that is written in degrees and read again loses its last bit in about half of all cases, and what
// is read must be what was written (tests/cam/job/envelope_document_test.cpp): so those that are searched are moved to
// the nearest that does not, by less than 1e-14 radians.

#pragma once

#include <cmath>

#include "base/units.h"

namespace qchopper {

// Degrees with twelve decimals.
inline double degrees_to_twelve(double angle_rad) {
    return std::round(degrees(angle_rad) * 1e12) / 1e12;
}

// The angle that is read where its stated_degrees() were written.
inline double stated_angle(double angle_rad) {
    return radians(degrees_to_twelve(angle_rad));
}

// In degrees: degrees_to_twelve() where these are read as the same angle, else all digits.
inline double stated_degrees(double angle_rad) {
    return stated_angle(angle_rad) == angle_rad ? degrees_to_twelve(angle_rad) : degrees(angle_rad);
}

}  // namespace qchopper
