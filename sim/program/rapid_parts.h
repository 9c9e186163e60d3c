// What the sources of the RAPID reader share: a module cut into its parts, and the aggregates of a line.
//
// For rapid_*.cpp only; O(bytes read) each (tests/sim/program/rapid_reader_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/program/parsed_program.h"
#include "sim/program/program_line.h"

namespace qchopper {

// rapid_module.cpp

// Line numbers count from 0.
struct RapidModule {
    const std::string* name = nullptr;    // of the file, with ending, as given
    std::string stem;                     // of the file, in lower case, and the name of the module
    std::vector<std::string_view> lines;  // without their ends
    std::size_t data = 0;                 // first line behind MODULE
    std::size_t first = 0;                // line behind PROC
    std::size_t end = 0;                  // line with ENDPROC
    std::string procedure;                // in lower case
    std::string trap;                     // in lower case; empty: there is none
    std::size_t trap_first = 0;           // line behind TRAP
    std::size_t trap_end = 0;             // line with ENDTRAP
};

bool is_rapid_comment(std::string_view line);

// Refused, with the line: a name that is not a letter, then letters, digits and _, at most 32 characters, then .mod;
// what program_lines_of() refuses; another head; a MODULE with another name; more than one PROC and one TRAP; a missing
// end, or anything behind it. The file must outlive the result.
RapidModule read_rapid_module(const ProgramFile& file);

// rapid_data.cpp

struct RapidTool {
    ProgramFrame frame;
    ProgramLoad load;
};

struct RapidWork {
    ProgramFrame base;
    std::uint32_t unit = 0;  // n of "STNn", whose external axis it is; 0: it stands
};

struct RapidSpeed {
    double tcp = 0;   // mm/s
    double turn = 0;  // radians/s
};

struct RapidTarget {
    Vec3 point;
    Vec3 abc;
    std::uint32_t external_axis = 0;  // that is given; 0: none
    double external = 0;              // radians
};

void need_assignment(ProgramLine& line);  // :=
RapidTool read_tooldata(ProgramLine& line);
RapidWork read_wobjdata(ProgramLine& line);
RapidSpeed read_speeddata(ProgramLine& line);
double read_zonedata(ProgramLine& line);  // the zone of the tip, mm
RapidTarget read_robtarget(ProgramLine& line);
// [[a1,..,a6],[e1,..,e6]]: the axes in radians; point and abc are not set.
std::array<double, 6> read_jointtarget(ProgramLine& line, RapidTarget& external);

}  // namespace qchopper
