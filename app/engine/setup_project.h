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

// mm2 of a piece's surface by what becomes of it, as the setup sheet colours it: each triangle counts where the largest
// part of it belongs (MappedAccess::states). All of them are the surface of the piece.
struct SurfaceAreas {
    double reached = 0;  // skin and milled caps, as the following
    double too_narrow = 0;
    double steep = 0;
    double holder = 0;
    double hidden = 0;
    double ignored = 0;
    double sawn = 0;  // caps in faces of the block
    double base = 0;
};

// A piece that a plane would make.
struct PlanePiece {
    Piece piece;
    bool is_above = false;  // on the side that the normal points to
    PieceSetups setups;
    SurfaceAreas areas;
};
struct PlaneSetups {
    Cell cell;
    double max_unreachable = 0;  // share
    std::vector<PlanePiece> pieces;
};
// What setup_project() would show of the pieces that a cut of the piece along the plane makes, made on a copy: nothing
// is decided (tests/app/engine/plane_setups_test.cpp). `piece` is an index in project.segmentation().pieces. No pieces
// if the plane does not part it. Throws InputError (use) for a project without a cell, and Cancelled.
PlaneSetups setups_of_plane(OpenProject& project, std::size_t piece, const Ranked& plane, const Context& context);

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

// Shows and decides in a project that is open. Preconditions: with a decision a piece is named, and the caller holds
// the lock. Throws InputError (use) for a project without a cell, a piece that does not exist or a base that it does
// not have, and Cancelled.
SetupAnswer setup_open_project(OpenProject& project, const SetupRequest& request, const std::string& program_version,
                               const ProjectContext& context);

// Without a decision nothing is locked, and nothing but the cache is written. Precondition: with a decision a piece is
// named. Throws what load_project and setup_open_project throw and, with a decision, what ProjectLock throws.
SetupAnswer setup_project(const std::filesystem::path& folder, const SetupRequest& request,
                          const std::string& program_version, const ProjectContext& context);

}  // namespace qchopper
