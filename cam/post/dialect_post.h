// What a language has to write for post_program(): runs, chunks and main programs. One class for each dialect.

#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/post/program_lines.h"
#include "cam/program/program.h"

namespace qchopper {

// Runs of one operation.
struct RunRange {
    std::size_t operation = 0;
    std::size_t first = 0;
    std::size_t count = 0;
};

// A chunk as the main program calls it.
struct CalledChunk {
    std::string name;  // of its file, without ending
    RunRange range;
    std::size_t bytes = 0;
};

// A main program and what it calls.
struct MainProgram {
    std::string name;  // of its file, without ending
    std::size_t part = 0;
    std::size_t parts = 1;
    std::vector<CalledChunk> chunks;
    std::string question = {};  // that the operator is asked before the first move; empty: none
};

class DialectPost {
 public:
    virtual ~DialectPost() = default;

    virtual const char* ending() const = 0;  // of the entry and of chunks: ".src"
    // Whether main programs load chunks one at a time where they do not fit into the memory together.
    virtual bool loads_chunks() const { return false; }
    // One run alone, with all that it may have to state.
    virtual ProgramLines run(const ProgramOperation& operation, const ProgramRun& run) const = 0;
    // The whole text of a chunk. `order` counts from 0 over all parts; `total` is their number.
    virtual ProgramLines chunk(const RunRange& range, const std::string& name, std::size_t order,
                               std::size_t total) const = 0;
    // The files of a main program, the entry first.
    virtual std::vector<ProgramText> main(const MainProgram& main) const = 0;
};

// Both outlive the result. `piece` is the name of the piece in programs: "qc_7". Throw InputError (config) if the cell
// file lacks a signal, or the language cannot say what the program does.
std::unique_ptr<DialectPost> krl_post(const Program& program, const Cell& cell, const std::string& piece);
std::unique_ptr<DialectPost> rapid_post(const Program& program, const Cell& cell, const std::string& piece);
std::unique_ptr<DialectPost> ngc_post(const Program& program, const Cell& cell, const std::string& piece);

// That of the cell's language.
std::unique_ptr<DialectPost> post_in_dialect(const Program& program, const Cell& cell, const std::string& piece);

}  // namespace qchopper
