// The loop of a project: cut, set up, review, cut again, until its jobs are written.
//
// The one flow behind `segment --auto` and `prepare`, for a command line as for a page or a job on a cluster. Every
// decision is saved before the next one is evaluated: a loop that is interrupted anywhere goes on when it is run again,
// and ends with the same bytes (tests/app/cli/same_bytes_test.cpp). Progress, messages and cancelling are the context's
// (base/context.h).

#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/engine/open_project.h"
#include "app/store/project_context.h"

namespace qchopper {

enum class LoopStep {
    cut,        // the search, to the stop rules
    review,     // setups of the pieces judge the cuts (review_cuts.h); a cut may be replaced
    cut_again,  // pieces of which the setups leave too much out of reach are cut on trial (planes_by_setups.h)
    setups,     // of the jobs, which are not written
    jobs        // pieces, setups, jobs and pictures
};

// Functions may be empty; they are called from one thread at a time.
struct LoopObserver {
    // The segmentation with one more decision of a step, or a better one of a beam; it is saved already.
    std::function<void(const Segmentation&, LoopStep)> on_decision = {};
    // Nothing more is cut; outputs follow. Nothing: nothing was left to cut.
    std::function<void(const std::optional<SearchEnd>&)> on_cut = {};
    // The setup of which the jobs of a piece will be made, before the first job is written; once per piece, and again
    // for all where a piece is milled from fewer orientations (take_fewer_orientations()).
    std::function<void(const Piece&, const PlacedSetup&)> on_setup = {};
    // All jobs of a piece are written, or none because it does not fit; as often as on_setup.
    std::function<void(const PieceReport&)> on_job = {};
};

struct LoopOptions {
    LoopStep last = LoopStep::jobs;       // the step after which it ends
    std::optional<TimeLimit> time_limit;  // of all cutting; the round that is being made is finished
    std::string program_version;          // is written into the jobs
};

struct LoopResult {
    std::optional<SearchEnd> end;             // of the last cutting; nothing: nothing was left to cut
    std::optional<PreparedProject> prepared;  // after LoopStep::setups and LoopStep::jobs
};

// Goes on where the project stands; a step that is done already is left out, but the search is run again if it is the
// last step that is asked for. Where time runs out the steps of cutting that are left are passed over, and outputs are
// those of the cuts so far. Without a cell there is no review. Throws what check_cell() throws for these two, and
// Cancelled; what was decided stays saved.
LoopResult run_loop(OpenProject& project, const LoopOptions& options, const LoopObserver& observer,
                    const Context& context);

// Where the arm cannot follow the toolpath of another piece, or one that was not cut: decides that the piece is milled
// from one orientation less than it was, as an operator can by `setup --orientations`, with a message; undo takes it
// back. Whether a piece was decided about; its job is to be written again. Nothing of a piece that has one orientation.
bool take_fewer_orientations(OpenProject& project, const PreparedProject& prepared, const Context& context);

using GoOn = std::function<Sentence(const std::string& kept)>;
// For LoopObserver::on_decision: says what is kept of the cuts and, by `go_on`, how to go on with them, for
// the message of an error that follows; and gives a message per new cut. `of_beam`: the text says that these are the
// best cuts so far, which may change. Says what is kept of the present cuts at once.
std::function<void(const Segmentation&, LoopStep)> told_decisions(const OpenProject& project, GoOn go_on, bool of_beam,
                                                                  const ProjectContext& context);

}  // namespace qchopper
