// A small piece that can be carved whole in the ready KUKA cells: the cap of a ball, 62 mm wide and 15 mm tall, on a
// flat base. Gentle slopes alone, so that what a tilting tool reaches is all of it.

#pragma once

#include "segment/cut/cut_piece.h"
#include "segment/search/segmentation.h"
#include "tests/shapes.h"

namespace qchopper {

// A piece with a base: above one cut.
inline Piece ball_cap_piece() {
    constexpr double radius = 40;
    constexpr double tall = 15;
    constexpr int rings = 32;
    const Piece ball = uncut(shapes::ball({0, 0, 0}, radius, rings), 0).pieces.front();
    Piece cap = cut_piece(ball, {{0, 0, 1}, radius - tall}, 1)->pieces.front();
    cap.name = "A";
    return cap;
}

// The same as a scan.
inline TriangleMesh ball_cap() {
    return *ball_cap_piece().mesh;
}

}  // namespace qchopper
