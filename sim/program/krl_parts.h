// What the sources of the KRL reader share: a file cut into lines, the aggregates of a line, and the assignments that
// change modal values.
//
// For krl_*.cpp only; O(bytes read) each (tests/sim/program/krl_reader_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
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
    bool is_public = false;               // of a .dat: its data are for all programs
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

// krl_config.cpp: the configuration module of a program.

enum class KrlRoutineKind : std::uint8_t {
    stopped,  // switches off, and never returns
    fallen,   // stops the arm, switches off, retracts the tool and never returns
    ask,      // a dialog with its argument, which is waited for
    say       // a message
};

struct KrlRoutine {
    KrlRoutineKind kind = KrlRoutineKind::stopped;
    std::set<std::string> switched_off;  // numbers of outputs, and programs that are called
    std::size_t line = 0;                // of its END, from 1
    Vec3 retract;                        // mm, in the frame of the tool
    std::size_t retract_line = 0;
};

struct KrlModule {
    std::string source;  // its file; empty: there is no module
    std::map<std::string, ProgramFrame> frames;
    std::map<std::string, ProgramLoad> loads;
    std::map<std::string, KrlRoutine> routines;
};

// `calls` in lower case: programs that a routine may call. Refused, with the line: anything else than
// docs/developer/formats/programs.md states of a module.
KrlModule read_krl_module(const KrlFile& source, const KrlFile& data, const std::vector<std::string>& calls);

// {...}, or the name of one that the module states.
ProgramFrame read_frame(ProgramLine& line, const KrlModule& module);
ProgramLoad read_load(ProgramLine& line, const KrlModule& module);

// The number of an output that is switched on or off behind "$OUT": [n] = TRUE or FALSE.
struct KrlOutput {
    std::uint32_t number = 0;
    bool is_on = false;
};
KrlOutput read_output(ProgramLine& line);

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
    bool table_speed = false;
    bool table_acceleration = false;
    bool pose = false;  // the LIN may leave out what stays
};

// `name` is the word that the line begins with, with its $; the line stands behind it. Whether it is a modal value,
// which is then read and put into `state`; anything wrong in it is refused.
bool read_assignment(const std::string& name, ProgramLine& line, const KrlModule& module, ModalState& state,
                     StatedHere& stated);

}  // namespace qchopper
