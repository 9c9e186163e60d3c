// Which caps of a piece can be faces of its block, as it lies on a base, and how it is turned so that most of them are.
//
// mm, setup coordinates. A piece is the scan within half-spaces, so no part of it lies beyond the plane of a cap, and a
// block can end there. Only caps count, never flat skin, and distances decide, not angles: all points of a cap must lie
// within a tolerance of a side or the top of the piece's box (tests/cam/setup/flush_caps_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cam/setup/setup.h"
#include "segment/mesh/polygon.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The cap of one cut, with the corners of its triangles, in piece coordinates.
struct CapPoints {
    std::int32_t cut = 0;
    double area_mm2 = 0;
    std::vector<Vec3> points;
};

// By cut. O(triangles).
std::vector<CapPoints> caps_with_points(const TriangleMesh& mesh);

// The caps but the base that are faces of a block that ends where the piece's box does. `box` is that of the piece in
// the pose. By cut. O(points of the caps).
std::vector<FlushCap> flush_caps(std::span<const CapPoints> caps, const Pose& piece_in_setup, const Box& box,
                                 std::optional<std::int32_t> base, double tolerance);

// By BlockFace.
std::array<double, block_faces> area_at_faces(std::span<const FlushCap> caps);

// Turns about `up` that are worth trying, as unit vectors in frame_under(up) along which x is laid: those that lay a
// cap of at least 4 cm2 along an axis, and the smallest rectangle, each with the long side of the piece along x; that
// first whose block has the least volume, where area of caps that are not flush counts foam_per_milled_cap. Without a
// base or without caps only the smallest rectangle. Precondition: there are points. O(points log points + turns x (hull
// + points of the caps)).
std::vector<Point2> turns_to_try(std::span<const CapPoints> caps, std::span<const Vec3> piece, Vec3 up,
                                 std::optional<std::int32_t> base, const Margins& margins, double tolerance);

}  // namespace qchopper
