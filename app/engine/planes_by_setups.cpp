// Up to six cuts of the piece, and the setups of the two pieces of each, side by side.

#include "app/engine/planes_by_setups.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <tuple>

#include "app/engine/review_cuts.h"
#include "segment/cut/nudge.h"
#include "segment/search/candidates/cap_frame.h"
#include "segment/search/further_candidates.h"
#include "segment/search/rank_piece.h"

namespace qchopper {
namespace {

// What the setups of the pieces that a plane makes leave out of reach.
struct TriedPlane {
    Ranked plane;
    bool fits = true;            // every piece
    double above_limit_mm2 = 0;  // of pieces of which it is more than may be
    double unreachable_mm2 = 0;  // of all
    bool is_good() const { return fits && above_limit_mm2 == 0; }
};

// Across the axes of the piece's box, at the offset of the candidates that is nearest to its middle.
std::vector<Ranked> through_the_middle(const Segmentation& segmentation, std::size_t piece,
                                       const SearchSettings& settings, EvaluationCache& cache, const Context& context) {
    const Piece& target = segmentation.pieces[piece];
    const std::vector<NoCutTriangle> no_cut = no_cut_triangles(*target.mesh, settings.candidates.no_cut);
    const std::vector<Vec3> axes =
        candidate_normals(box_for_cuts(target, cache.box(target), settings.candidates), CandidateNormals::box);
    std::vector<Ranked> planes;
    for (std::size_t n = 0; n < axes.size(); ++n) {
        const std::vector<double> offsets = candidate_offsets(extent(*target.mesh, axes[n]), settings.candidates);
        if (offsets.empty()) continue;
        const std::size_t middle = offsets.size() / 2;
        for (Candidate candidate : candidates_at(target, axes[n], static_cast<int>(n), {offsets[middle]}, no_cut)) {
            candidate.offset_index = static_cast<int>(middle);
            const std::optional<Ranked> plane = rank_plane(segmentation, piece, candidate, settings, cache, context);
            if (plane && !is_forbidden(plane->terms, settings.objectives)) planes.push_back(*plane);
        }
    }
    return planes;
}

// The best of the ranking, those through the middle, then further ones of the ranking that are not near to each other.
std::vector<Ranked> planes_to_try(const Segmentation& segmentation, std::size_t piece,
                                  const std::vector<Ranked>& ranked, const SearchSettings& settings,
                                  EvaluationCache& cache, const Context& context) {
    const Piece& target = segmentation.pieces[piece];
    std::vector<std::size_t> apart = without_near_planes(ranked, target, cache.box(target));
    apart.resize(std::min(apart.size(), tried_planes));
    std::vector<Ranked> planes = through_the_middle(segmentation, piece, settings, cache, context);
    for (const std::size_t k : apart) planes.insert(k == 0 ? planes.begin() : planes.end(), ranked[k]);
    for (auto plane = planes.begin(); plane != planes.end();) {
        const bool is_known =
            std::any_of(planes.begin(), plane, [&](const Ranked& other) { return other.plane == plane->plane; });
        plane = is_known ? planes.erase(plane) : std::next(plane);
    }
    return planes;
}

TriedPlane judged(const Ranked& plane, const std::vector<Piece>& pieces, double limit, Setups& setups) {
    TriedPlane tried{plane};
    for (const Piece& part : pieces) {
        const MappedSetup& piece_setup = setups.mapped(part);
        const SurfaceAccess& access = piece_setup.setup().access;
        tried.fits = tried.fits && piece_setup.stock_fit.fits() && setups.fits(part);
        tried.unreachable_mm2 += access.unreachable_mm2();
        if (access.exceeds(limit)) tried.above_limit_mm2 += access.unreachable_mm2();
    }
    return tried;
}

}  // namespace

std::vector<Piece> pieces_made(const Segmentation& segmentation, std::size_t piece, const Ranked& plane,
                               double fragment_volume_mm3) {
    Segmentation alone;
    alone.pieces = {segmentation.pieces[piece]};
    alone.names_given = segmentation.names_given;
    Cut cut;
    cut.number = static_cast<std::int32_t>(segmentation.cuts.size()) + 1;
    cut.piece = alone.pieces.front().name;
    cut.chosen = plane;
    if (!apply(alone, std::move(cut), fragment_volume_mm3)) return {};
    return std::move(alone.pieces);
}

std::vector<Ranked> planes_by_setups(const Segmentation& segmentation, std::size_t piece, std::vector<Ranked> ranked,
                                     const SearchSettings& settings, Setups& setups, EvaluationCache& cache,
                                     const Context& context) {
    assert(settings.stop.max_unreachable);
    const std::vector<Ranked> planes = planes_to_try(segmentation, piece, ranked, settings, cache, context);
    const std::string what = "setups compared: planes of piece " + segmentation.pieces[piece].name;
    Context of_pieces;
    of_pieces.cancelled = context.cancelled;
    std::vector<TriedPlane> tried;
    for (std::size_t k = 0; k < planes.size() && (tried.empty() || !tried.back().is_good()); ++k) {
        context.progress(what, k, planes.size());
        const std::vector<Piece> pieces =
            pieces_made(segmentation, piece, planes[k], settings.objectives.fragment_volume_mm3);
        if (pieces.empty()) continue;
        setups.map(pieces, of_pieces);
        tried.push_back(judged(planes[k], pieces, *settings.stop.max_unreachable, setups));
    }
    std::stable_sort(tried.begin(), tried.end(), [](const TriedPlane& a, const TriedPlane& b) {
        return std::tuple(!a.fits, a.above_limit_mm2, a.unreachable_mm2) <
               std::tuple(!b.fits, b.above_limit_mm2, b.unreachable_mm2);
    });
    std::vector<Ranked> ordered;
    ordered.reserve(tried.size() + ranked.size());
    for (const TriedPlane& t : tried) ordered.push_back(t.plane);
    std::erase_if(ranked, [&](const Ranked& r) {
        return std::any_of(tried.begin(), tried.end(), [&](const TriedPlane& t) { return t.plane.plane == r.plane; });
    });
    ordered.insert(ordered.end(), ranked.begin(), ranked.end());
    return ordered;
}

}  // namespace qchopper
