// Setups are computed by app/jobs/setups.h, those of all planes that are tried side by side. The cost is that of the
// setups of about six pieces per cut that is asked, and of three cuts.

#include "app/engine/review_cuts.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "segment/mesh/oriented_box.h"
#include "segment/search/recut.h"
#include "segment/search/stop_rules.h"
#include "segment/search/trial.h"

namespace qchopper {
namespace {

// The rules on single pieces that decide whether a piece can be milled at all.
struct RulesHeld {
    bool faces = true;
    bool box = true;
    bool fits = true;
    bool are_as_in(const RulesHeld& before) const {
        return (faces || !before.faces) && (box || !before.box) && (fits || !before.fits);
    }
};

RulesHeld rules_held(std::span<const Piece> pieces, const StopRules& rules, Setups& setups) {
    RulesHeld held;
    for (const Piece& piece : pieces) {
        if (rules.max_faces && piece.mesh->triangles.size() >= *rules.max_faces) held.faces = false;
        if (rules.max_obb && !fits_in(oriented_box(piece.mesh->points).size(), *rules.max_obb)) held.box = false;
        if (!setups.mapped(piece).stock_fit.fits() || !setups.fits(piece)) held.fits = false;
    }
    return held;
}

bool are_machinable(std::span<const Piece> pieces, Setups& setups) {
    return std::all_of(pieces.begin(), pieces.end(), [&](const Piece& piece) { return setups.is_machinable(piece); });
}

MilledSurface milled(std::span<const Piece> pieces, Setups& setups) {
    MilledSurface sum;
    for (const Piece& piece : pieces) {
        const SurfaceAccess& access = setups.mapped(piece).setup().access;
        sum.unreachable_mm2 += access.unreachable_mm2();
        sum.area_mm2 += access.area_mm2;
    }
    return sum;
}

std::vector<Piece> pieces_of(const Segmentation& segmentation, std::int32_t cut) {
    std::vector<Piece> pieces;
    for (const Piece& piece : segmentation.pieces) {
        if (made_by(piece) == cut) pieces.push_back(piece);
    }
    return pieces;
}

// The cut by its k-th runner-up; the plane that was chosen becomes one of these, in their order.
Cut by_runner_up(Cut cut, std::size_t k) {
    std::swap(cut.chosen, cut.runners_up[k]);
    const Ranked old = cut.runners_up[k];
    cut.runners_up.erase(cut.runners_up.begin() + static_cast<std::ptrdiff_t>(k));
    const auto worse = std::find_if(cut.runners_up.begin(), cut.runners_up.end(),
                                    [&](const Ranked& r) { return r.terms.total >= old.terms.total; });
    cut.runners_up.insert(worse, old);
    return cut;
}

// Each alone, by the first of its other planes that divide the piece.
std::vector<Segmentation> other_cuts(const Segmentation& segmentation, const Piece& divided, const Cut& cut,
                                     double fragment_volume_mm3, const Context& context) {
    std::vector<Segmentation> others;
    std::size_t tried = 0;
    for (std::size_t k = 0; k < cut.runners_up.size() && tried < tried_planes; ++k) {
        if (cut.runners_up[k].plane == cut.chosen.plane) continue;
        context.check_cancelled();
        ++tried;
        auto alone = cut_alone(segmentation, divided, by_runner_up(cut, k), fragment_volume_mm3);
        if (alone) others.push_back(std::move(*alone));
    }
    return others;
}

// All setups at once, so that many threads have work.
void compute_setups(const std::vector<Segmentation>& cuts, const Cut& cut, Setups& setups, const Context& context) {
    const std::string what = "setups compared: cut " + std::to_string(cut.number) + " of piece " + cut.piece;
    Context compared = context;
    compared.on_progress = [&](const Progress& p) { context.progress(what, p.done, p.total); };
    std::vector<Piece> pieces;
    for (const Segmentation& alone : cuts) pieces.insert(pieces.end(), alone.pieces.begin(), alone.pieces.end());
    compared.progress(what, 0, pieces.size());
    setups.map(pieces, compared);
}

}  // namespace

std::vector<std::int32_t> doubtful_cuts(const Segmentation& segmentation, Setups& setups, const Context& context) {
    setups.map(segmentation.pieces, context);
    std::set<std::int32_t> numbers;
    std::size_t done = 0;
    for (const Piece& piece : segmentation.pieces) {
        context.check_cancelled();
        context.progress("setups compared with the search", done++, segmentation.pieces.size());
        const double share = setups.mapped(piece).setup().access.unreachable_share();
        if (made_by(piece) == 0 || numbers.contains(made_by(piece)) || share <= doubtful_share) continue;
        if (share - setups.unreachable_without_holder(piece).share > doubtful_share) numbers.insert(made_by(piece));
    }
    return {numbers.begin(), numbers.end()};
}

MilledSurface milled_surface(const Segmentation& segmentation, std::int32_t cut, Setups& setups) {
    return milled(pieces_of(segmentation, cut), setups);
}

RecutTrial try_other_planes(const Segmentation& segmentation, const Piece& divided, std::int32_t number,
                            const SearchSettings& settings, Setups& setups, const Context& context) {
    const Cut& cut = segmentation.cuts[static_cast<std::size_t>(number - 1)];
    std::vector<Segmentation> others =
        other_cuts(segmentation, divided, cut, settings.objectives.fragment_volume_mm3, context);
    compute_setups(others, cut, setups, context);
    const std::vector<Piece> pieces = pieces_of(segmentation, number);
    const RulesHeld held = rules_held(pieces, settings.stop, setups);
    RecutTrial trial;
    trial.review = {number, cut.piece, ReviewOutcome::kept, 0, milled(pieces, setups), {}};
    trial.review.best = trial.review.before;
    Segmentation* best = nullptr;
    for (Segmentation& alone : others) {
        if (!rules_held(alone.pieces, settings.stop, setups).are_as_in(held)) continue;
        const MilledSurface surface = milled(alone.pieces, setups);
        ++trial.review.planes;
        if (best != nullptr && surface.unreachable_mm2 >= trial.review.best.unreachable_mm2) continue;
        if (settings.stop.fits_cell && are_machinable(pieces, setups) && !are_machinable(alone.pieces, setups))
            continue;
        best = &alone;
        trial.review.best = surface;
    }
    const double gain_mm2 = trial.review.before.unreachable_mm2 - trial.review.best.unreachable_mm2;
    if (best == nullptr || gain_mm2 < min_fall_mm2(divided, 0, setups.min_gain_mm2())) return trial;
    trial.review.outcome = ReviewOutcome::replaced;
    trial.better = std::move(*best);
    return trial;
}

}  // namespace qchopper
