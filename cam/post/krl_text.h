// Lines of KUKA's robot language KRL: numbers, aggregates, comments, names.
//
// Numbers have a point and a fixed number of decimals, under every locale: never an exponent, never "-0.00", and what
// is not finite or out of range is refused (tests/cam/post/krl_text_test.cpp). Lines end with CR LF.
// docs/developer/formats/programs.md says which lines there are.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/pose.h"
#include "cam/cell/arm.h"

namespace qchopper {

// Lines of a file and how many there are.
class KrlText {
 public:
    void line(std::string_view text);
    // A comment; what is not printable ASCII becomes _.
    void comment(std::string_view text);
    void append(const KrlText& other);

    const std::string& bytes() const { return bytes_; }
    std::size_t lines() const { return lines_; }

 private:
    std::string bytes_;
    std::size_t lines_ = 0;
};

namespace krl {

// With so many decimals, rounded half away from zero. Throws InputError (use) that names what is not finite or not
// below `largest` in size.
std::string number(std::string_view what, double value, int decimals, double largest);

// "X 1.23,Y 4.56,Z 7.89" in mm, each below 5 m in size.
std::string position(Vec3 point, int decimals);
// ",A 0.000,B 90.000,C 0.000" in degrees: the rotation of a pose.
std::string angles(const Pose& pose, int decimals);
// "{X 0.000,...,C 0.0000}": as $BASE and $TOOL have it.
std::string frame(const Pose& pose);
// "A1 0.000,...,A6 0.000" in degrees.
std::string joints(const Joints& joints);
// "E1 30.000": the external axis at an angle in radians.
std::string external(int axis, double angle);

}  // namespace krl

}  // namespace qchopper
