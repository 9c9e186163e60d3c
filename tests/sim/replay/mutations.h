// Faults put into the text of robot programs: text in, text out, for any program of
// docs/developer/formats/programs.md.
//
// Each gives the files of a program with one fault, or nothing where the program has no place for it. Names, sizes and
// hashes are for the caller to make again.

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "sim/program/parsed_program.h"

namespace qchopper {

using ProgramFiles = std::vector<ProgramFile>;

struct Mutation {
    std::string name;
    std::function<std::optional<ProgramFiles>(const ProgramFiles&)> apply;
};

// In a fixed order. Of KRL, RAPID and NGC; those of `chunk_mutations` are for all of them.
std::vector<Mutation> all_mutations();
std::vector<Mutation> rapid_mutations();
std::vector<Mutation> ngc_mutations();
std::vector<Mutation> chunk_mutations();
std::vector<Mutation> mutations_of(Dialect dialect);

// The names of the chunks in the order in which the main program calls them, in lower case; `main` without ending.
std::vector<std::string> called_chunks(const ProgramFiles& files, const std::string& main);

}  // namespace qchopper
