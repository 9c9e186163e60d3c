// Reads a KUKA KRL program as the controller would execute it (docs/programs.md), written apart from what writes it.
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

struct KrlOptions {
    std::vector<std::string> calls;  // programs that the cell file names: they may be called, and are not read
};

// `main` is the name of the main program, without ending. Throws InputError (mesh) with file and line if a line is not
// one of docs/programs.md, a number is out of its range, a chunk is called not at all or twice or is missing, a file is
// truncated, or a move lacks what it needs: a chunk begins with a PTP, and before its first LIN states $TOOL, $BASE,
// $VEL.CP and $ACC.CP itself, so that it can be started again; the first LIN of a file and the first after $BASE, $TOOL
// or a PTP states X, Y, Z, A, B, C, and E1 on a rotary table.
ParsedProgram read_krl(std::span<const ProgramFile> files, std::string_view main, const KrlOptions& options = {});

}  // namespace qchopper
