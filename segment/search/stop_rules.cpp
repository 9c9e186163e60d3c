#include "segment/search/stop_rules.h"

#include <algorithm>
#include <array>

#include "segment/mesh/oriented_box.h"

namespace qchopper {
namespace {

std::array<double, 3> sorted(Vec3 a) {
    std::array<double, 3> s{a.x, a.y, a.z};
    std::sort(s.begin(), s.end());
    return s;
}

using Rule = std::function<bool(const Piece&)>;

// The rules that speak of single pieces.
std::vector<Rule> piece_rules(const StopRules& rules, const FitsCell& fits_cell) {
    std::vector<Rule> set;
    if (rules.max_faces) {
        set.emplace_back([&](const Piece& p) { return p.mesh->triangles.size() < *rules.max_faces; });
    }
    if (rules.max_obb) {
        set.emplace_back([&](const Piece& p) { return fits_in(oriented_box(p.mesh->points).size(), *rules.max_obb); });
    }
    if (rules.fits_cell && fits_cell) set.push_back(fits_cell);
    return set;
}

}  // namespace

bool fits_in(Vec3 size, Vec3 room) {
    const std::array<double, 3> a = sorted(size);
    const std::array<double, 3> b = sorted(room);
    return a[0] <= b[0] && a[1] <= b[1] && a[2] <= b[2];
}

NextPiece next_piece(const Segmentation& segmentation, const StopRules& rules, const FitsCell& fits_cell,
                     const std::vector<std::string>& passed_over) {
    const std::vector<Rule> set = piece_rules(rules, fits_cell);
    const bool has_cuts = rules.min_cuts && static_cast<int>(segmentation.cuts.size()) >= *rules.min_cuts;
    // failing[p]: piece p breaks a rule; broken[r]: some piece breaks rule r.
    std::vector<bool> failing(segmentation.pieces.size(), false);
    std::vector<bool> broken(set.size(), false);
    for (std::size_t p = 0; p < segmentation.pieces.size(); ++p) {
        for (std::size_t r = 0; r < set.size(); ++r) {
            if (set[r](segmentation.pieces[p])) continue;
            failing[p] = true;
            broken[r] = true;
        }
    }
    const bool all_hold = std::count(broken.begin(), broken.end(), true) == 0 && (!rules.min_cuts || has_cuts);
    const bool one_holds = has_cuts || std::count(broken.begin(), broken.end(), false) > 0;
    NextPiece next;
    next.is_finished = rules.combine == Stop::all ? all_hold : one_holds || all_hold;
    if (next.is_finished || static_cast<int>(segmentation.cuts.size()) >= rules.max_cuts) return next;
    // Only the number of cuts is missing: any piece may be cut.
    const bool any_piece = std::count(failing.begin(), failing.end(), true) == 0;
    for (std::size_t p = 0; p < segmentation.pieces.size(); ++p) {
        const Piece& piece = segmentation.pieces[p];
        if (!any_piece && !failing[p]) continue;
        if (std::find(passed_over.begin(), passed_over.end(), piece.name) != passed_over.end()) continue;
        if (!next.piece || piece.mesh->triangles.size() > segmentation.pieces[*next.piece].mesh->triangles.size()) {
            next.piece = p;
        }
    }
    return next;
}

}  // namespace qchopper
