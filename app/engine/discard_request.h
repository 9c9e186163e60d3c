// Which pieces an operator wants to leave out: named, or smaller than a volume (tests/app/engine/discard_test.cpp).

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "segment/search/segmentation.h"

namespace qchopper {

struct DiscardRequest {
    std::vector<std::string> pieces;  // names
    std::optional<double> below_mm3;  // pieces of less volume too
};

// The names of the pieces that are meant, in the order of the segmentation. Throws InputError (use) for a name that no
// piece has. O(faces).
std::vector<std::string> pieces_meant(const DiscardRequest& request, const Segmentation& segmentation);

// Why nothing was discarded: no piece is meant, or all are.
std::string none_is_below(const DiscardRequest& request);
std::string nothing_would_be_left();

}  // namespace qchopper
