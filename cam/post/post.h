// Writes a program in the language of the cell's controller, as docs/developer/formats/programs.md states it.
//
// A piece is one main program and chunks, each below the lines of ProgramSettings::lines_per_chunk and half of its
// memory_bytes as long as one run is; a chunk ends only between runs, and with its direction, hold or tool. What does
// not fit into the controller's memory at once is loaded chunk by chunk where the language has words for that; else it
// becomes several parts for one clamping, each with a main program of its own. The same program gives the same bytes
// (tests/cam/post/krl_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/post/program_lines.h"
#include "cam/program/program.h"

namespace qchopper {

// What the manifest lists of a chunk besides its figures as they are read back.
struct PostedChunk {
    std::string name;               // of its file
    std::size_t order = 0;          // from 0 over all parts
    std::size_t operation = 0;      // index in Program::operations
    std::size_t tool = 0;           // index in CellMachine::tools
    std::uint16_t tool_number = 0;  // CuttingTool::number
    std::size_t orientation = 0;    // index in SurfaceAccess::orientations
    std::size_t first_run = 0;      // of the operation
    std::size_t runs = 0;
    std::vector<std::size_t> holes;  // numbers of those that its runs drill
    bool operator==(const PostedChunk&) const = default;
};

struct ProgramPart {
    std::string entry;                // name of the main program's file
    std::vector<ProgramText> files;   // of the main program, then the chunks in their order
    std::vector<PostedChunk> chunks;  // in their order
    bool operator==(const ProgramPart&) const = default;
};

struct ProgramName {
    std::uint32_t piece = 1;  // number of the piece: names are qc_<piece>, qc_<piece>_p<part>, qc_<piece>_<chunk>
};

// The name of a file, and its text, that post_program writes of the same program for a piece of another number of as
// many digits; with more digits a program may be divided elsewhere. Preconditions: both are of one that it wrote for
// the piece `from` (tests/cam/post/krl_test.cpp). O(bytes).
std::string renumbered_name(const std::string& file, std::uint32_t from, std::uint32_t to);
std::string renumbered_text(const std::string& text, std::uint32_t from, std::uint32_t to);

// At least one part. Preconditions: the cell has a machine, and the program is of it. Throws InputError (config) if the
// cell file lacks a signal, the language cannot say what the program does, or one chunk does not fit into the memory;
// InputError (use) if a value is not finite or out of range. O(moves).
std::vector<ProgramPart> post_program(const Program& program, const Cell& cell, const ProgramName& name);

}  // namespace qchopper
