// What an operator asks of a project, and the answer: a command line and a page in a browser ask alike.

#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/project/open_project.h"
#include "app/project/outline.h"
#include "app/project/plan.h"

namespace qchopper {

// How a search is to go on; what is not given stays as the project has it.
struct SearchRequest {
    std::optional<StopRules> rules;
    std::optional<Stop> combine;
    std::optional<std::size_t> beam;
    std::optional<double> time_limit_s;
};

// One of these, or none to see how the project stands.
struct ProjectRequest {
    bool propose = false;
    std::optional<std::size_t> accept;                        // a place in the ranking, from 1
    std::optional<Plane> plane;                               // to cut by
    std::optional<std::variant<std::size_t, Plane>> preview;  // a place in the ranking, or a plane
    std::optional<std::string> discard;                       // a piece
    bool undo = false;
    bool redo = false;
    bool reset = false;
    std::optional<SearchRequest> search;
    std::optional<std::filesystem::path> plan;  // to write
    // How.
    std::optional<std::string> piece;  // to be cut next; nothing: the one that the rules choose
    std::size_t top = 10;              // so many planes are proposed
};

// The ranking of one piece.
struct Proposal {
    std::string piece;
    std::size_t faces = 0;
    bool rules_hold = false;
    std::vector<Ranked> ranked;         // all
    std::size_t top = 10;               // so many are shown
    std::vector<std::size_t> crossing;  // of those shown, the places (from 1) of planes whose sections cross
};

// What one plane would make.
struct Preview {
    std::string piece;
    Ranked plane;
    Outline outline;
    std::vector<SolidEvaluation> solids;
    bool sections_cross = false;  // the piece runs through itself in this plane
};

struct SegmentAnswer {
    std::string done;                   // the decision as a sentence; empty: none was made
    std::vector<std::string> notes;     // whole lines
    std::vector<std::string> warnings;  // whole lines; the project keeps them too
    bool is_demand_met = true;          // false: the last note says why
    std::optional<Proposal> proposal;
    std::optional<Preview> preview;
    std::optional<std::filesystem::path> plan;  // that was written
    bool pieces_written = false;
};

// What is told of a search while it goes on; each may be empty.
struct SearchListener {
    std::function<void(std::size_t)> on_kept;           // so many cuts are saved: at its start and after every round
    std::function<void(const Segmentation&)> on_round;  // the best so far
};

SegmentAnswer change_weights(OpenProject& project, const Weights& weights);

// Does what is asked, and adds to an answer. Throws InputError (use) for what this project does not have: a piece of
// that name, a place in the ranking, a stop rule to go on to.
SegmentAnswer decide(OpenProject& project, const ProjectRequest& request, const SearchListener& listener,
                     const Context& context, SegmentAnswer answer = {});

// Makes the cuts of a plan on a project that has none, until one does not apply. `on_decision`: replay_plan.h.
SegmentAnswer make_cuts_of(const Plan& plan, OpenProject& project,
                           const std::function<void(const Segmentation&)>& on_decision, const Context& context);

// "The 3 cuts made so far are kept in NAME.qch", without an end.
std::string kept_cuts(std::size_t cuts, const std::filesystem::path& folder, bool is_beam = false);

}  // namespace qchopper
