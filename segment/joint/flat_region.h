// Flat regions of a piece's surface as polygons: a cap, or the part of it that another piece touches.
//
// mm, in plane coordinates: frame_across(plane.normal) at the point of the plane nearest to the origin, seen against
// the normal. Loops are counter-clockwise around material (tests/segment/joint/contact_test.cpp).

#pragma once

#include <cstdint>
#include <vector>

#include "segment/cut/piece.h"
#include "segment/mesh/polygon_nesting.h"

namespace qchopper {

struct FlatRegion {
    std::vector<Point2> points;
    std::vector<Loop> loops;  // indices of points
    std::vector<CapRegion> regions;
    double area_mm2 = 0;  // of all regions
    bool empty() const { return regions.empty(); }
};

// The plane coordinates of a point, and the point of plane coordinates.
Point2 on_plane(const Plane& plane, Vec3 point);
Vec3 from_plane(const Plane& plane, Point2 point);

// Polygons of three or more corners that share corners where they share edges, and that do not overlap: triangles of a
// mesh, or what is left of them after clipping.
struct FlatPolygons {
    std::vector<Vec3> points;
    std::vector<std::vector<std::uint32_t>> polygons;
};

// The loops along which polygons have no neighbour, each turned as its polygons are. Loops that touch in a point stay
// apart: a loop turns around the polygons of its own side. O(corners log corners).
std::vector<Loop> outlines(const FlatPolygons& flat);

// The triangles of a cap of the piece; reversed if they face against the plane's normal, so that they are
// counter-clockwise. Points that they do not use are left out.
FlatPolygons cap_polygons(const Piece& piece, const HalfSpace& half_space);

// The mean of the corners of the outer loops. Precondition: the region is not empty.
Vec3 middle_of(const FlatRegion& region, const Plane& plane);

// Where two pieces on the two sides of a cut touch along its plane, without regions smaller than `min_mm2`. `below`
// and `above` bound the pieces and have the same cut. Empty if they do not touch. O(cap triangles of both).
FlatRegion contact_region(const Piece& below, const HalfSpace& of_below, const Piece& above, const HalfSpace& of_above,
                          double min_mm2);

}  // namespace qchopper
