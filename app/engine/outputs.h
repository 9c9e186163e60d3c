// Writes pieces and pictures of a segmentation into the project folder, and removes all outputs (jobs: piece_jobs.h).
//
// They are never stale: they are removed before a decision changes and written when the cutting is over; the stage in
// project.json states which exist (project.h, tests/app/engine/open_project_test.cpp). Those of a finished project are
// kept aside, in earlier/, so that undo and redo bring them back (tests/app/engine/outputs_test.cpp). Lengths in mm.
// All throw what write_file throws.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/jobs/setups.h"
#include "app/store/project.h"
#include "base/context.h"

namespace qchopper {

// Writes pieces/<name>.ply, and pieces/fragments.ply if fragments are kept; removes other files there. Precondition:
// the names of the pieces are different and not empty.
void write_pieces(const std::filesystem::path& folder, const Segmentation& segmentation, FragmentChoice fragments,
                  const Context& context = {});

// Writes pictures/segmentation.png, pictures/exploded.png and pictures/unreachable.png (unreachable_picture.h), that
// one by the setups that jobs are made of. Throws Cancelled.
void write_pictures(const std::filesystem::path& folder, const std::vector<Piece>& pieces, Setups& setups,
                    const Context& context);

// Removes jobs, sheets and pictures of a finished project, and saves it with Stage::cut before that.
void remove_jobs(const std::filesystem::path& folder, Project& project);

// Removes what other processes make programs from, and what they have made (work_project.h).
void remove_items(const std::filesystem::path& folder);

// Saves the project with Stage::cutting, if it has another stage or jobs, then removes pieces, jobs, pictures and
// items; those of Stage::done but for the items are moved aside, of the newest three such states. A program that is
// killed at any moment leaves a consistent project (tests/app/engine/killed_test.cpp).
void remove_outputs(const std::filesystem::path& folder, Project& project);

// Whether remove_outputs has moved aside those of a project that was finished.
bool are_outputs_kept(const std::filesystem::path& folder, const Project& as_it_was);

// Moves outputs back that remove_outputs has moved aside, if there are some of the decisions in force and of these
// settings, and saves the project as it was then, with its present history. Whether there were any. Precondition: the
// project on disk is `project`, and has Stage::cutting.
bool bring_back_outputs(const std::filesystem::path& folder, Project& project);

}  // namespace qchopper
