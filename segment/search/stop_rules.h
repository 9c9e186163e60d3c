// Decides whether a segmentation is finished, and which piece is cut next (Nicholson 2016, section 4.3; fits_cell and
// max_cuts are additions).
//
// Tests: tests/segment/search/stop_rules_test.cpp.

#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "segment/search/segmentation.h"

namespace qchopper {

enum class Stop { any, all };  // of the rules that are set

struct StopRules {
    std::optional<std::size_t> max_faces;  // every piece has fewer
    std::optional<int> min_cuts;           // at least so many were made
    std::optional<Vec3> max_obb;           // every piece's oriented box fits in this box (mm), in some axis order
    bool fits_cell = false;                // every piece passes the check of the cell
    Stop combine = Stop::all;
    int max_cuts = 500;  // a safety stop, whatever the rules
    bool operator==(const StopRules&) const = default;

    bool is_any_set() const { return max_faces || min_cuts || max_obb || fits_cell; }
};

struct UnreachableSurface {
    double mm2 = 0;
    double share = 0;
};

// Whether a piece, as it would be carved, passes the check of the cell. Given by a module that sees cells.
using FitsCell = std::function<bool(const Piece&)>;

// Whether the segmentation is finished, and if not, the piece that is cut next: of those that do not satisfy the rules
// the one with the most faces; of several, the earlier in the list.
struct NextPiece {
    bool is_finished = false;
    std::optional<std::size_t> piece;  // index; nothing and not finished: no piece is left, or max_cuts is reached
    std::vector<std::size_t> waiting;  // indices of those that will be cut as far as is decided now, the next one first
};

// Checks the rules and keeps the results per mesh: every piece is checked once, in any number of calls.
class StopJudge {
 public:
    // `box_size` returns the size of a piece's oriented box; called only if max_obb is set. `fits_cell` may be empty:
    // the rule of that name is then left out.
    StopJudge(StopRules rules, FitsCell fits_cell, std::function<Vec3(const Piece&)> box_size);

    // `passed_over`: names of pieces for which no candidate was found.
    NextPiece next(const Segmentation& segmentation, const std::vector<std::string>& passed_over);

 private:
    struct Verdict {
        std::weak_ptr<const TriangleMesh> mesh;  // expired: the address may be that of another mesh
        std::vector<bool> holds;                 // per rule
    };
    const std::vector<bool>& verdict(const Piece& piece);

    StopRules rules_;
    std::vector<std::function<bool(const Piece&)>> piece_rules_;  // the rules on single pieces
    std::map<const TriangleMesh*, Verdict> verdicts_;
};

// The same for a single call.
NextPiece next_piece(const Segmentation& segmentation, const StopRules& rules, const FitsCell& fits_cell,
                     const std::vector<std::string>& passed_over);

// Whether a box of one size fits in a box of another, in some order of its axes.
bool fits_in(Vec3 size, Vec3 limit);

}  // namespace qchopper
