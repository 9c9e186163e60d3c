// Words of ABB's robot language RAPID: aggregates, signals, messages.
//
// docs/developer/formats/programs.md says which lines there are. Quaternions are normalised, w first, with 8 decimals.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/pose.h"
#include "cam/cell/arm.h"
#include "cam/cell/cell.h"
#include "cam/post/program_lines.h"

namespace qchopper {

class RapidText : public ProgramLines {
 public:
    RapidText() : ProgramLines("!") {}
};

namespace rapid {

constexpr std::size_t longest_name = 32;

// "%%%" to MODULE. Throws InputError (use) if the name is too long.
void begin_module(const std::string& name, ProgramLines& text);

// "-120.91,-86.95,151.10", each below 5 m in size.
std::string position(Vec3 point, int decimals = 2);
// "[1.00000000,0.00000000,0.00000000,0.00000000]"
std::string quaternion(const Pose& pose);
// "[[x,y,z],[q1,q2,q3,q4]]": as a tool or a work object has it.
std::string frame(const Pose& pose);
// "[9E9,9E9,9E9,9E9,9E9,9E9]" with the angle of the external axis, in radians, in its place.
std::string external_axes(std::optional<int> axis, double angle);
// "[0,-1,0,0]": quarter turns of axes 1, 4 and 6.
std::string configuration(const Joints& joints);

// Lines that switch a signal of the cell file, or call its program. Nothing for a signal that is not there.
void switch_signal(const std::optional<Signal>& signal, bool is_on, ProgramLines& text);
void set_speed(const Signal& signal, double rpm, ProgramLines& text);

// The question to a person, in lines of at most 80 characters, and the key that answers it; `key` is a num.
void ask(std::string_view question, const std::string& key, ProgramLines& text);

}  // namespace rapid

}  // namespace qchopper
