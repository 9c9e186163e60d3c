// The commands of the command line that the console runs, without the program: words of its options stand here alone.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/console/worker/console_requests.h"

namespace qchopper {

using CommandWords = std::vector<std::string>;

CommandWords worker_words(const std::filesystem::path& project);
CommandWords mesh_words(const std::filesystem::path& scan, const std::filesystem::path& folder);
// Reads strokes from `file` and writes ignore.ply and no_cut.ply into `folder`, as far as something is painted.
CommandWords paint_words(const std::filesystem::path& scan, const std::filesystem::path& file,
                         const std::filesystem::path& folder, const std::optional<std::string>& units);
CommandWords check_words(const std::filesystem::path& scan, const CheckBody& body);
CommandWords repair_words(const std::filesystem::path& scan, const std::filesystem::path& out, const RepairBody& body,
                          const std::optional<std::string>& units);
// Files that a new project is made with, each if there is one.
struct ProjectFiles {
    std::optional<std::filesystem::path> cell;
    std::optional<std::filesystem::path> painted;  // the folder of paint_words()
    std::optional<std::filesystem::path> plan;     // the file of plan_words()
};
CommandWords project_words(const std::filesystem::path& scan, const std::filesystem::path& project,
                           const NewProjectBody& body, const ProjectFiles& files);
// Writes the cuts of a project into `file`, and changes nothing of it.
CommandWords plan_words(const std::filesystem::path& project, const std::filesystem::path& file);
// Nothing: this work is not one of a project.
std::optional<CommandWords> work_words(const std::filesystem::path& project, const WorkBody& body);

// To which cell: at `to`, or as the cell file of the project says; job files by its drop folder, or over the link.
struct DispatchWords {
    std::filesystem::path project;
    std::string job;  // the SHA-256 of its file
    PlanOrder order;
    std::optional<std::string> to;
    std::optional<std::filesystem::path> drop;
};
CommandWords dispatch_words(const DispatchWords& what);

}  // namespace qchopper
