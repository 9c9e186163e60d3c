// Adds the options of the commands that import a scan to make a solid or a project of it.
//
// All arguments passed by reference must outlive the parser; they are filled while it parses.

#pragma once

#include <functional>

#include "app/cli/arguments.h"

namespace CLI {
class App;
}

namespace qchopper {

// Adds the options that every command has. `on_parsed` is called once if this command is given.
void add_common(CLI::App* command, Arguments& arguments, const std::function<void()>& on_parsed);

// Each adds its command, whose arguments become common.command if it is given.
void add_repair(CLI::App& app, RepairArguments& repair, Arguments& common);
void add_prepare(CLI::App& app, PrepareArguments& prepare, Arguments& common);
void add_segment(CLI::App& app, SegmentArguments& segment, Arguments& common);

}  // namespace qchopper
