// Makes, lists, shows and checks cell files, and tells where blocks can stand. O(files), beside the picture of the
// reach and the places of a block (cam/setup/placement/block_places.h).

#include <algorithm>
#include <cmath>

#include "app/cli/arguments/option_values.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/pictures/arm_drawing.h"
#include "app/pictures/reach_picture.h"
#include "app/report/cell/arm_report.h"
#include "app/report/cell/cell_report.h"
#include "app/store/ready_cells.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/units.h"
#include "cam/cell/new_cell/new_cell.h"

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

const Robot& robot_of(const fs::path& file, const Cell& cell) {
    if (cell.machine && cell.machine->robot) return *cell.machine->robot;
    throw InputError(InputFault::use, file.string() + " describes no robot",
                     "name the cell file of a robot: qchopper cells list");
}

void check_ending(const fs::path& file, const std::string& ending) {
    if (file.extension() == ending) return;
    throw InputError(InputFault::use, file.string() + " does not end in " + ending, "name a " + ending + " file");
}

void write_drawing(const CellsShowArguments& arguments, const Cell& cell) {
    check_ending(*arguments.drawing, ".svg");
    write_file(*arguments.drawing, draw_arm(robot_of(arguments.file, cell)));
}

TaughtPoseCheck poses_checked(const CellsCheckArguments& arguments, const Cell& cell) {
    const Robot& robot = robot_of(arguments.file, cell);
    if (arguments.poses.size() < 2) {
        throw InputError(InputFault::use, "one pose does not tell which value is wrong",
                         "give two that differ in all six axes: --pose J1,...,J6=X,Y,Z,A,B,C --pose ...");
    }
    std::vector<TaughtPose> poses;
    for (const std::string& text : arguments.poses) poses.push_back(*taught_pose_from(text));
    return check_taught_poses(robot.geometry, poses);
}

// A cell file is edited by hand, so none is replaced.
void refuse_existing(const fs::path& file) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(file, error))) return;
    throw InputError(InputFault::create, file.string() + " is there already", "name another file with -o FILE");
}

// It stands between quotes in the file.
void check_name(const std::string& name) {
    constexpr std::size_t longest = 60;
    const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x20 && byte != 0x7F && c != '"' && c != '\\';
    });
    if (is_plain && !name.empty() && name.size() <= longest) return;
    throw InputError(InputFault::use, "\"" + name + "\" cannot be the name of a cell",
                     "pass --name with 1 to 60 bytes, without quotes, backslashes and control characters");
}

}  // namespace

int run(const CellsRobotsArguments& /*arguments*/, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    terminal.show(lines(known_arms()), document(known_arms()));
    return exit_done;
}

int run(const CellsNewArguments& arguments, Terminal& terminal) {
    const KnownArm& arm = known_arm(arguments.robot);
    const fs::path file = arguments.out.value_or(std::string(arm.id) + ".toml");
    check_ending(file, ".toml");
    const fs::path drawing = fs::path(file).replace_extension(".svg");
    for (const fs::path& made : {file, drawing}) refuse_existing(made);
    const std::string name = arguments.name.value_or(file.stem().string());
    check_name(name);
    const std::string text = new_cell_text(arm, {name, arguments.id});
    const Cell cell = parse_cell(text, file);
    write_file(drawing, draw_arm(*cell.machine->robot));
    write_file(file, text);
    const MadeCell made{file.string(), drawing.string(), arm};
    terminal.show(lines(made), document(made));
    return exit_done;
}

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
    if (arguments.drawing) write_drawing(arguments, cell);
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
    CheckedCell checked{arguments.file.string(), cell, check_cell(cell), std::nullopt};
    if (!arguments.poses.empty()) checked.poses = poses_checked(arguments, cell);
    terminal.show(lines(checked), document(checked));
    return checked.is_good() ? exit_done : exit_demand_broken;
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
