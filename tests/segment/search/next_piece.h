// The next piece to cut, by a StopJudge that is asked once.

#pragma once

#include <string>
#include <vector>

#include "segment/mesh/oriented_box.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

inline NextPiece next_piece(const Segmentation& segmentation, const StopRules& rules, const PieceChecks& checks,
                            const std::vector<std::string>& passed_over) {
    const auto size = [](const Piece& p) { return oriented_box(p.mesh->points).size(); };
    return StopJudge(rules, checks, size).next(segmentation, passed_over);
}

}  // namespace qchopper
