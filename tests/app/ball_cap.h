// A small piece that can be carved whole in the ready KUKA cells: the cap of a ball, pressed to an ellipse of 62 mm by
// 50 mm, 15 mm tall, on a flat base. Its slopes are gentle, so that a tilting tool reaches all of it, and no turn of it
// is the same piece.

#pragma once

#include "segment/cut/cut_piece.h"
#include "segment/search/segmentation.h"
#include "tests/shapes.h"

namespace qchopper {

inline TriangleMesh ball_cap() {
    constexpr double radius = 40;
    constexpr double tall = 15;
    constexpr int rings = 32;
    const Piece ball = uncut(shapes::ball({0, 0, 0}, radius, rings), 0).pieces.front();
    TriangleMesh cap = *cut_piece(ball, {{0, 0, 1}, radius - tall}, 1)->pieces.front().mesh;
    cap.cap_of.clear();
    for (Vec3& point : cap.points) point.y *= 0.8 + 0.001 * point.x;
    return cap;
}

}  // namespace qchopper
