#include "segment/search/search.h"

#include <algorithm>

#include "segment/score/pricing.h"

namespace qchopper {
namespace {

constexpr double tie = 1e-9;

std::vector<PieceShare> shares_of_others(const Segmentation& segmentation, std::size_t piece,
                                         const Objectives& objectives) {
    std::vector<PieceShare> shares;
    for (std::size_t p = 0; p < segmentation.pieces.size(); ++p) {
        if (p != piece) shares.push_back(share(measure(segmentation.pieces[p]), objectives));
    }
    return shares;
}

// Best first. Totals within a tie of the group's best are one group, in which the candidates' order decides.
void sort_best_first(std::vector<Ranked>& ranked) {
    const auto by_order = [](const Ranked& a, const Ranked& b) {
        return std::pair(a.normal, a.offset) < std::pair(b.normal, b.offset);
    };
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const Ranked& a, const Ranked& b) { return a.terms.total < b.terms.total; });
    for (auto group = ranked.begin(); group != ranked.end();) {
        auto end = group;
        while (end != ranked.end() && end->terms.total <= group->terms.total + tie) ++end;
        std::sort(group, end, by_order);
        group = end;
    }
}

}  // namespace

std::vector<Ranked> rank(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                         const RayTree& scan_rays, const Context& context) {
    const Piece& target = segmentation.pieces[piece];
    const std::vector<Candidate> candidates = candidate_planes(target, settings.candidates);
    const auto prices = price_all(target, candidates, settings.objectives, scan_rays, context);
    const std::vector<PieceShare> others = shares_of_others(segmentation, piece, settings.objectives);
    std::vector<Ranked> ranked;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (!prices[i]) continue;
        const std::optional<Terms> t = terms(*prices[i], others, settings.objectives);
        if (!t) continue;
        const Candidate& c = candidates[i];
        ranked.push_back({c.plane, c.wanted_offset, c.normal, c.offset, *t});
    }
    sort_best_first(ranked);
    return ranked;
}

SearchEnd search(Segmentation& segmentation, const SearchSettings& settings, const RayTree& scan_rays,
                 const FitsCell& fits_cell, const std::function<void(const Segmentation&)>& on_cut,
                 const Context& context) {
    std::vector<std::string> passed_over;
    while (true) {
        context.check_cancelled();
        const NextPiece next = next_piece(segmentation, settings.stop, fits_cell, passed_over);
        if (next.is_finished) return {true, "the stop rules hold"};
        if (static_cast<int>(segmentation.cuts.size()) >= settings.stop.max_cuts) {
            return {false, "the safety stop of " + std::to_string(settings.stop.max_cuts) + " cuts is reached"};
        }
        if (!next.piece) return {false, "no plane parts any of the unfinished pieces"};
        const std::string name = segmentation.pieces[*next.piece].name;
        const std::vector<Ranked> ranked = rank(segmentation, *next.piece, settings, scan_rays, context);
        Cut cut;
        cut.number = static_cast<std::int32_t>(segmentation.cuts.size()) + 1;
        cut.piece = name;
        cut.candidates = ranked.size();
        if (!ranked.empty()) {
            cut.chosen = ranked.front();
            const auto last = std::min(ranked.size(), settings.runners_up + 1);
            cut.runners_up.assign(ranked.begin() + 1, ranked.begin() + static_cast<std::ptrdiff_t>(last));
        }
        if (ranked.empty() || !apply(segmentation, cut, settings.objectives.crumb_volume_mm3)) {
            passed_over.push_back(name);
            continue;
        }
        on_cut(segmentation);
    }
}

}  // namespace qchopper
