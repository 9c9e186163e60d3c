// What an operator asks of a project, as a value, and the answer.
//
// Lengths in mm about the scan's centre. Decisions are saved before decide() returns (open_project.h).

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/engine/discard_request.h"
#include "app/engine/open_project.h"
#include "app/engine/outline.h"
#include "app/engine/setup_project.h"
#include "app/pictures/regions_view.h"
#include "app/store/project_context.h"

namespace qchopper {

// How a search goes on; what is not given stays as the project has it.
struct SearchRequest {
    std::optional<StopRules> rules;
    std::optional<Stop> combine;
    std::optional<int> max_cuts;  // those of `rules` do not count
    std::optional<std::size_t> beam;
    std::optional<double> time_limit_s;
};

// One decision or question, or none to see the state of the project.
struct ProjectRequest {
    bool propose = false;                                     // list the best planes
    std::optional<std::size_t> accept;                        // a place in the ranking, from 1
    std::optional<Plane> expected_plane;                      // the accepted place must hold it, bit for bit
    std::optional<Plane> plane;                               // to cut by
    std::optional<std::variant<std::size_t, Plane>> preview;  // a place in the ranking, or a plane
    std::optional<DiscardRequest> discard;                    // pieces
    bool undo = false;
    bool redo = false;
    bool reset = false;
    std::optional<SearchRequest> search;
    std::optional<std::filesystem::path> plan;  // to write
    std::optional<RegionsRequest> regions;      // to draw
    bool preview_setups = false;                // of a preview: how its pieces would be milled
    // Of any request.
    std::optional<GivenWeights> weights;        // a decision that is made first
    std::optional<GivenWeights> tried_weights;  // in place of those in force, of a proposal or preview; not kept
    std::optional<std::string> piece;           // to be cut next; nothing: the one that the rules choose
    std::size_t top = 10;                       // so many planes are proposed
    bool write_pieces = false;                  // the pieces, after each decision
};

// The ranking of one piece.
struct Proposal {
    std::string piece;
    std::size_t faces = 0;
    bool rules_hold = false;
    std::size_t candidates = 0;         // how many planes were ranked
    std::vector<Ranked> listed;         // the best of those that are more than a step apart, best first
    std::size_t top = 10;               // so many are shown
    std::vector<std::size_t> crossing;  // of those shown, the places (from 1) of planes whose sections cross
};

// What one plane would make.
struct Preview {
    std::string piece;
    Ranked plane;
    Outline outline;
    std::vector<SolidEvaluation> solids;
    bool sections_cross = false;        // the piece runs through itself in this plane
    std::optional<PlaneSetups> setups;  // with ProjectRequest::preview_setups
};

struct SegmentAnswer {
    Sentence done;                      // the decision as a sentence; empty: none was made
    std::vector<Sentence> notes;        // whole lines
    std::vector<std::string> warnings;  // whole lines; the project keeps them too
    bool is_demand_met = true;          // false: the last note states why
    std::optional<Proposal> proposal;
    std::optional<Preview> preview;
    std::optional<Weights> tried_weights;       // by which these are ranked; nothing: by those in force
    std::optional<std::filesystem::path> plan;  // that was written
    std::optional<ShownRegions> regions;        // that were drawn
    // The project afterwards (segment_project.h); decide() leaves these as they are.
    bool is_project_made = true;  // false: a plan does not fit the scan, and nothing is on disk
    std::filesystem::path folder;
    Project project;
    bool pieces_written = false;
    std::vector<std::optional<double>> unreachable;  // per piece (share_by_objective); empty: not asked
    std::shared_ptr<const StressedModel> stress;     // null: structure has no weight
};

// Does what is asked. Tried weights change nothing: proposal and preview are those that the same request makes after
// these weights were decided (tests/app/engine/open_project_test.cpp). Precondition: the caller holds the lock of the
// project. Throws InputError: (use) for what this project does not have: a piece of that name, a place in the ranking,
// a stop rule, terms for tried weights, or a cell for the setups of a preview; (config) for a wrong cell file, before
// anything is decided; (create) for a plan in place of another file.
SegmentAnswer decide(OpenProject& project, const ProjectRequest& request, const ProjectContext& context);

}  // namespace qchopper
