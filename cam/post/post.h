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

#include "base/uuid.h"
#include "cam/cell/cell.h"
#include "cam/post/program_lines.h"
#include "cam/program/program.h"
#include "cam/setup/setup.h"

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

// Which piece of which order a program carves: names are NAME, NAME_p<part>, NAME_<chunk> and NAME_cfg, where NAME is
// qc_<order>_<piece>.
struct ProgramName {
    std::uint32_t piece = 1;  // its number
    std::string order = {};   // the first six hexadecimal digits of the project's id; empty: NAME is qc_<piece>
    bool operator==(const ProgramName&) const = default;
};

// The first six hexadecimal digits of a project's id: ProgramName::order.
std::string order_in_names(const Uuid& project_id);

// "qc_3f09a2_7", with which the names of all files of a piece begin.
std::string piece_name(const ProgramName& name);

// The name of a file, and its text, that post_program writes of the same program for another piece whose name is as
// long; with a longer one a program may be divided elsewhere. Preconditions: both are of one that it wrote for
// the piece `from` (tests/cam/post/krl_test.cpp). O(bytes).
std::string renamed_file(const std::string& file, const ProgramName& from, const ProgramName& to);
std::string renamed_text(const std::string& text, const ProgramName& from, const ProgramName& to);

// At least one part. Preconditions: the cell has a machine, and the program is of it. Throws InputError (config) if the
// cell file lacks a signal, the language cannot say what the program does, or one chunk does not fit into the memory;
// InputError (use) if a value is not finite or out of range. O(moves).
std::vector<ProgramPart> post_program(const Program& program, const Cell& cell, const ProgramName& name);

// A chunk that was posted.
struct KeptChunk {
    std::string name;               // of its file, without ending
    std::uint16_t tool_number = 0;  // CuttingTool::number
    std::size_t orientation = 0;    // index in SurfaceAccess::orientations, with those of drilling behind them
    std::size_t bytes = 0;          // of its file
};

// The files of a main program that calls the last chunks of a program which post_program wrote for this setup and this
// cell, the entry first: it asks whether those before them have ended and the block was not moved, and goes on as that
// program does. `main` is its name, without ending; `part` the part from 1 to `parts` to which the chunks belong.
// Preconditions: at least one chunk, of which the first begins at home or may be started from there; the cell has the
// tools. Throws as post_program(). O(chunks) (tests/cam/post/restart_test.cpp).
std::vector<ProgramText> post_restart(const std::vector<KeptChunk>& chunks, const Setup& setup, const Cell& cell,
                                      const ProgramName& name, const std::string& main, std::size_t part,
                                      std::size_t parts);

}  // namespace qchopper
