// The answer of segment: lines and tables for people, one JSON document for programs. Lengths in mm.

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/engine/decide.h"
#include "app/report/document.h"

namespace qchopper {

// The discarded pieces, with the same keys in every report: [ { name, after, cut, faces, volume_mm3 } ... ], where
// `after` is the number of cuts before and `cut` the one that made the piece, 0 for the scan.
nlohmann::ordered_json discarded_json(const Project& project);

// The notes only, if no project was made.
std::vector<std::string> lines(const SegmentAnswer& answer);
// The document qchopper-segment-3 (tests/app/cli/segment_test.cpp).
Document document(const SegmentAnswer& answer);

}  // namespace qchopper
