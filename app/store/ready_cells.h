// The cell files that come with the program, and those that the user keeps, by their names.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace qchopper {

// The folder of the cell files that come with the program: share/qchopper/cells beside the folder of the program that
// runs. It need not exist: a program that is not installed has none.
std::filesystem::path ready_cells();

// The path of the cell file that is meant by `text`: a path as it is; a name without folder and without .toml, such as
// kr60-ha, of which no file is there, is looked for as NAME.toml in the folder cells, in qchopper/cells of
// $XDG_CONFIG_HOME (~/.config if that is not set; XDG Base Directory Specification 0.8) and in ready_cells(), in this
// order. Throws InputError (missing) where none has it.
std::filesystem::path cell_file_of(const std::string& text);

// A cell file that can be chosen by name.
struct ReadyCell {
    std::string name;      // of the file, without .toml
    std::string sentence;  // the name that the file gives the cell, or why it cannot be read
    std::filesystem::path path;
};

// Those of `folder`, of its folder cells, of qchopper/cells of the user's settings, and of ready_cells(), in this order
// and by name; of two with the same name the first. A file of `folder` that is no cell file is left out.
std::vector<ReadyCell> ready_cell_files(const std::filesystem::path& folder);

}  // namespace qchopper
