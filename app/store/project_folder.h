// Makes, locks, reads and writes the project folder NAME.qch.
//
//   NAME.qch/
//     project.json      scan, settings, decisions with their terms and runners-up, pieces, fragments
//     ignored.bin       surface that may stay as it is (ignored_surface.h); missing if there is none
//     no_cut.bin        surface that must not be cut (no_cut_surface.h); missing if there is none
//     cell.toml         a copy of the cell file; missing while the project has no cell
//     pieces/A.ply ...  the pieces (binary PLY, double, face property cap = number of the cut)
//     jobs/A.qjob ...   one job file per piece
//     pictures/*.png
//     work/             programs made by other processes (app/engine/work_project.h)
//     cache/            evaluations (evaluation_store.h); may be deleted at any time
//     lock              held while a program writes, and says which
//
// Everything but cell.toml, ignored.bin and no_cut.bin follows from project.json and the scan. Pieces, jobs and
// pictures are never stale: they are removed before a decision changes and written when the cutting is over
// (outputs.h). docs/developer/formats/project-folder.md is the grammar.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/store/project.h"
#include "base/context.h"
#include "base/files/file.h"

namespace qchopper {

// The path without a slash at its end.
std::filesystem::path without_slash(const std::filesystem::path& folder);

// Where prepare --items writes what programs are made from.
std::filesystem::path items_folder(const std::filesystem::path& project);

// Whether the path is a folder. Throws InputError (missing) for a folder that holds no project.
bool is_project_folder(const std::filesystem::path& path);

// Checks that a file or folder can be made. Throws InputError (create) if it exists, or its folder does not exist or
// cannot be written.
void check_output(const std::filesystem::path& out);

// Makes the folder, which appears whole or not at all. `cell_file`: the bytes of the cell file; nothing: no cell yet.
// `ignored`: per triangle of the imported scan (ignored_surface.h), or empty. The points that must not be cut are those
// of the project's settings.
// Throws InputError (create, io).
void create_project(const std::filesystem::path& folder, const Project& project, const std::optional<Bytes>& cell_file,
                    const Bytes& ignored = {});

// Checks a cell file and copies it into a project folder, with a message. Throws what read_cell, read_file and
// write_file throw.
void take_cell(const std::filesystem::path& folder, const std::filesystem::path& cell_file, const Context& context);

// Written aside and renamed: after a crash the file is the old or the new one. Throws what write_file throws.
void save_project(const std::filesystem::path& folder, const Project& project);

// Throws InputError: (missing) there is no project, (config) a project file that this version cannot read.
Project load_project(const std::filesystem::path& folder);

// Removes what a program of this machine leaves behind if it is killed while it writes (is_leftover of
// base/files/temporary_name.h), in all folders of the project (tests/app/engine/killed_test.cpp).
void clear_leftovers(const std::filesystem::path& folder);

// Who writes the project now: "prepare, process 4711 on workshop, since ...", or "another program"; nothing if nobody
// does.
std::optional<std::string> writer_of(const std::filesystem::path& folder);

// Holds the lock file of a project while it lives, so that one program writes at a time. The system releases it when
// the program ends in any way.
class ProjectLock {
 public:
    // Throws InputError: (busy) another program holds the lock, with its command, process, host and start; (create) the
    // folder cannot be written or its file system has no locks.
    explicit ProjectLock(const std::filesystem::path& folder);
    ~ProjectLock();
    ProjectLock(const ProjectLock&) = delete;
    ProjectLock& operator=(const ProjectLock&) = delete;

 private:
    int descriptor_;
};

}  // namespace qchopper
