// Lines of KUKA's robot language KRL: numbers, aggregates, comments, names.
//
// docs/developer/formats/programs.md says which lines there are.

#pragma once

#include <string>

#include "base/pose.h"
#include "cam/cell/arm.h"
#include "cam/post/program_lines.h"
#include "cam/program/program.h"

namespace qchopper {

class KrlText : public ProgramLines {
 public:
    KrlText() : ProgramLines(";") {}
};

namespace krl {

// "X 1.23,Y 4.56,Z 7.89" in mm, each below 5 m in size.
std::string position(Vec3 point, int decimals);
// ",A 0.000,B 90.000,C 0.000" in degrees: the rotation of a pose.
std::string angles(const Pose& pose, int decimals);
// "{X 0.000,...,C 0.0000}": as $BASE and $TOOL have it.
std::string frame(const Pose& pose);
// "A1 0.000,...,A6 0.000" in degrees.
std::string joints(const Joints& joints);
// "{M 16.200,CM {X 0.000,...},J {X 0.2716,...}}"
std::string load(const LoadData& load);
// &ACCESS to DEF. Throws InputError (use) if the name is longer than 24 characters.
void begin_program(const std::string& name, KrlText& text);
// "E1 30.000": the external axis at an angle in radians.
std::string external(int axis, double angle);

}  // namespace krl

}  // namespace qchopper
