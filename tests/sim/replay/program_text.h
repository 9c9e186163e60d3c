// Changes of the text of robot programs, of which the mutations are made: lines are taken apart by their first word,
// components of {...} of KRL by their names. A change says whether it has changed anything.

#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/sim/replay/mutations.h"

namespace qchopper::program_text {

using Lines = std::vector<std::string>;
using Change = std::function<bool(Lines&)>;

Lines lines_of(const std::string& text);
std::string text_of(const Lines& lines);
std::string lower(std::string text);
bool begins(const std::string& line, const std::string& word);
bool is_lin(const std::string& line);
std::vector<std::size_t> lin_places(const Lines& lines);
bool replace_first(std::string& text, std::size_t from, const std::string& what, const std::string& by);

std::string stem_of(const ProgramFile& file);
bool is_source(const ProgramFile& file);
// Whether a line calls the chunk of this name, in any of the languages; the chunk that it calls, empty: none.
bool is_call(const std::string& line, const std::string& stem);
std::string called_stem(const ProgramFiles& files, const std::string& line);
// The index of the next source that is not the main program; the number of files if there is none.
std::size_t next_chunk(const ProgramFiles& files, std::size_t from = 0);

// Where the number of a component begins and ends; npos if it is not there.
std::pair<std::size_t, std::size_t> number_at(const std::string& line, const std::string& component);
double component_of(const std::string& line, const std::string& component);  // 0: it is not there
bool change_number(std::string& line, const std::string& component, const std::function<double(double)>& f);

// Of each line that begins with the word, or states the $TOOL, $BASE or $LOAD of that name in a module: the line, its
// components, the value behind the equals sign.
Change each(const std::string& word, const std::function<bool(std::string&)>& change);
Change each_component(const std::string& word, const std::vector<std::string>& components,
                      const std::function<double(double)>& f);
Change each_value(const std::string& word, const std::function<double(double)>& f);
// Leaves out lines that begin and end so; the last or the first line alone; or adds one in the middle of the moves.
Change without(const std::string& word, const std::string& ending = {});
Change lose(const std::string& word, bool is_last);
Change insert(const std::string& line);

// A change of all sources, one after the other; of the first chunk in which there is a place; of the last chunk; of the
// main program.
Mutation everywhere(const std::string& name, const Change& change);
Mutation in_one_chunk(const std::string& name, const Change& change);
Mutation in_last_chunk(const std::string& name, const Change& change);
Mutation in_main_lines(const std::string& name, const Change& change);
// Of the configuration module of KRL, source and data.
Mutation in_module(const std::string& name, const Change& change);
// With the places of the calls of chunks in the main program.
Mutation in_main(const std::string& name,
                 const std::function<bool(ProgramFiles&, Lines&, std::vector<std::size_t>)>& change);
// Of the text of one chunk as a whole; of all files.
Mutation of_text(const std::string& name, const std::function<bool(std::string&)>& change);
Mutation of_files(const std::string& name, const std::function<std::optional<ProgramFiles>(const ProgramFiles&)>& f);

}  // namespace qchopper::program_text
