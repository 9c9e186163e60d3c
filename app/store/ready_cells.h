// The cell files that come with the program, and those that the user keeps, by their names.

#pragma once

#include <filesystem>
#include <string>

namespace qchopper {

// The folder of the cell files that come with the program: share/qchopper/cells beside the folder of the program that
// runs. It need not exist: a program that is not installed has none.
std::filesystem::path ready_cells();

// The path of the cell file that is meant by `text`: a path as it is; a name without folder and without .toml, such as
// kr60-ha, of which no file is there, is looked for as NAME.toml in the folder cells, in qchopper/cells of
// $XDG_CONFIG_HOME (~/.config if that is not set; XDG Base Directory Specification 0.8) and in ready_cells(), in this
// order. Throws InputError (missing) where none has it.
std::filesystem::path cell_file_of(const std::string& text);

}  // namespace qchopper
