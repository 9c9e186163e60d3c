// The options of the commands that import a scan to make a solid or a project of it.

#pragma once

#include "app/cli/arguments.h"

namespace CLI {
class App;
}

namespace qchopper {

// The options that every command has.
void add_common(CLI::App* command, Arguments& arguments);

// Each adds its command; what is typed is stored in the arguments, which must outlive the parser.
void add_repair(CLI::App& app, RepairArguments& repair, Arguments& common);
void add_prepare(CLI::App& app, PrepareArguments& prepare, Arguments& common);
void add_segment(CLI::App& app, SegmentArguments& segment, Arguments& common);

}  // namespace qchopper
