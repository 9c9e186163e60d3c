// Every rule is checked on every piece; results are kept by mesh. O(p log p) for p pieces, besides the checks.

#include "segment/search/stop_rules.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "segment/mesh/oriented_box.h"

namespace qchopper {
namespace {

std::array<double, 3> sorted(Vec3 a) {
    std::array<double, 3> s{a.x, a.y, a.z};
    std::sort(s.begin(), s.end());
    return s;
}

}  // namespace

bool fits_in(Vec3 size, Vec3 limit) {
    const std::array<double, 3> a = sorted(size);
    const std::array<double, 3> b = sorted(limit);
    return a[0] <= b[0] && a[1] <= b[1] && a[2] <= b[2];
}

StopJudge::StopJudge(StopRules rules, FitsCell fits_cell, std::function<Vec3(const Piece&)> box_size) : rules_(rules) {
    if (rules.max_faces) {
        piece_rules_.emplace_back(
            [most = *rules.max_faces](const Piece& p) { return p.mesh->triangles.size() < most; });
    }
    if (rules.max_obb) {
        piece_rules_.emplace_back(
            [limit = *rules.max_obb, size = std::move(box_size)](const Piece& p) { return fits_in(size(p), limit); });
    }
    if (rules.fits_cell && fits_cell) piece_rules_.push_back(std::move(fits_cell));
}

const std::vector<bool>& StopJudge::verdict(const Piece& piece) {
    Verdict& v = verdicts_[piece.mesh.get()];
    if (v.mesh.expired()) {
        v.mesh = piece.mesh;
        v.holds.clear();
        for (const auto& rule : piece_rules_) v.holds.push_back(rule(piece));
    }
    assert(v.holds.size() == piece_rules_.size());
    return v.holds;
}

NextPiece StopJudge::next(const Segmentation& segmentation, const std::vector<std::string>& passed_over) {
    const int cuts = static_cast<int>(segmentation.cuts.size());
    const bool has_cuts = rules_.min_cuts && cuts >= *rules_.min_cuts;
    std::vector<bool> failing(segmentation.pieces.size(), false);  // per piece: it breaks a rule
    std::vector<bool> broken(piece_rules_.size(), false);          // per rule: some piece breaks it
    for (std::size_t p = 0; p < segmentation.pieces.size(); ++p) {
        const std::vector<bool>& holds = verdict(segmentation.pieces[p]);
        for (std::size_t r = 0; r < holds.size(); ++r) {
            if (holds[r]) continue;
            failing[p] = true;
            broken[r] = true;
        }
    }
    const bool all_hold = std::count(broken.begin(), broken.end(), true) == 0 && (!rules_.min_cuts || has_cuts);
    const bool one_holds = has_cuts || std::count(broken.begin(), broken.end(), false) > 0;
    NextPiece next;
    next.is_finished = rules_.combine == Stop::all ? all_hold : one_holds || all_hold;
    if (next.is_finished || cuts >= rules_.max_cuts) return next;
    // Only the number of cuts is missing: any piece may be cut.
    const bool any_piece = std::count(failing.begin(), failing.end(), true) == 0;
    for (std::size_t p = 0; p < segmentation.pieces.size(); ++p) {
        const std::string& name = segmentation.pieces[p].name;
        const bool is_passed_over = std::find(passed_over.begin(), passed_over.end(), name) != passed_over.end();
        if ((any_piece || failing[p]) && !is_passed_over) next.waiting.push_back(p);
    }
    std::stable_sort(next.waiting.begin(), next.waiting.end(), [&](std::size_t a, std::size_t b) {
        return segmentation.pieces[a].mesh->triangles.size() > segmentation.pieces[b].mesh->triangles.size();
    });
    if (next.waiting.empty()) return next;
    next.piece = next.waiting.front();
    if (any_piece) {
        const auto missing = static_cast<std::size_t>(std::max(rules_.min_cuts.value_or(0) - cuts, 1));
        next.waiting.resize(std::min(next.waiting.size(), missing));
    }
    return next;
}

NextPiece next_piece(const Segmentation& segmentation, const StopRules& rules, const FitsCell& fits_cell,
                     const std::vector<std::string>& passed_over) {
    const auto size = [](const Piece& p) { return oriented_box(p.mesh->points).size(); };
    return StopJudge(rules, fits_cell, size).next(segmentation, passed_over);
}

}  // namespace qchopper
