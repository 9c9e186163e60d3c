// Reads an ABB RAPID program as the controller would execute it (docs/developer/formats/programs.md), written apart
// from what writes it.
//
// Words without regard to case; one statement a line. What cannot be interpreted is an error with file and line, never
// skipped. O(bytes); any bytes are read or refused (tests/sim/program/rapid_reader_test.cpp,
// tests/fuzz/fuzz_rapid.cpp).

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/program/parsed_program.h"

namespace qchopper {

// `main` is the name of the main module, without ending; `calls` are programs that the cell file names: they may be
// called, and are not read. Throws LineRefused (program_line.h) if a line is not one of
// docs/developer/formats/programs.md, a number is out of its range, a quaternion is not normalised, a module is called
// not at all or twice or is missing, a file is truncated, or a move lacks what it needs: a chunk states ConfL\Off,
// VelSet and AccSet itself before its first move, which is a MoveAbsJ, and PathAccLim, v_tcp of its speeddata and,
// where a corner is rounded, pzone_tcp of its zonedata before a MoveL. Behind a MoveL that is rounded the next move is
// a MoveL. Where the main module has a trap, a chunk connects it to the signal that it waits for before its first
// MoveL, nothing is switched off and nobody is asked while it is connected, and the trap switches off what the main
// program switches off.
ParsedProgram read_rapid(std::span<const ProgramFile> files, std::string_view main,
                         const std::vector<std::string>& calls = {});

}  // namespace qchopper
