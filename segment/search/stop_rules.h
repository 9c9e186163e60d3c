// When a segmentation is finished (Nicholson 2016, section 4.3; fits_cell and max_cuts are ours).

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
    int max_cuts = 500;  // a safety stop, always
    bool operator==(const StopRules&) const = default;

    bool is_any_set() const { return max_faces || min_cuts || max_obb || fits_cell; }
};

// Does a piece, as it would be carved, pass the cell's check? Answered by a module that knows cells.
using FitsCell = std::function<bool(const Piece&)>;

// Is the segmentation finished, and if not, which piece is cut next: among those that do not satisfy the rules the one
// with most faces, ties to the earlier name.
struct NextPiece {
    bool is_finished = false;
    std::optional<std::size_t> piece;  // index; nothing and not finished: no piece is left to try
    std::vector<std::size_t> waiting;  // those that will be cut as far as can be seen, the next one first
};

// Looks at every piece once, however often it is asked (tests/segment/search/stop_rules_test.cpp).
class StopJudge {
 public:
    // `box_size` gives the size of a piece's oriented box; asked only if max_obb is set.
    StopJudge(StopRules rules, FitsCell fits_cell, std::function<Vec3(const Piece&)> box_size);

    // `passed_over` are pieces for which no candidate was found.
    NextPiece next(const Segmentation& segmentation, const std::vector<std::string>& passed_over);

    const StopRules& rules() const { return rules_; }

 private:
    struct Verdict {
        std::weak_ptr<const TriangleMesh> mesh;  // expired: the address may be another piece's by now
        std::vector<bool> holds;                 // per rule
    };
    const std::vector<bool>& verdict(const Piece& piece);

    StopRules rules_;
    std::vector<std::function<bool(const Piece&)>> piece_rules_;  // those that speak of single pieces
    std::map<const TriangleMesh*, Verdict> verdicts_;
};

// The same, asked once.
NextPiece next_piece(const Segmentation& segmentation, const StopRules& rules, const FitsCell& fits_cell,
                     const std::vector<std::string>& passed_over);

// Does a box fit in another in some order of its axes?
bool fits_in(Vec3 size, Vec3 room);

}  // namespace qchopper
