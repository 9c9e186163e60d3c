// The assignments of a KRL program that change modal values.
//
// O(line) (tests/sim/program/krl_reader_test.cpp).

#pragma once

#include <array>
#include <string>

#include "sim/program/krl_line.h"
#include "sim/program/parsed_program.h"

namespace qchopper {

// What one file has stated itself, and what its next LIN must repeat.
struct StatedHere {
    bool tool = false;
    bool base = false;
    bool load = false;
    bool feed = false;
    bool acceleration = false;
    bool rounding = false;
    std::array<bool, 2> turn_speed{};
    std::array<bool, 6> axis_speed{};
    std::array<bool, 6> axis_acceleration{};
    bool pose = false;  // the LIN may leave out what stays
};

// `name` is the word that the line begins with, with its $; the line stands behind it. Whether it is a modal value,
// which is then read and put into `state`; anything wrong in it is refused.
bool read_assignment(const std::string& name, KrlLine& line, ModalState& state, StatedHere& stated);

}  // namespace qchopper
