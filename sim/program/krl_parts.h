// What the sources of the KRL reader share: a file cut into lines, the aggregates of a line, and the assignments that
// change modal values.
//
// For krl_*.cpp only; O(bytes read) each (tests/sim/program/krl_reader_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/units.h"
#include "sim/program/parsed_program.h"
#include "sim/program/program_line.h"

namespace qchopper {

// krl_file.cpp

// A .src or .dat file cut into lines, with what does not depend on its meaning checked.
struct KrlFile {
    const std::string* name = nullptr;    // with ending, as given
    std::string stem;                     // in lower case, without ending
    bool is_source = false;               // .src; else .dat
    std::vector<std::string_view> lines;  // without their ends
    std::size_t first = 0;                // line after DEF or DEFDAT, counted from 0
    std::size_t end = 0;                  // the line with END or ENDDAT, counted from 0
};

// Refused, with the line: a name that is not a letter, then letters, digits and _, at most 24 characters, then .src or
// .dat; a character outside of 32..126; a line that does not end with CR LF; a head other than &ACCESS RVP, &REL and
// &PARAM lines (of a .dat it may be missing); a DEF or DEFDAT with another name; no END or ENDDAT, or anything behind
// it. The file must outlive the result.
KrlFile read_krl_file(const ProgramFile& file);

// Whether a line says nothing: it is empty or a comment.
bool is_krl_comment(std::string_view line);

// krl_aggregate.cpp: {X 1.00,Y 2.00,...}, read by the names of the components in any order.

// Components in the order of this table; a bit of `given` for each that was stated. external: E1 to E6, of which an
// aggregate has one at most.
enum class KrlComponent : std::uint8_t { x, y, z, a, b, c, a1, a2, a3, a4, a5, a6, external };

struct KrlAggregate {
    std::array<double, 13> value{};  // mm and degrees, as written
    std::uint32_t given = 0;
    std::uint32_t external_axis = 0;  // n of En; 0: none is given
    bool has(KrlComponent component) const { return (given >> static_cast<unsigned>(component) & 1U) != 0; }
    double operator[](KrlComponent component) const { return value[static_cast<std::size_t>(component)]; }
};

constexpr std::uint32_t krl_position = 0b111;       // X, Y, Z
constexpr std::uint32_t krl_frame = 0b111111;       // and A, B, C
constexpr std::uint32_t krl_axes = 0b111111 << 6U;  // A1..A6
constexpr std::uint32_t krl_external = 1U << 12U;   // E1 to E6

// From "{" to "}". A component that is unknown, doubled or out of range is refused: 5 m, 180 degrees of A, B, C, 720
// degrees of an axis.
KrlAggregate read_aggregate(ProgramLine& line);

// The frame of an aggregate with all of krl_frame and nothing else; others are refused.
ProgramFrame read_frame(ProgramLine& line);

// {M m,CM {X x,Y y,Z z,A a,B b,C c},J {X x,Y y,Z z}}
ProgramLoad read_load(ProgramLine& line);

// krl_assignment.cpp

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
bool read_assignment(const std::string& name, ProgramLine& line, ModalState& state, StatedHere& stated);

}  // namespace qchopper
