// Faults in the points and feeds of straight moves, for languages in which every such line states X, Y and Z.

#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/sim/replay/mutations.h"
#include "tests/sim/replay/program_text.h"

namespace qchopper {

// How a language writes a straight move.
struct MoveText {
    std::string word;  // with which such lines begin, in lower case
    // Where the number of X, Y or Z (0, 1, 2) begins and ends.
    std::function<std::pair<std::size_t, std::size_t>(const std::string& line, int component)> span;
};

// Changes a number in place, with as many decimals as it has. Whether it is another one then.
bool change_span(std::string& line, std::pair<std::size_t, std::size_t> span, const std::function<double(double)>& f);

// Of each line that begins with the word: the number behind `before`.
program_text::Change each_number(const std::string& word, const std::string& before,
                                 const std::function<double(double)>& f);

// Adds a line before the middle one of those that begin with the word.
program_text::Change insert_among(const std::string& word, const std::string& line);

// Of all sources: one word for another, wherever it stands.
Mutation replaced(const std::string& name, const std::string& what, const std::string& by);

std::vector<Mutation> move_mutations(const MoveText& text);

}  // namespace qchopper
