// Where a dowel fits into two pieces that touch.
//
// mm. A hole is clear if every point of its axis, from the cap to its depth, is at least radius + wall from the piece's
// surface other than its caps on that plane: the exact distance from the axis to the triangles, so also around its end
// and between any rays. Sites lie on a square grid over the contact (tests/segment/joint/piece_joints_test.cpp).

#pragma once

#include <span>
#include <vector>

#include "segment/joint/axis_distance.h"
#include "segment/joint/dowel.h"
#include "segment/joint/flat_region.h"
#include "segment/mesh/triangle_tree.h"

namespace qchopper {

// A piece with what finds its triangles near an axis. The piece's mesh outlives it.
class PieceSurface {
 public:
    explicit PieceSurface(const Piece& piece) : mesh_(*piece.mesh), tree_(mesh_) {}
    // Whether the surface without the caps of this cut keeps the distance from the axis. O(triangles near it).
    bool is_clear(const Axis& axis, double distance, std::int32_t cut) const;

 private:
    const TriangleMesh& mesh_;
    TriangleTree tree_;
};

// The two sides of a contact.
struct ContactSides {
    const PieceSurface& below;
    const PieceSurface& above;
    Plane plane;
    std::int32_t cut = 0;
};

// The points of a grid that lie in the contact, at most about `most` of them, row by row. The spacing follows from the
// area, so that thin walls get as many as wide faces; it is at least 1 mm. O(edges x rows they pass + points).
std::vector<Point2> grid_points(const FlatRegion& contact, std::size_t most);

// Of the points, which lie in the contact, those where a dowel of this size is clear in both pieces, in their order.
std::vector<Point2> clear_sites(const ContactSides& sides, std::span<const Point2> points, const DowelSize& size);

}  // namespace qchopper
