// The joints of older cuts of a piece, and what a new plane takes from them.
//
// mm. A joint is what the piece owns of the cap of an earlier cut. A dowel stands in it where the piece is solid over
// depth + wall behind the cap, along every line of a grid within diameter / 2 + wall of the axis; a new plane nearer to
// the axis than that takes the place away. The plane parts the joint into that of the side above and that of the side
// below, whatever solids these are; across the cap the neighbours count as one. Equal to cutting
// (tests/segment/objectives/old_joints_test.cpp).

#pragma once

#include <array>
#include <span>
#include <vector>

#include "segment/cut/piece.h"
#include "segment/objectives/joint_measure.h"

namespace qchopper {

struct OldJoint {
    struct Place {
        Point2 flat;  // on the cap
        Vec3 point;
    };
    struct Corner {
        Point2 flat;
        Vec3 point;
    };
    std::vector<std::array<Corner, 3>> triangles;  // of the cap
    std::vector<Place> places;                     // row by row
};

// Of every half-space of which the piece owns a cap. O(points + triangles) for each.
std::vector<OldJoint> old_joints(const Piece& piece, const ConnectorOptions& options);

// Per offset, ascending, the two sides of the joint: above, then below. O(triangles of the cap that the planes cross +
// offsets x rows of places).
std::vector<std::array<JointMeasure, 2>> parted(const OldJoint& joint, Vec3 normal, std::span<const double> offsets,
                                                const ConnectorOptions& options);

}  // namespace qchopper
