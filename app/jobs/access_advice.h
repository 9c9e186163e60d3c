// Why surface of a piece stays out of reach of its setup, and what would help.
//
// Shares are of the piece's area without its base. Tests: tests/app/jobs/access_advice_test.cpp.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/sentence.h"
#include "cam/cell/cell.h"
#include "cam/setup/surface_access.h"
#include "segment/cut/piece.h"

namespace qchopper {

enum class AccessFault {
    holder,            // in sight, but holder or spindle would touch something
    few_orientations,  // reached with all directions that can be held, not with the chosen ones
    tilt,              // hidden or steep from all directions within the largest tilt
    narrow,            // the smallest tool does not fit; only where that counts
    inside             // no direction of the whole sphere reaches it
};

const char* to_word(AccessFault fault);  // "holder", "few_orientations", "tilt", "narrow", "inside"

struct AccessAdvice {
    AccessFault fault = AccessFault::tilt;
    double share = 0;   // of the surface
    std::string what;   // "because of the holder"
    Sentence remedies;  // "a longer tool than ball-20, which reaches 150 mm, or a slimmer holder"
};

struct AdviceInput {
    SurfaceAccess access;            // of the setup that is taken
    double inside_share = 0;         // of inside_share()
    double tilt_deg = 60;            // the largest of the cell
    std::size_t max_directions = 8;  // that were allowed
    bool is_limited = false;  // by a decision on this piece: the operator's, or because the arm does not follow more
    std::string folder;       // of the project
    std::string piece;
};

// One for each kind of which there is at least 0.1 %, the largest share first. The shares of kinds but the holder are
// the setup's less what samples see of the others, so that all together are at most what is out of reach.
std::vector<AccessAdvice> access_advice(const AdviceInput& input, const Cell& cell);

// The share of a piece's samples that are open along none of the 264 directions of the sphere; with samples of its own
// where it has none.
double inside_share(const Piece& piece);

}  // namespace qchopper
