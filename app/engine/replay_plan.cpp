// For each cut: find the leaf, make the cut on a copy, compare the pieces, then keep the copy. O(cuts) times the cost
// of a cut and of one evaluation of its plane.

#include "app/engine/replay_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "app/store/replay.h"
#include "base/text.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/connectivity/containment.h"

namespace qchopper {
namespace {

std::string percent(double share) {
    return significant(100 * share, 3) + " %";
}

std::string in_mm(double value) {
    return significant(value, 6) + " mm";
}

double relative(double a, double b) {
    return std::abs(a - b) / std::max(std::abs(b), std::numeric_limits<double>::min());
}

// Whether a vertex lies numerically on the plane, so that it has to be nudged. An offset that was nudged once is 32 ulp
// away from every vertex.
bool touches_vertex(const TriangleMesh& mesh, const Plane& plane) {
    const Extent range = extent(mesh, plane.normal);
    const double largest = std::max(std::abs(range.low), std::abs(range.high));
    const double ulp = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
    return std::any_of(mesh.points.begin(), mesh.points.end(),
                       [&](Vec3 p) { return std::abs(height(plane.normal, p) - plane.offset) < 16 * ulp; });
}

class Replay {
 public:
    Replay(const Plan& plan, const ScanSource& source, const SearchSettings& settings, EvaluationCache& cache,
           const Context& context, const PlanFit& fit)
        : plan_(plan), source_(source), settings_(settings), cache_(cache), context_(context), fit_(fit) {}

    PlanReplay run(Segmentation& segmentation, const std::function<void(const Segmentation&)>& on_decision) {
        result_.applies = discard_here(segmentation, on_decision);
        for (auto planned = plan_.cuts.begin(); result_.applies && planned != plan_.cuts.end(); ++planned) {
            context_.check_cancelled();
            context_.progress("cuts of the plan made", static_cast<std::size_t>(planned->number) - 1,
                              plan_.cuts.size());
            const std::string why = make(*planned, segmentation);
            if (!why.empty()) {
                result_.why = "cut " + std::to_string(planned->number) + " on piece " + planned->piece + ": " + why;
                result_.applies = false;
                return result_;
            }
            on_decision(segmentation);
            result_.applies = discard_here(segmentation, on_decision);
        }
        return result_;
    }

 private:
    // Discards what the plan discards after so many cuts as there are; false if a piece is not found.
    bool discard_here(Segmentation& segmentation, const std::function<void(const Segmentation&)>& on_decision) {
        for (const PlanDiscard& planned : plan_.discards) {
            if (static_cast<std::size_t>(planned.after) != segmentation.cuts.size()) continue;
            std::string why;
            const std::optional<std::size_t> found = find(planned, segmentation, why);
            if (!found || !discard(segmentation, segmentation.pieces[*found].name)) {
                result_.why = "discard of piece " + planned.piece + ": " + (found ? "it is the only piece" : why);
                return false;
            }
            on_decision(segmentation);
        }
        return true;
    }

    // Makes one cut. Returns why it cannot be made; empty: it is made.
    std::string make(const PlanCut& planned, Segmentation& segmentation) {
        std::string why;
        const std::optional<std::size_t> found = find(planned, segmentation, why);
        if (!found) return why;
        const Piece& piece = segmentation.pieces[*found];
        const std::optional<Plane> plane = plane_for(planned, piece);
        if (!plane) return "its plane misses the piece";
        const Candidate candidate{*plane, wanted_offset(planned), -1, -1};
        const std::optional<Ranked> ranked = rank_plane(segmentation, *found, candidate, settings_, cache_, context_);
        if (!ranked) {
            return cache_.evaluation_of(piece, candidate, context_)
                       ? "its plane leaves only fragments of the piece on one side"
                       : "its plane misses the piece";
        }
        Segmentation after = segmentation;
        if (!apply(after, cut_by(segmentation, *found, {*ranked}, 0, settings_),
                   settings_.objectives.fragment_volume_mm3)) {
            return "its plane misses the piece";
        }
        why = compare(planned, after);
        if (why.empty()) segmentation = std::move(after);
        return why;
    }

    // On the plan's own scan the centres are equal, and the offset keeps its bits.
    double wanted_offset(const PlanCut& planned) const {
        return planned.from_centre + height(planned.plane.normal, plan_.scan.centre - source_.centre);
    }

    std::optional<Plane> plane_for(const PlanCut& planned, const Piece& piece) {
        const Plane plane{planned.plane.normal, wanted_offset(planned)};
        if (!touches_vertex(*piece.mesh, plane)) return plane;
        const std::optional<Nudged> nudged = nudge(piece, plane.normal, std::span(&plane.offset, 1)).front();
        if (!nudged) return std::nullopt;
        result_.notes.push_back("cut " + std::to_string(planned.number) +
                                ": a vertex of this scan lies on the plane; " + "its offset is nudged by " +
                                in_mm(nudged->offset - plane.offset));
        return Plane{plane.normal, nudged->offset};
    }

    // The leaf at the same place of the BSP that holds the plan's point and has its share of the volume.
    std::optional<std::size_t> find(const PlanPiece& planned, const Segmentation& segmentation,
                                    std::string& why) const {
        const Vec3 inside = planned.inside - source_.centre;
        for (std::size_t p = 0; p < segmentation.pieces.size(); ++p) {
            const Piece& piece = segmentation.pieces[p];
            const bool is_there =
                std::equal(piece.half_spaces.begin(), piece.half_spaces.end(), planned.path.begin(), planned.path.end(),
                           [](const HalfSpace& b, const PathSide& s) { return b.cut == s.cut && b.above == s.above; });
            if (!is_there || !is_inside(*piece.mesh, inside)) continue;
            const double off = share_off(volume_mm3(*piece.mesh), planned.volume_mm3);
            if (off <= fit_.max_volume_off) return p;
            why = "piece " + piece.name + " lies there, but its volume differs by " + percent(off);
            return std::nullopt;
        }
        why = "no piece is there: none at that place of the cuts holds the plan's point";
        return std::nullopt;
    }

    // Relative difference of a piece's share of the whole from that in the plan.
    double share_off(double volume, double planned_volume) const {
        return relative(volume / source_.volume_mm3, planned_volume / plan_.scan.volume_mm3);
    }

    // Compares the pieces of the last cut with those in the plan. Returns what differs; empty: nothing.
    std::string compare(const PlanCut& planned, const Segmentation& after) {
        std::vector<double> made;
        for (const std::string& name : after.cuts.back().pieces) {
            const std::optional<std::size_t> piece = piece_named(after, name);
            assert(piece);
            made.push_back(volume_mm3(*after.pieces[*piece].mesh));
        }
        std::sort(made.rbegin(), made.rend());
        if (made.empty()) return "it leaves only fragments";
        if (made.size() != planned.makes_mm3.size()) {
            return "it makes " + std::to_string(made.size()) + " pieces here, the smallest of " +
                   std::to_string(made.back()) + " mm3, and " + std::to_string(planned.makes_mm3.size()) +
                   " in the plan";
        }
        double largest = 0;
        for (std::size_t i = 0; i < made.size(); ++i) {
            const double off = share_off(made[i], planned.makes_mm3[i]);
            if (off > fit_.max_volume_off) return "a piece that it makes differs in volume by " + percent(off);
            largest = std::max(largest, relative(made[i], planned.makes_mm3[i]));
        }
        result_.largest_volume_off = std::max(result_.largest_volume_off, largest);
        return {};
    }

    const Plan& plan_;
    const ScanSource& source_;
    const SearchSettings& settings_;
    EvaluationCache& cache_;
    const Context& context_;
    const PlanFit& fit_;
    PlanReplay result_;
};

}  // namespace

std::string misfit(const Plan& plan, const ScanSource& source, const TriangleMesh& scan, const PlanFit& fit) {
    const PlanScan& s = plan.scan;
    if (s.scale != source.scale) {
        return "the plan was made at scale " + std::to_string(s.scale) + ", this scan is taken at " +
               std::to_string(source.scale);
    }
    const double diagonal = norm(s.box.size());
    const Box box = bounds(scan);
    const double off = std::max(norm(box.min + source.centre - s.box.min), norm(box.max + source.centre - s.box.max));
    if (off > fit.max_box_off * diagonal) {
        return "the boxes of the two scans are " + in_mm(off) +
               " apart: this is another specimen, another unit, or another frame";
    }
    const double volume_off = relative(source.volume_mm3, s.volume_mm3);
    if (volume_off > fit.max_volume_off) {
        return "the volumes of the two scans differ by " + percent(volume_off);
    }
    return {};
}

PlanReplay replay_plan(const Plan& plan, const ScanSource& source, Segmentation& segmentation,
                       const SearchSettings& settings, EvaluationCache& cache,
                       const std::function<void(const Segmentation&)>& on_decision, const Context& context,
                       const PlanFit& fit) {
    return Replay(plan, source, settings, cache, context, fit).run(segmentation, on_decision);
}

}  // namespace qchopper
