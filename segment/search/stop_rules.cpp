// Every rule is checked on every piece; results are kept by mesh. O(p log p) for p pieces, besides the checks.

#include "segment/search/stop_rules.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "base/text.h"
#include "segment/mesh/boxes_needed.h"

namespace qchopper {
namespace {

std::array<double, 3> sorted(Vec3 a) {
    std::array<double, 3> s{a.x, a.y, a.z};
    std::sort(s.begin(), s.end());
    return s;
}

std::string lengths(Vec3 v) {
    return fixed(v.x, 1) + " x " + fixed(v.y, 1) + " x " + fixed(v.z, 1);
}

// "7.4 % of its surface is out of reach (2 % may be)", with as many digits as tell the two apart.
std::string out_of_reach(double share, double limit) {
    int digits = 3;
    while (digits < 9 && significant(100 * share, digits) == significant(100 * limit, digits)) ++digits;
    return significant(100 * share, digits) + " % of its surface is out of reach (" + significant(100 * limit, digits) +
           " % may be)";
}

}  // namespace

bool fits_in(Vec3 size, Vec3 limit) {
    const std::array<double, 3> a = sorted(size);
    const std::array<double, 3> b = sorted(limit);
    return a[0] <= b[0] && a[1] <= b[1] && a[2] <= b[2];
}

StopJudge::StopJudge(StopRules rules, PieceChecks checks, std::function<Vec3(const Piece&)> box_size,
                     std::function<double(const Piece&)> priority)
    : rules_(rules), priority_(std::move(priority)), is_size_first_(priority_), checks_(std::move(checks)) {
    if (!priority_) {
        priority_ = [](const Piece& piece) { return static_cast<double>(piece.mesh->triangles.size()); };
    }
    if (rules.max_faces) {
        piece_rules_.push_back({[most = *rules.max_faces](const Piece& p) { return p.mesh->triangles.size() < most; },
                                [most = *rules.max_faces](const Piece& p) {
                                    return with_commas(p.mesh->triangles.size()) + " faces (fewer than " +
                                           with_commas(most) + " are wanted)";
                                }});
    }
    if (rules.max_obb) {
        piece_rules_.push_back(
            {[limit = *rules.max_obb, size = box_size](const Piece& p) { return fits_in(size(p), limit); },
             [limit = *rules.max_obb, size = std::move(box_size)](const Piece& p) {
                 return "a box of " + lengths(size(p)) + " mm (" + lengths(limit) + " mm may be)";
             },
             [limit = *rules.max_obb](const Piece&) {
                 return [limit](Vec3 size) { return boxes_needed(size, limit); };
             }});
    }
    if (rules.fits_cell && checks_.fits_cell) {
        piece_rules_.push_back(cell_rule());
    }
}

StopJudge::PieceRule StopJudge::cell_rule() const {
    const PieceChecks& checks = checks_;
    if (!asks_machine()) {
        return {checks.fits_cell, [](const Piece&) { return "it does not fit the cell"; },
                [blocks = checks.blocks_needed](const Piece&) { return blocks; }};
    }
    return {[checks](const Piece& p) { return checks.fits_cell(p) && checks.is_machinable(p); },
            [checks](const Piece& p) {
                return checks.fits_cell(p) ? "arm and tools of the cell cannot carve it in one piece"
                                           : "it does not fit the cell";
            },
            [checks](const Piece& p) { return checks.fits_cell(p) ? checks.low_blocks_needed : checks.blocks_needed; }};
}

// Of several pieces that are not known yet, where no rule comes before those of the cell.
void StopJudge::work_out(const std::vector<Piece>& pieces) const {
    const bool asks_cell = rules_.fits_cell && checks_.fits_cell;
    if (!checks_.work_out || piece_rules_.size() != (asks_cell ? 1U : 0U)) return;
    std::vector<Piece> unknown;
    for (const Piece& piece : pieces) {
        const auto known = verdicts_.find(piece.mesh.get());
        if (known == verdicts_.end() || known->second.mesh.expired()) unknown.push_back(piece);
    }
    if (unknown.size() < 2) return;
    checks_.work_out(unknown, {asks_cell, asks_cell && asks_machine(), is_access_limited()});
}

StopJudge::Verdict& StopJudge::verdict(const Piece& piece) {
    Verdict& v = verdicts_[piece.mesh.get()];
    if (v.mesh.expired()) {
        v = {piece.mesh, {}, {}};
        for (const PieceRule& rule : piece_rules_) v.holds.push_back(rule.holds(piece));
    }
    assert(v.holds.size() == piece_rules_.size());
    return v;
}

const UnreachableSurface& StopJudge::unreachable(const Piece& piece) {
    assert(is_access_limited());
    std::optional<UnreachableSurface>& surface = verdict(piece).unreachable;
    if (!surface) surface = checks_.unreachable(piece);
    return *surface;
}

std::vector<Ranked> StopJudge::planes_on_trial(const Segmentation& segmentation, std::size_t piece,
                                               std::vector<Ranked> ranked) const {
    return checks_.planes_on_trial ? checks_.planes_on_trial(segmentation, piece, std::move(ranked)) : ranked;
}

BlocksNeeded StopJudge::too_large_for(const Piece& piece) {
    const std::vector<bool>& holds = verdict(piece).holds;
    BlocksNeeded all;
    for (std::size_t r = 0; r < holds.size(); ++r) {
        if (holds[r] || !piece_rules_[r].blocks) continue;
        const BlocksNeeded blocks = piece_rules_[r].blocks(piece);
        if (!blocks) continue;
        all = all ? [all, blocks](Vec3 size) { return std::max(all(size), blocks(size)); } : blocks;
    }
    return all;
}

std::string StopJudge::why(const Piece& piece) {
    std::string faults;
    const auto add = [&](const std::string& fault) { faults += (faults.empty() ? "" : ", ") + fault; };
    const std::vector<bool>& holds = verdict(piece).holds;
    for (std::size_t r = 0; r < holds.size(); ++r) {
        if (!holds[r]) add(piece_rules_[r].fault(piece));
    }
    const bool is_asked = is_access_limited() && (rules_.combine == Stop::any || faults.empty());
    if (is_asked && is_out_of_reach(piece)) add(out_of_reach(unreachable(piece).share, *rules_.max_unreachable));
    return faults;
}

bool StopJudge::do_few_break_rules(const Segmentation& segmentation) {
    constexpr std::size_t few = 3;
    constexpr std::size_t of = 10;
    const auto breaking = std::count_if(segmentation.pieces.begin(), segmentation.pieces.end(),
                                        [&](const Piece& piece) { return breaks_a_rule(piece); });
    return static_cast<std::size_t>(breaking) <= std::max(few, segmentation.pieces.size() / of);
}

NextPiece StopJudge::next(const Segmentation& segmentation, const std::vector<std::string>& passed_over) {
    const int cuts = static_cast<int>(segmentation.cuts.size());
    const bool has_cuts = rules_.min_cuts && cuts >= *rules_.min_cuts;
    const std::size_t count = segmentation.pieces.size();
    work_out(segmentation.pieces);
    std::vector<bool> failing(count, false);           // per piece: it breaks a rule
    std::vector<bool> only_unreachable(count, false);  // per piece: of its rules it breaks max_unreachable only
    // Per rule: some piece breaks it. The last one is max_unreachable.
    std::vector<bool> broken(piece_rules_.size() + (is_access_limited() ? 1 : 0), false);
    for (std::size_t p = 0; p < count; ++p) {
        const Piece& piece = segmentation.pieces[p];
        const std::vector<bool>& holds = verdict(piece).holds;
        for (std::size_t r = 0; r < holds.size(); ++r) {
            if (holds[r]) continue;
            failing[p] = true;
            broken[r] = true;
        }
        const bool is_asked = is_access_limited() && (rules_.combine == Stop::any || !failing[p]);
        if (!is_asked || !is_out_of_reach(piece)) continue;
        only_unreachable[p] = !failing[p];
        failing[p] = true;
        broken.back() = true;
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
    const auto rank_of = [&](std::size_t p) {
        const Piece& piece = segmentation.pieces[p];
        return std::pair(is_size_first_ && too_large_for(piece), priority_(piece));
    };
    std::stable_sort(next.waiting.begin(), next.waiting.end(),
                     [&](std::size_t a, std::size_t b) { return rank_of(a) > rank_of(b); });
    if (next.waiting.empty()) return next;
    next.piece = next.waiting.front();
    next.is_trial = only_unreachable[*next.piece] && (!rules_.min_cuts || has_cuts);
    if (any_piece) {
        const auto missing = static_cast<std::size_t>(std::max(rules_.min_cuts.value_or(0) - cuts, 1));
        next.waiting.resize(std::min(next.waiting.size(), missing));
    }
    return next;
}

}  // namespace qchopper
