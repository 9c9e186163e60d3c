// Chooses the few directions along which a piece is milled, on samples: greedy covering with exchanges.
//
// mm2, for a tool of radius zero. The first direction is always the base's up. Greedy set cover by uncovered area is
// that of Mahdavi-Amiri et al., "VDAC: volume decompose-and-carve for subtractive manufacturing" (2020). After each
// addition every direction but up, in turn, gives way to that with which all reach most, if this is more. So neither an
// exchange nor a larger max_directions makes the unreachable area larger. Area is that of samples and of caps that
// count on the base; both are reached along directions that they face by at least min_facing, as by height fields. The
// same for any number of threads (tests/segment/access/chosen_directions_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/access/unreachable.h"

namespace qchopper {

struct DirectionOptions {
    std::size_t max_directions = 8;  // at least 1
    double min_gain = 0.005;         // a further direction adds at least this share of the surface, and not 0
};

enum class SampleAccess : std::uint8_t { reached, steep, hidden };

struct ChosenDirection {
    Vec3 direction;         // unit, from the tip into the spindle
    double gained_mm2 = 0;  // area that it reaches and none before it does; steep and hidden surface alike
};

struct ChosenDirections {
    // The base's up first, then always that of the others which adds most. All but up add something; after an exchange
    // that may be less than min_gain.
    std::vector<ChosenDirection> chosen;
    std::vector<SampleAccess> samples;  // per row of the piece, with the chosen directions
    UnreachableArea by_chosen;          // with the chosen directions; the surface less all gains
    // With up, all that are possible, and the dense ones; steep is surface that is so to up or to a possible one.
    UnreachableArea by_all;
    // Of the dense directions that are possible the one that reaches most of what no chosen one reaches, if it gains
    // at least min_gain of the surface.
    std::optional<ChosenDirection> further;
};

// `possible` are indices of the scan's directions, ascending: those within the largest tilt that can be held, with or
// without up; if empty, up alone is chosen. `dense` are further unit vectors within the tilt that can be held; rays
// along them are cast only for samples that no chosen direction reaches. Samples that no direction of `possible`
// reaches but one of `dense` does count as reached in by_all. Ties are decided by the lower index. Precondition:
// max_directions >= 1. O(samples x possible x (1 + chosen^2 / 64)); in bits of memory samples x
// (possible + unreached share x dense).
ChosenDirections choose_directions(const JudgedPiece& piece, const TiltBase& base,
                                   std::span<const std::uint32_t> possible, std::span<const Vec3> dense,
                                   const DirectionOptions& options = {});

}  // namespace qchopper
