// Times the first decision as a whole and step by step, on one thread.

#include <algorithm>

#include "base/parallel.h"
#include "bench/clock.h"
#include "bench/measures.h"
#include "segment/mesh/oriented_box.h"
#include "segment/objectives/sweep/fragility_sweep.h"
#include "segment/objectives/sweep/sweep.h"
#include "segment/search/search.h"

namespace qchopper::bench {
namespace {

struct Step {
    std::string what;
    double seconds;
};

SearchSettings settings_of(const Measured& m) {
    SearchSettings settings;
    settings.objectives.fragment_volume_mm3 = m.fragment_volume_mm3;
    return settings;
}

// As the program does it, and nothing known before.
std::vector<Ranked> decide(const Measured& m) {
    const SearchSettings settings = settings_of(m);
    Segmentation s = uncut(*m.piece.mesh, m.fragment_volume_mm3);
    const auto most = std::max_element(s.pieces.begin(), s.pieces.end(), [](const Piece& a, const Piece& b) {
        return a.mesh->triangles.size() < b.mesh->triangles.size();
    });
    const auto piece = static_cast<std::size_t>(most - s.pieces.begin());
    EvaluationCache cache(settings.objectives, settings.candidates);
    std::vector<Ranked> ranked = rank(s, piece, settings, cache, Context{});
    if (!ranked.empty()) apply(s, cut_by(s, piece, ranked, 0, settings), m.fragment_volume_mm3);
    return ranked;
}

// The same steps one by one.
std::vector<Step> profile(const Measured& m, int runs) {
    const Objectives objectives = settings_of(m).objectives;
    const PreparedPiece prepared = prepare(m.piece, objectives);
    const OrientedBox box = oriented_box(m.piece.mesh->points);
    std::vector<Candidate> candidates;
    const auto all_along = [&] {
        std::vector<Candidate> all;
        for (int n = 0; n < 3; ++n) {
            const auto some = candidates_along(m.piece, box.axis[static_cast<std::size_t>(n)], n, 40);
            all.insert(all.end(), some.begin(), some.end());
        }
        return all;
    };
    const std::vector<Planes> planes = by_normal(all_along());
    std::vector<Step> steps;
    const auto step = [&](const std::string& what, const auto& work) {
        steps.push_back({what, best_of(runs, cpu_s, work)});
    };
    step("solids of the scan, in memory order", [&] { return uncut(*m.piece.mesh, m.fragment_volume_mm3); });
    step("box", [&] { return oriented_box(m.piece.mesh->points); });
    step("offsets: extent and nudge", all_along);
    step("preparation", [&] { return prepare(m.piece, objectives); });
    step("sweep without fragility", [&] {
        std::size_t count = 0;
        for (const Planes& p : planes) count += sweep_solids(prepared, p.normal, p.offsets).size();
        return count;
    });
    step("fragility, thinness", [&] {
        double sum = 0;
        for (const Planes& p : planes) {
            for (const double f : sweep_thinness(prepared, p.normal, p.offsets, objectives.fragility_distance)) {
                sum += f;
            }
        }
        return sum;
    });
    step("the cut made, halves split into pieces", [&] {
        Segmentation s;
        s.pieces.push_back(m.piece);
        s.pieces.front().name = "A";
        Cut first;
        first.number = 1;
        first.piece = "A";
        const Planes& p = planes.front();
        first.chosen.plane = {p.normal, p.offsets[p.offsets.size() / 2]};
        apply(s, first, m.fragment_volume_mm3);
        return s;
    });
    return steps;
}

}  // namespace

double first_decision_s(const Measured& measured, int runs) {
    return best_of(runs, cpu_s, [&] { return decide(measured); });
}

void measure_decision(const Measured& m, const Baseline& base, const Effort& effort, Figures& figures) {
    const ThreadLimit one_thread(1);
    const int runs = std::min(effort.runs, 3);
    const double whole = first_decision_s(m, runs);
    figures.record(m.name, "first decision", time_text(whole));
    double known = 0;
    double box = 0;
    for (const Step& s : profile(m, runs)) {
        figures.record(m.name, "- of it: " + s.what,
                       time_text(s.seconds) + ", " + number_text(s.seconds / base.cut_s) + " cuts");
        known += s.seconds;
        if (s.what == "box") box = s.seconds;
    }
    figures.record(m.name, "- the rest", time_text(std::max(whole - known, 0.0)));
    figures.at_most(m.name, "first decision / one cut", whole / base.cut_s, 25);
    figures.at_most(m.name, "box / evaluation", box / base.evaluation_s, 1);

    const SearchSettings settings = settings_of(m);
    EvaluationCache cache(settings.objectives, settings.candidates);
    const Piece* piece = &m.piece;
    cache.evaluate(std::span(&piece, 1), Context{});
    Objectives others = settings.objectives;
    others.weights = {5, 1, 200, 1};
    const double again = best_of(20, cpu_s, [&] { return rank(cache.evaluations(m.piece), {}, others); });
    figures.at_most(m.name, "new ranking after a change of weights (" + time_text(again) + ") / evaluation",
                    again / base.evaluation_s, 0.01);
}

}  // namespace qchopper::bench
