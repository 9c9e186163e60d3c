// When a segmentation is finished (Nicholson 2016, section 4.3; fits_cell and max_cuts are ours).

#pragma once

#include <cstddef>
#include <functional>
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

// Does a piece, as it would be carved, pass the cell's check? Answered by a room that knows cells.
using FitsCell = std::function<bool(const Piece&)>;

// Is the segmentation finished, and if not, which piece is cut next: among those that do not satisfy the rules the one
// with most faces, ties to the earlier name. `passed_over` are pieces for which no candidate was found.
struct NextPiece {
    bool is_finished = false;
    std::optional<std::size_t> piece;  // index; nothing and not finished: no piece is left to try
};
NextPiece next_piece(const Segmentation& segmentation, const StopRules& rules, const FitsCell& fits_cell,
                     const std::vector<std::string>& passed_over);

// Does a box fit in another in some order of its axes?
bool fits_in(Vec3 size, Vec3 room);

}  // namespace qchopper
