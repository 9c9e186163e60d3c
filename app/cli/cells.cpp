// Lists, shows and checks cell files, and tells where blocks can stand. O(files), beside the picture of the reach and
// the places of a block (cam/setup/placement/block_places.h).

#include <algorithm>
#include <cmath>

#include "app/cli/arguments/option_values.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/pictures/reach_picture.h"
#include "app/report/cell/cell_report.h"
#include "app/store/ready_cells.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/units.h"

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

fs::path folder_of(const CellsListArguments& arguments) {
    if (!arguments.folder.empty()) return arguments.folder;
    std::error_code error;
    const fs::path ready = ready_cells();
    const bool is_installed = !fs::is_directory("cells", error) && fs::is_directory(ready, error);
    return is_installed ? ready : fs::path("cells");
}

ListedCell listed(const fs::path& file) {
    try {
        return {file.string(), read_cell(file), {}};
    } catch (const InputError& error) {
        return {file.string(), std::nullopt, error.what()};
    }
}

Vec3 largest_stock_size(const Cell& cell) {
    const auto volume = [](const Stock& s) { return s.size.x * s.size.y * s.size.z; };
    return std::max_element(cell.stock.begin(), cell.stock.end(),
                            [&](const Stock& a, const Stock& b) { return volume(a) < volume(b); })
        ->size;
}

}  // namespace

int run(const CellsListArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    std::vector<ListedCell> cells;
    for (const fs::path& file : toml_files(folder_of(arguments))) cells.push_back(listed(file));
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

int run(const CellsReachArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    const Cell cell = read_cell(arguments.file);
    if (!cell.machine) {
        throw InputError(InputFault::use,
                         arguments.file.string() + " describes no machine, so what it holds is not known",
                         "describe it as docs/user/cell-file.md says, or ask a cell that has one: qchopper cells list");
    }
    const Vec3 block = arguments.block ? *lengths_from(*arguments.block) : largest_stock_size(cell);
    const double tilt = radians(arguments.tilt_deg);
    // So that a line of the map has at most 15 places.
    const double step = 100 * std::max(1.0, std::ceil(std::max(cell.table.size_x, cell.table.size_y) / 1500));
    const PlacesInCell places{arguments.file.string(), cell, block_places(cell, block, tilt, step, terminal.context())};
    terminal.show(lines(places), document(places));
    return places.map.best.holds() ? exit_done : exit_demand_broken;
}

}  // namespace qchopper
