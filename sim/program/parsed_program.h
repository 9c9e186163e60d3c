// A robot program as its text says it, read back: what the arm would do, in the order in which it would do it.
//
// Values only; mm, radians, seconds, kg. What a step needs of the lines before it is in its modal state, so that a step
// is complete without them. Nothing here is shared with what writes programs (docs/developer/formats/programs.md).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace qchopper {

// A file of a job, by its name with ending.
struct ProgramFile {
    std::string name;
    std::string text;
};

// Where a line stands: the number of the file in ParsedProgram::files, and the line from 1.
struct SourcePlace {
    std::uint32_t file = 0;
    std::uint32_t line = 0;
    bool operator==(const SourcePlace&) const = default;
};

// X, Y, Z and A, B, C: turns about z, y, x, so that R = Rz(a) Ry(b) Rx(c).
struct ProgramFrame {
    Vec3 shift;
    Vec3 abc;  // radians
    bool operator==(const ProgramFrame&) const = default;
};

// The load that the controller reckons with.
struct ProgramLoad {
    double mass_kg = 0;
    ProgramFrame centre;
    Vec3 inertia;  // kg m2
    bool operator==(const ProgramLoad&) const = default;
};

// The values that hold until a line changes them.
struct ModalState {
    std::optional<ProgramFrame> tool;
    std::optional<ProgramFrame> base;
    std::uint32_t base_machine = 0;  // n of MACHINE_DEF[n] to which the base is chained; 0: it is constant
    std::optional<ProgramLoad> load;
    double feed = 0;                     // of the tip, mm/s; 0: not stated
    double acceleration = 0;             // of the tip, mm/s2; 0: not stated
    std::array<double, 2> turn_speed{};  // of the orientation, radians/s
    std::array<double, 6> axis_speed{};  // share of the largest, 0..1; 0: not stated
    std::array<double, 6> axis_acceleration{};
    double table_speed = 0;  // of the external axis, as axis_speed
    double table_acceleration = 0;
    double rounding = 0;  // distance from the corner, as $APO.CDIS; of a gantry the deviation, P of G64
    int look_ahead = -1;  // $ADVANCE; -1: not stated
    // Of a program for a gantry: the tool that was changed in last, and the tool whose length is taken from the
    // controller's table; 0: none.
    std::uint32_t tool_number = 0;
    std::uint32_t length_register = 0;
    bool operator==(const ModalState&) const = default;
};

enum class StepKind : std::uint8_t {
    joint_move,   // values: axes 1..6; e1 if the cell has a rotary table
    linear_move,  // values: X, Y, Z in mm, A, B, C
    rapid_move,   // of a gantry: values and `given`
    output,       // number or text; value 1 or 0
    analog_output,
    wait_input,
    spindle,      // of a gantry, by words of its language: value in revolutions/min; 0: off
    dwell,        // value in seconds
    tool_change,  // number of the tool
    halt,         // text: what the operator is asked
    call          // text: name, in lower case, of a program of the cell; value if it has an argument
};

struct ProgramStep {
    StepKind kind = StepKind::halt;
    bool is_rounded = false;  // linear_move: the corner at its end may be rounded
    bool has_argument = false;
    std::uint8_t given = 0b111;  // rapid_move: bits of X, Y and Z, of which the others stay
    std::uint32_t number = 0;    // of the input or output; 0: it has a name, which is text
    SourcePlace place;
    std::uint32_t state = 0;  // index in ParsedProgram::states
    std::uint32_t text = 0;   // index in ParsedProgram::texts
    std::uint32_t hole = 0;   // that the last comment ";hole N" before it in its file names; 0: there is none
    std::array<double, 6> values{};
    std::optional<double> e1;  // radians; of a linear_move the last one stated
    double value = 0;
};

// The steps of one file in a row: of a chunk all of them, of the main program those between two calls.
struct ProgramChunk {
    std::uint32_t file = 0;
    std::size_t first = 0;  // steps first..end-1
    std::size_t end = 0;
    bool is_main = false;
    std::uint32_t end_line = 0;  // with the END of the file
    // Of a chunk: the line of the comment ";start from home: free"; 0: there is none.
    std::uint32_t free_from_home = 0;
    // Of a chunk, as the comment ";operation WORDS" says: "roughing", "finishing", "fine finishing" or "drilling";
    // "unknown" without one or with other words.
    std::string operation = "unknown";
};

// In what a reader returns every index is valid, every number is finite, and every linear_move has a feed and, of a
// robot, a tool and a base; of a gantry the base is the work offset, and the tool has a number.
struct ParsedProgram {
    std::vector<std::string> files;
    std::vector<std::string> texts;
    std::vector<ModalState> states;
    std::vector<ProgramStep> steps;    // in the order of execution
    std::vector<ProgramChunk> chunks;  // in the order of execution; they cover the steps
    // By how much the tool is retracted, mm in its frame, where a signal has fallen; nothing: the program retracts
    // none.
    std::optional<Vec3> retract;
    SourcePlace retract_place;
};

// The number or the name, in lower case, of the input or output of a step.
inline std::string signal_of(const ParsedProgram& program, const ProgramStep& step) {
    return step.number > 0 ? std::to_string(step.number) : program.texts[step.text];
}

}  // namespace qchopper
