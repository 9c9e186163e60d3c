// Surface through which no plane may go, and the heights along a normal that it forbids to planes.
//
// mm. Points are marked; a plane is forbidden if it crosses a triangle with a marked corner: if that has corners on
// both of its sides. Cuts keep the points of a scan bit for bit, so that its pieces are asked for the same points
// (tests/segment/search/candidates/no_cut_test.cpp).

#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "segment/cut/nudge.h"

namespace qchopper {

// The marked points of a scan, by x, then y, then z; copies share them.
struct NoCut {
    std::shared_ptr<const std::vector<Vec3>> points;  // null: none
    bool operator==(const NoCut& other) const {
        return points == other.points || (points && other.points && *points == *other.points);
    }
};

// Sorts the points; several may be equal.
NoCut no_cut_at(std::vector<Vec3> points);

// A triangle with a marked corner, by its corners.
using NoCutTriangle = std::array<Vec3, 3>;

// Those of a mesh. None if nothing is marked. O(points log marked points + triangles).
std::vector<NoCutTriangle> no_cut_triangles(const TriangleMesh& mesh, const NoCut& no_cut);

// The heights at which a plane with this normal crosses a triangle: open intervals, ascending, no two of which have a
// height in common. O(m log m) for m triangles.
std::vector<Extent> forbidden_heights(std::span<const NoCutTriangle> triangles, Vec3 normal);

// O(log intervals).
bool is_forbidden(std::span<const Extent> heights, double offset);

}  // namespace qchopper
