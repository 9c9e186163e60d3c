// Reads a KUKA KRL program as the controller would execute it (docs/developer/formats/programs.md), written apart from
// what writes it.
//
// Words without regard to case; modal values; calls executed in their order. What cannot be interpreted is an error
// with file and line, never skipped. O(bytes); any bytes are read or refused (tests/sim/program/krl_reader_test.cpp,
// tests/fuzz/fuzz_krl.cpp).

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/program/parsed_program.h"

namespace qchopper {

// `main` is the name of the main program, without ending; `calls` are programs that the cell file names: they may be
// called, and are not read. Throws LineRefused (program_line.h) if a line is not
// one of docs/developer/formats/programs.md, a number is out of its range, a chunk is called not at all or twice or is
// missing, a file is truncated, or a move lacks what it needs: a chunk states $VEL_AXIS, $ACC_AXIS and $LOAD itself
// before its first move, which is a PTP, $TOOL, $BASE, $VEL.CP, $ACC.CP, $VEL.ORI1 and $VEL.ORI2 before its first LIN,
// and $APO.CDIS before its first C_DIS, so that it can be started alone; the first LIN of a file and the first after
// $BASE, $TOOL or a PTP states X, Y, Z, A, B, C, and E1 on a rotary table. Behind a LIN with C_DIS the next move of its
// file is a LIN.
ParsedProgram read_krl(std::span<const ProgramFile> files, std::string_view main,
                       const std::vector<std::string>& calls = {});

}  // namespace qchopper
