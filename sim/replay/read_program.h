// Reads the program of a cell in the language of its controller.

#pragma once

#include <span>
#include <string_view>

#include "cam/cell/cell.h"
#include "sim/program/parsed_program.h"

namespace qchopper {

// As read_krl(), read_rapid() and read_ngc(), with the programs that the cell file names. Precondition: the cell has a
// machine. Throws LineRefused.
ParsedProgram read_program(Dialect dialect, std::span<const ProgramFile> files, std::string_view main,
                           const Cell& cell);

}  // namespace qchopper
