// The project folder NAME.qch: made whole, locked, saved after every decision.
//
//   NAME.qch/
//     project.json      scan, settings, decisions with their terms and runners-up, pieces, fragments
//     cell.toml         the cell file as it was when it was named; none: the project knows no cell yet
//     pieces/A.ply ...  the pieces (binary PLY, double, face property cap = number of the cut)
//     jobs/A.qjob ...   one job file per piece
//     pictures/*.png
//     cache/            evaluations that are known already; may be deleted at any time
//     lock              held while a program writes
//
// project.json alone decides. Pieces, jobs and pictures are never stale: they are taken away before a decision changes
// and written when the cutting is over (products.h). docs/project-folder.md is the grammar.

#pragma once

#include <filesystem>
#include <optional>

#include "app/project/project.h"
#include "base/context.h"
#include "base/file.h"

namespace qchopper {

// NAME.qch/ is NAME.qch.
std::filesystem::path without_slash(const std::filesystem::path& folder);

// Is it a folder? Throws InputError (missing) for a folder that holds no project.
bool is_project_folder(const std::filesystem::path& path);

// For a file or a folder to be made. Throws InputError (create) if there is something already, or nothing can be made
// there.
void check_output(const std::filesystem::path& out);

// The folder appears whole or not at all. `cell_file`: the bytes of the cell file, if a cell is known.
void create_project(const std::filesystem::path& folder, const Project& project, const std::optional<Bytes>& cell_file);

// Gives a project that knows no cell yet the one of a file. Throws InputError (config) if that is impossible.
void take_cell(const std::filesystem::path& folder, const std::filesystem::path& cell_file, const Context& context);

// Written aside and renamed: a crash leaves the decisions before or after, never half of them.
void save_project(const std::filesystem::path& folder, const Project& project);

// Throws InputError: (missing) no project there, (config) a project file that this version cannot read.
Project load_project(const std::filesystem::path& folder);

// A program that was killed while it wrote may have left files with names like A.ply.tmp.4711. Whoever holds the lock
// knows that nobody writes them any more.
void clear_leftovers(const std::filesystem::path& folder);

// Keeps a second writer out while it lives. Throws InputError (busy) if somebody else holds it.
class ProjectLock {
 public:
    explicit ProjectLock(const std::filesystem::path& folder);
    ~ProjectLock();
    ProjectLock(const ProjectLock&) = delete;
    ProjectLock& operator=(const ProjectLock&) = delete;

 private:
    int descriptor_;
};

}  // namespace qchopper
