// Lists, shows and checks cell files. O(files), beside the picture of the reach.

#include <algorithm>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/report/cell_report.h"
#include "app/report/reach_picture.h"
#include "base/error.h"
#include "base/file.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// The TOML files of a folder, by name.
std::vector<fs::path> toml_files(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        if (entry->path().extension() == ".toml") files.push_back(entry->path());
    }
    if (error) {
        throw InputError(InputFault::missing, folder.string() + ": cannot be read as a folder: " + error.message(),
                         "name the folder of the cell files: qchopper cells list FOLDER");
    }
    if (files.empty()) {
        throw InputError(InputFault::missing, folder.string() + ": no cell file in it, NAME.toml",
                         "name the folder of the cell files: qchopper cells list FOLDER");
    }
    std::sort(files.begin(), files.end());
    return files;
}

ListedCell listed(const fs::path& file) {
    try {
        return {file.string(), read_cell(file), {}};
    } catch (const InputError& error) {
        return {file.string(), std::nullopt, error.what()};
    }
}

}  // namespace

int run(const CellsListArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    std::vector<ListedCell> cells;
    for (const fs::path& file : toml_files(arguments.folder)) cells.push_back(listed(file));
    terminal.show(lines(cells), document(cells));
    const bool is_sound = std::all_of(cells.begin(), cells.end(), [](const ListedCell& row) { return !!row.cell; });
    return is_sound ? exit_done : exit_config;
}

int run(const CellsShowArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    if (arguments.out && arguments.out->extension() != ".png") {
        throw InputError(InputFault::use, arguments.out->string() + " does not end in .png", "name a .png file");
    }
    const Cell cell = read_cell(arguments.file);
    ShownCell shown{arguments.file.string(), cell, std::nullopt};
    if (arguments.out) {
        const ReachMap map = reach_map(cell, pictured_tilts());
        write_file(*arguments.out, to_png(draw_reach(cell, map)));
        shown.picture = ReachPicture{arguments.out->string(), map.section.y, map.section.step};
    }
    terminal.show(lines(shown), document(shown));
    return exit_done;
}

int run(const CellsCheckArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    const Cell cell = read_cell(arguments.file);
    const CheckedCell checked{arguments.file.string(), cell, check_cell(cell)};
    terminal.show(lines(checked), document(checked));
    return checked.check.may_be_dispatched() ? exit_done : exit_demand_broken;
}

}  // namespace qchopper
