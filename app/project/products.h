// What is made of a segmentation and lies in the project folder: pieces, jobs, pictures.
//
// Never stale: whoever is about to change a decision takes them away first, whoever ends the cutting writes them. The
// stage in project.json says which (project.h).

#pragma once

#include <filesystem>

#include "app/project/project.h"

namespace qchopper {

// Writes pieces/<name>.ply, and pieces/crumbs.ply if crumbs are kept; takes away other files there.
void write_pieces(const std::filesystem::path& folder, const Segmentation& segmentation, CrumbChoice crumbs);

// If anything was made already: first saves the project as being cut, then takes away pieces, jobs and pictures. Killed
// at any moment it leaves a project that is still right.
void take_away_products(const std::filesystem::path& folder, Project& project);

// A program that was killed while it wrote may have left files with names like A.ply.tmp.4711. Whoever holds the lock
// knows that nobody writes them any more.
void clear_leftovers(const std::filesystem::path& folder);

}  // namespace qchopper
