// Shows how the pieces of a project are laid and milled, and lets the operator choose another base or fewer directions.
//
// A choice is a decision of the project: it is saved before the job of the piece is written again, and undo takes it
// back (tests/app/cli/setup_test.cpp).

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/open_project.h"
#include "app/store/project_context.h"

namespace qchopper {

struct SetupRequest {
    std::optional<std::string> piece;           // nothing: all pieces are shown
    std::optional<int> base;                    // number of a base of the piece
    std::optional<std::size_t> max_directions;  // of the tool
    std::vector<std::uint16_t> tools = {};      // numbers of those that may be used
    bool is_free = false;                       // the program chooses again
    bool decides() const { return base || max_directions || !tools.empty() || is_free; }
};

struct PieceSetups {
    std::string piece;
    std::optional<SetupOrder> order;  // what the operator chose
    PlacedSetup piece_setup;
};

struct SetupAnswer {
    std::filesystem::path folder;
    Cell cell;
    std::string done;                // the decision as a sentence; empty: none was made
    std::optional<PieceReport> job;  // that was written again; without a file where the piece does not fit
    bool is_job_written() const { return job && !job->job.empty(); }
    double max_unreachable = 0;  // share
    std::optional<IgnoredSurface> ignored;
    std::vector<PieceSetups> pieces;
};

// Without a decision nothing is locked, and nothing but the cache is written. Precondition: with a decision a piece is
// named. Throws what load_project throws and, with a decision, what ProjectLock throws; InputError (use) for a project
// without a cell, a piece that does not exist or a base that it does not have, and Cancelled.
SetupAnswer setup_project(const std::filesystem::path& folder, const SetupRequest& request,
                          const std::string& program_version, const ProjectContext& context);

}  // namespace qchopper
