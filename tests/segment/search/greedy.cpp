#include "tests/segment/search/greedy.h"

#include <algorithm>
#include <cstdlib>

#include "segment/search/candidates/evaluate.h"
#include "tests/segment/search/next_piece.h"

namespace qchopper::greedy {
namespace {

std::vector<Ranked> ranked(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings) {
    std::vector<PieceShare> others;
    for (std::size_t p = 0; p < segmentation.pieces.size(); ++p) {
        if (p != piece) others.push_back(share(measure(segmentation.pieces[p]), settings.objectives));
    }
    std::vector<Ranked> all;
    const std::vector<Candidate> candidates = candidate_planes(segmentation.pieces[piece], settings.candidates);
    const auto evaluations = evaluate_all(segmentation.pieces[piece], candidates, settings.objectives, Context{});
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const Candidate& c = candidates[i];
        const std::optional<Terms> t =
            evaluations[i] ? terms(*evaluations[i], others, settings.objectives) : std::nullopt;
        if (t) all.push_back({c.plane, c.wanted_offset, c.normal_index, c.offset_index, *t});
    }
    // The order of the candidates is that of ties: a plane goes before another only if it is better by more than a tie
    // than the best of those that are left.
    std::vector<Ranked> result;
    while (!all.empty()) {
        double best = all.front().terms.total;
        for (const Ranked& r : all) best = std::min(best, r.terms.total);
        for (auto r = all.begin(); r != all.end();) {
            if (r->terms.total > best + tie) {
                ++r;
                continue;
            }
            result.push_back(*r);
            r = all.erase(r);
        }
    }
    return result;
}

// Without those that are the next along the same normal to a better one.
std::vector<Ranked> without_neighbours(const std::vector<Ranked>& all) {
    std::vector<Ranked> kept;
    for (const Ranked& r : all) {
        const auto is_next_to = [&](const Ranked& better) {
            return better.normal_index == r.normal_index && std::abs(better.offset_index - r.offset_index) <= 1;
        };
        if (std::none_of(kept.begin(), kept.end(), is_next_to)) kept.push_back(r);
    }
    return kept;
}

}  // namespace

bool search(Segmentation& segmentation, const SearchSettings& settings) {
    std::vector<std::string> passed_over;
    while (true) {
        const NextPiece next = next_piece(segmentation, settings.stop, {}, passed_over);
        if (next.is_finished || !next.piece) return next.is_finished;
        const std::string name = segmentation.pieces[*next.piece].name;
        const std::vector<Ranked> all = ranked(segmentation, *next.piece, settings);
        Cut cut;
        cut.number = static_cast<std::int32_t>(segmentation.cuts.size()) + 1;
        cut.piece = name;
        cut.candidates = all.size();
        if (!all.empty()) {
            cut.chosen = all.front();
            std::vector<Ranked> others = without_neighbours(all);
            others.erase(others.begin());
            others.resize(std::min(others.size(), settings.runners_up));
            cut.runners_up = std::move(others);
        }
        if (all.empty() || !apply(segmentation, cut, settings.objectives.fragment_volume_mm3))
            passed_over.push_back(name);
    }
}

}  // namespace qchopper::greedy
