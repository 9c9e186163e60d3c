// Asks the file system for at most four files.

#include "app/store/ready_cells.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "base/error.h"
#include "cam/cell/cell.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// The user's folder of settings; empty: there is none.
fs::path config_folder() {
    const char* const set = std::getenv("XDG_CONFIG_HOME");
    if (set != nullptr && fs::path(set).is_absolute()) return set;
    const char* const home = std::getenv("HOME");
    return home != nullptr && fs::path(home).is_absolute() ? fs::path(home) / ".config" : fs::path();
}

}  // namespace

fs::path ready_cells() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    return program.parent_path().parent_path() / "share" / "qchopper" / "cells";
}

fs::path cell_file_of(const std::string& text) {
    std::error_code error;
    fs::path given = text;
    const bool is_path = given.has_parent_path() || given.extension() == ".toml";  // irb6640-185-2.8 is a name
    if (is_path || fs::is_regular_file(given, error)) return given;
    for (const fs::path& folder : {fs::path("cells"), config_folder() / "qchopper" / "cells", ready_cells()}) {
        fs::path file = folder / (text + ".toml");
        if (fs::is_regular_file(file, error)) return file;
    }
    throw InputError(InputFault::missing, "there is no cell file " + text + ", and no ready cell of that name here",
                     "name the file, as cells/kr60-ha.toml; qchopper cells list names those that are ready");
}

std::vector<ReadyCell> ready_cell_files(const fs::path& folder) {
    std::vector<ReadyCell> cells;
    const fs::path folders[] = {folder, folder / "cells", config_folder() / "qchopper" / "cells", ready_cells()};
    for (const fs::path& place : folders) {
        std::vector<fs::path> files;
        std::error_code error;
        for (fs::directory_iterator entry(place, error), end; !error && entry != end; entry.increment(error)) {
            if (entry->path().extension() == ".toml") files.push_back(entry->path());
        }
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files) {
            const std::string name = file.stem().string();
            const auto is_same = [&](const ReadyCell& cell) { return cell.name == name; };
            if (std::any_of(cells.begin(), cells.end(), is_same)) continue;
            try {
                cells.push_back({name, read_cell(file).name, file});
            } catch (const InputError& e) {
                if (place != folder) cells.push_back({name, e.what(), file});
            }
        }
    }
    return cells;
}

}  // namespace qchopper
