// The steps are those of OpenProject (loop_steps.cpp).

#include "app/engine/loop.h"

#include "app/store/decisions.h"
#include "app/store/project_lines.h"
#include "base/text.h"

namespace qchopper {

namespace {

// Whether the arm cannot follow the toolpath of a piece that only long tools reach, in a project whose pieces are cut
// for size; with a message per piece. The next search cuts them (Setups::is_machinable). Once per piece, and not of one
// whose orientations a decision limits.
bool refuses_long_tools(OpenProject& project, const PreparedProject& prepared, const Context& context) {
    if (!project.project().settings.stop.fits_cell) return false;
    bool is_any = false;
    for (std::size_t i = 0; i < prepared.pieces.size(); ++i) {
        const PieceReport& piece = prepared.pieces[i];
        const bool is_limited = committed_setup_order(project.project().history, piece.name).max_directions.has_value();
        if (!piece.is_machine_refusing || is_limited) continue;
        if (!project.setups()->refuse_with_long_tools(project.segmentation().pieces[i])) continue;
        is_any = true;
        context.message("piece " + piece.name + ": " + piece.no_program_because + "; it is cut for shorter tools");
    }
    return is_any;
}

}  // namespace

LoopResult run_loop(OpenProject& project, const LoopOptions& options, const LoopObserver& observer,
                    const Context& context) {
    const auto decided_in = [&](LoopStep step) {
        return [&observer, step](const Segmentation& saved) {
            if (observer.on_decision) observer.on_decision(saved, step);
        };
    };
    LoopResult result;
    if (project.is_search_open() || options.last == LoopStep::cut) {
        result.end = project.search(project.checks(), decided_in(LoopStep::cut), context, options.time_limit);
    }
    if (options.last == LoopStep::cut) return result;
    if (project.begin_review()) {
        project.review_cuts(decided_in(LoopStep::review), context);
        if (options.last == LoopStep::review) return result;
        const auto end = project.cut_again(decided_in(LoopStep::cut_again), context, options.time_limit);
        if (end) result.end = end;
    }
    if (observer.on_cut) observer.on_cut(result.end);
    const auto is_changed = [&](const PreparedProject& prepared) {
        if (!refuses_long_tools(project, prepared, context)) {
            return take_fewer_orientations(project, prepared, context);
        }
        result.end = project.cut_refused(decided_in(LoopStep::cut_again), context, options.time_limit);
        return true;
    };
    // Whether what becomes of every piece is known at the end. Changes are those of one run that knows all at once.
    const auto change_refused = [&](MissingToolpaths missing) {
        while (true) {
            const PreparedProject asked = project.follow_toolpaths(missing, options.program_version, context);
            if (asked.pieces.empty()) return false;
            if (!is_changed(asked)) return true;
        }
    };
    if (options.last == LoopStep::setups) {
        const bool is_settled = change_refused(MissingToolpaths::not_made);
        result.prepared = project.set_up(result.end, observer, context);
        result.prepared->are_refusals_settled = is_settled;
    }
    if (options.last == LoopStep::jobs) {
        const auto write = [&] {
            return project.write_outputs(result.end, options.program_version, observer, context);
        };
        // Pieces that the arm refuses are changed before programs are proven, which those beside them would lose.
        change_refused(MissingToolpaths::made);
        result.prepared = write();
        while (is_changed(*result.prepared)) result.prepared = write();
    }
    return result;
}

bool take_fewer_orientations(OpenProject& project, const PreparedProject& prepared, const Context& context) {
    bool is_any = false;
    for (const PieceReport& piece : prepared.pieces) {
        const std::size_t orientations = piece.piece_setup.setup().access.orientations.size();
        if (!piece.is_machine_refusing || orientations < 2) continue;
        SetupOrder order = committed_setup_order(project.project().history, piece.name);
        order.piece = piece.name;
        order.max_directions = orientations - 1;
        if (!project.decide_setup(order)) continue;
        is_any = true;
        context.message("piece " + piece.name + ": " + piece.no_program_because + "; it is milled from " +
                        counted(orientations - 1, "orientation") + " in place of " + std::to_string(orientations));
    }
    return is_any;
}

std::function<void(const Segmentation&, LoopStep)> told_decisions(const OpenProject& project, GoOn go_on, bool of_beam,
                                                                  const ProjectContext& context) {
    const auto say_kept = [&project, &context, go_on = std::move(go_on), of_beam](std::size_t cuts) {
        context.saved(go_on(kept_cuts(cuts, project.folder(), of_beam)));
    };
    say_kept(project.project().cuts.size());
    return [&project, &context, say_kept, of_beam, told = project.project().cuts.size()](const Segmentation& saved,
                                                                                         LoopStep step) mutable {
        if (step == LoopStep::review) return;  // the cuts are as many; review_lines() tells what became of them
        say_kept(saved.cuts.size());
        for (const std::string& line : round_lines(saved.cuts, told, project.project().settings)) {
            context.message((of_beam ? "best so far: " : "") + line);
        }
        told = saved.cuts.size();
    };
}

}  // namespace qchopper
