// Makes a project folder of a scan and takes its scan in again: what prepare and segment have in common.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/cli/arguments.h"
#include "app/cli/terminal.h"
#include "app/project/project.h"
#include "base/file.h"
#include "cam/cell/cell.h"
#include "segment/import/import_scan.h"

namespace qchopper {

// The stop rules that were given; they replace all that stood before. Nothing was given: nothing.
std::optional<StopRules> given_rules(const ProjectArguments& arguments);

// NAME.qch/ is NAME.qch.
std::filesystem::path without_slash(const std::filesystem::path& folder);

// Throws InputError (create) if there is something already, or nothing can be made there.
void check_output(const std::filesystem::path& out);

// Whether anything is said about how the scan becomes a solid.
bool is_any_given(const ProjectArguments& arguments);

RepairChoices repair_choices(const RepairChoiceArguments& arguments);

// Throws InputError (use) if neither the arguments nor the scan say what one unit of it is.
void check_unit(const std::filesystem::path& scan, const ProjectArguments& arguments);

// How the scan of a project is taken in again.
IntakeOptions options_of(const ScanSource& scan);

// The scan as the arguments say; tells what was done to it.
Intake take_in_scan(const std::filesystem::path& scan, const ProjectArguments& arguments, Terminal& terminal);
// The scan of a project. Throws InputError (mesh) if it is another one now.
Intake take_in_scan(const Project& project, Terminal& terminal);

// The project of a scan before its first cut.
Project new_project(const std::filesystem::path& scan, const Intake& intake, const ProjectArguments& arguments);

// The folder appears whole or not at all. `cell_file`: the bytes of the cell file, if a cell is known.
void create_project(const std::filesystem::path& folder, const Project& project, const std::optional<Bytes>& cell_file);

// Gives a project that knows no cell yet the one of a file. Throws InputError (config) if that is impossible.
void take_cell(const std::filesystem::path& folder, const std::filesystem::path& cell_file, Terminal& terminal);

// "cut 2 on piece B: best of 120 planes, total 3.929 (...); makes D, E".
std::string cut_line(const Cut& cut);

}  // namespace qchopper
