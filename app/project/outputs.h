// Writes and removes the outputs of a segmentation in the project folder: pieces, jobs, pictures.
//
// They are never stale: they are removed before a decision changes and written when the cutting is over; the stage in
// project.json states which exist (project.h, tests/app/project/open_project_test.cpp). Lengths in mm. All throw what
// write_file throws.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/project/project.h"
#include "app/project/reach_advice.h"
#include "app/project/setups.h"
#include "base/context.h"

namespace qchopper {

// Writes pieces/<name>.ply, and pieces/fragments.ply if fragments are kept; removes other files there. Precondition:
// the names of the pieces are different and not empty.
void write_pieces(const std::filesystem::path& folder, const Segmentation& segmentation, FragmentChoice fragments,
                  const Context& context = {});

// The share of a piece's surface that may stay out of reach: the operator's, or else the cell's. A cell of version 1
// sets no limit: 1.
double most_unreachable(const Project& project, const Cell& cell);

// The result of prepare for one piece.
struct PieceReport {
    std::string name;
    std::size_t faces = 0;
    double volume_mm3 = 0;
    Carving carving;
    std::filesystem::path job;             // empty: it does not fit the cell and has no job
    std::vector<ReachAdvice> advice = {};  // of a piece of which more is out of reach than may be
};

// Writes jobs/<name>.qjob of one piece if it fits the cell, else removes it, and records it in the project, which is
// not saved. `index` is that of the piece in the segmentation.
PieceReport write_job(const std::filesystem::path& folder, Project& project, const Segmentation& segmentation,
                      std::size_t index, Setups& setups, const std::string& program_version);

// The same for all pieces; no other job stays recorded. One report per piece. Throws Cancelled.
std::vector<PieceReport> write_jobs(const std::filesystem::path& folder, Project& project,
                                    const Segmentation& segmentation, Setups& setups,
                                    const std::string& program_version, const Context& context);

// Writes pictures/segmentation.png, pictures/exploded.png and pictures/unreachable.png (unreachable_picture.h). Throws
// Cancelled.
void write_pictures(const std::filesystem::path& folder, const std::vector<Piece>& pieces, Setups& setups,
                    const Context& context);

// Saves the project with Stage::cutting, if it has another stage or jobs, then removes pieces, jobs and pictures. A
// program that is killed at any moment leaves a consistent project (tests/app/project/killed_test.cpp).
void remove_outputs(const std::filesystem::path& folder, Project& project);

}  // namespace qchopper
