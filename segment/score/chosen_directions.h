// Chooses the few directions along which a piece is carved, on samples: greedy covering, then exchanges.
//
// mm2, for a tool of radius zero. The first direction is always the base's up. Greedy set cover by uncovered area is
// that of Mahdavi-Amiri et al., "VDAC: volume decompose-and-carve for subtractive manufacturing" (2020). More
// directions never make the unreachable area larger; nor does the exchange (tests/segment/score/
// chosen_directions_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/score/unreachable.h"

namespace qchopper {

struct DirectionOptions {
    std::size_t max_directions = 8;  // at least 1
    double least_gain = 0.005;       // a further direction reaches at least this share of the area without base
};

enum class SampleReach : std::uint8_t { reached, steep, hidden };

struct ChosenDirection {
    Vec3 direction;         // unit: the way the tool comes out
    double gained_mm2 = 0;  // area that it reaches and none before it does; steep and hidden surface alike
};

struct ChosenDirections {
    std::vector<ChosenDirection> chosen;  // the base's up first, then in the order of their gains
    std::vector<SampleReach> samples;     // per row of the piece, with the chosen directions
    UnreachableArea by_chosen;            // with the chosen directions
    UnreachableArea by_all;               // with all that are possible, and the dense ones
    // Of the dense directions that are possible the one that reaches most of what no chosen one reaches, if it gains
    // at least least_gain of the area without base.
    std::optional<ChosenDirection> further;
};

// `possible` are indices of the scan's directions, ascending: those within the largest tilt that can be held. `dense`
// are further unit vectors within the tilt that can be held; rays along them are cast only for samples that no chosen
// direction reaches. Samples that no direction of `possible` reaches but one of `dense` does count as reached in
// by_all. Ties are decided by the lower index. O(samples x possible x chosen).
ChosenDirections choose_directions(const JudgedPiece& piece, const TiltBase& base,
                                   std::span<const std::uint32_t> possible, std::span<const Vec3> dense,
                                   const DirectionOptions& options = {});

}  // namespace qchopper
