// Adds the options of the commands that import a scan to make a solid or a project of it.
//
// All arguments passed by reference must outlive the parser; they are filled while it parses.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/arguments/arguments.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace qchopper {

// Adds the options that every command has. `on_parsed` is called once if this command is given.
void add_common(CLI::App* command, Arguments& arguments, const std::function<void()>& on_parsed);

// What several commands have: --tools, the folder of a project, and --units of a scan or file.
CLI::Option* add_tools(CLI::App* command, std::vector<std::uint16_t>& tools);
void add_project(CLI::App* command, std::filesystem::path& project);
// Lets the value of an option be the name of a cell (app/store/ready_cells.h) as well as a file.
CLI::Option* takes_cell_name(CLI::Option* option);
void add_units(CLI::App* command, const std::string& of, std::optional<std::string>& units);

// Each adds its command, whose arguments become common.command if it is given.
void add_repair(CLI::App& app, RepairArguments& repair, Arguments& common);
void add_prepare(CLI::App& app, PrepareArguments& prepare, Arguments& common);
void add_segment(CLI::App& app, SegmentArguments& segment, Arguments& common);

}  // namespace qchopper
