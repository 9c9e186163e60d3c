// Reads a program in RS-274/NGC for a gantry of three axes as the controller would execute it
// (docs/developer/formats/programs.md), written apart from what writes it.
//
// Words without regard to case. What cannot be interpreted is an error with file and line, never skipped. O(bytes); any
// bytes are read or refused (tests/sim/program/ngc_reader_test.cpp, tests/fuzz/fuzz_ngc.cpp).

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/program/parsed_program.h"

namespace qchopper {

// `main` is the name of the main program, without ending; `calls` are subprograms that the cell file names: they may be
// called, and are not read. Throws LineRefused (program_line.h) if a line is not one of
// docs/developer/formats/programs.md, a number is out of its range, a subprogram is called not at all or twice or is
// missing, a file is truncated, or a move lacks what it needs: every file states G21, on a line of its own, G90, G17,
// G94, G40 and G54 before its first move, G43 H before it and behind every tool change, G61 or G64 P and F before its
// first G1. Inches, other planes, work offsets, distance and feed modes, cutter compensation, arcs and G64 without P
// are not known. G0 moves Z alone or X and Y. Behind a G1 that is rounded the next move is a G1.
ParsedProgram read_ngc(std::span<const ProgramFile> files, std::string_view main,
                       const std::vector<std::string>& calls = {});

}  // namespace qchopper
