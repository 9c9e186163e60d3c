// One pass over the pieces; a volume is that of the closed mesh (segment/mesh/measure.h).

#include "app/engine/discard_request.h"

#include <algorithm>

#include "app/store/replay.h"
#include "base/text.h"
#include "segment/mesh/measure.h"

namespace qchopper {
std::vector<std::string> pieces_meant(const DiscardRequest& request, const Segmentation& segmentation) {
    for (const std::string& name : request.pieces) index_of_piece(segmentation, name);
    std::vector<std::string> meant;
    for (const Piece& p : segmentation.pieces) {
        const bool is_named = std::find(request.pieces.begin(), request.pieces.end(), p.name) != request.pieces.end();
        const bool is_small = request.below_mm3 && volume_mm3(*p.mesh) < *request.below_mm3;
        if (is_named || is_small) meant.push_back(p.name);
    }
    return meant;
}

std::string none_is_below(const DiscardRequest& request) {
    return "No piece is smaller than " + describe_volume(request.below_mm3.value_or(0)) + ". Nothing was discarded.";
}

std::string nothing_would_be_left() {
    return "No other piece would be left. Nothing was discarded.";
}

}  // namespace qchopper
