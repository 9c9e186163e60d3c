// Times a search up to a number of pieces; a callback that the search calls once per cut stops it.

#include <atomic>

#include "base/parallel.h"
#include "bench/clock.h"
#include "bench/measures.h"
#include "segment/access/sampled_piece.h"
#include "segment/search/search.h"

namespace qchopper::bench {
namespace {

struct Run {
    double first_s = 0;  // to the first cut made
    double whole_s = 0;
    double evaluation_s = 0;  // wall: boxes, offsets and evaluations
    std::size_t cuts = 0;
    std::size_t pieces = 0;
};

template <class Clock>
Run run_to(const Measured& m, SearchSettings settings, std::size_t pieces, std::size_t threads, Clock clock) {
    const ThreadLimit limit(threads);
    settings.objectives.fragment_volume_mm3 = m.fragment_volume_mm3;
    settings.stop.min_cuts = 10 * static_cast<int>(pieces);
    Run run;
    const double started = clock();
    Segmentation s = uncut(*m.piece.mesh, m.fragment_volume_mm3);
    if (settings.takes_samples()) sample_uncut(s.pieces);
    // The cache calls find before it evaluates a piece and keep afterwards: the time between is that of the evaluation.
    double started_at = 0;
    EvaluationStore between;
    between.find = [&](const Piece&) -> std::optional<PieceEvaluations> {
        started_at = wall_s();
        return std::nullopt;
    };
    between.keep = [&](const Piece&, const PieceEvaluations&) {
        run.evaluation_s += started_at > 0 ? wall_s() - started_at : 0;
        started_at = 0;
    };
    EvaluationCache cache(settings.objectives, settings.candidates, between);
    std::atomic<bool> is_enough = false;
    Context context;
    context.cancelled = &is_enough;
    const auto on_round = [&](const Segmentation& now) {
        run.whole_s = clock() - started;
        if (now.cuts.size() == 1) run.first_s = run.whole_s;
        run.cuts = now.cuts.size();
        run.pieces = now.pieces.size();
        is_enough = now.pieces.size() >= pieces;
    };
    try {
        search(s, settings, cache, {}, on_round, context);
    } catch (const Cancelled&) {  // there are enough pieces
    }
    return run;
}

}  // namespace

void measure_run(const Measured& m, std::size_t pieces, Figures& figures) {
    const Run one = run_to(m, {}, pieces, 1, cpu_s);
    figures.record(m.name,
                   "whole run: " + std::to_string(one.cuts) + " cuts, " + std::to_string(one.pieces) + " pieces",
                   time_text(one.whole_s) + ", the first cut after " + time_text(one.first_s));
    figures.at_most(m.name, "whole run / first decision", one.whole_s / one.first_s, 6);
    const Run alone = run_to(m, {}, pieces, 1, wall_s);
    const Run two = run_to(m, {}, pieces, 2, wall_s);
    figures.record(m.name, "all evaluation of the run, wall",
                   time_text(alone.evaluation_s) + "; two threads " + time_text(two.evaluation_s));
    figures.at_least(m.name, "that: one thread / two threads", alone.evaluation_s / two.evaluation_s, 1.7);
}

double run_s(const Measured& m, const SearchSettings& settings, std::size_t pieces) {
    return run_to(m, settings, pieces, 1, cpu_s).whole_s;
}

}  // namespace qchopper::bench
