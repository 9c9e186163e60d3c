// What is made of a segmentation and lies in the project folder: pieces, jobs, pictures.
//
// Never stale: whoever is about to change a decision takes them away first, whoever ends the cutting writes them. The
// stage in project.json says which (project.h).

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/project/project.h"
#include "app/project/setups.h"
#include "base/context.h"

namespace qchopper {

// Writes pieces/<name>.ply, and pieces/fragments.ply if fragments are kept; takes away other files there.
void write_pieces(const std::filesystem::path& folder, const Segmentation& segmentation, FragmentChoice fragments);

// A piece as it was prepared.
struct PieceReport {
    std::string name;
    std::size_t faces = 0;
    double volume_mm3 = 0;
    Carving carving;
    std::filesystem::path job;  // empty: it does not fit and has none
};

// Writes jobs/<name>.qjob of every piece that fits the cell, and records them in the project, which is not saved.
std::vector<PieceReport> write_jobs(const std::filesystem::path& folder, Project& project,
                                    const Segmentation& segmentation, Setups& setups,
                                    const std::string& program_version, const Context& context);

// Writes pictures/segmentation.png and pictures/exploded.png.
void write_pictures(const std::filesystem::path& folder, const std::vector<Piece>& pieces, const Context& context);

// If anything was made already: first saves the project as being cut, then takes away pieces, jobs and pictures. Killed
// at any moment it leaves a project that is still right.
void remove_outputs(const std::filesystem::path& folder, Project& project);

}  // namespace qchopper
