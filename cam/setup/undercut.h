// Measures how much of a piece a tool from straight above cannot reach, when one of its caps lies on the table.
//
// Undercut u(phi): Nicholson, "QChopper", 2016, section 4.2.4, the base left out: with it the share is one half for
// every closed surface. In [0, 1/2) on a closed piece with a base (tests/cam/setup/undercut_test.cpp). `base` is the
// number of the cut whose cap lies on the table, `up` a unit vector.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/mesh/rays.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Projected areas along `up`, in mm2.
struct Facing {
    double up = 0;    // of what faces up, base left out
    double down = 0;  // of what faces down, base left out
    double base = 0;  // of the base, signed: positive when it faces down
    std::size_t base_triangles = 0;
    // Share of what faces down; 1/2 where nothing faces up or down.
    double undercut() const { return up + down > 0 ? down / (up + down) : 0.5; }
};
// Precondition: the mesh is consistent, and `up` is not zero.
Facing facing(const TriangleMesh& mesh, Vec3 up, std::optional<std::int32_t> base);

// Share of the area, base left out, of the triangles that face down or have a part of the piece straight above their
// middle. A vertical wall does not face down: the side of the tool cuts it. `rays` is the tree of `mesh`.
double occluded_area_ratio(const TriangleMesh& mesh, const RayTree& rays, Vec3 up, std::optional<std::int32_t> base);

// Triangles that stand for equal shares of the area, in ascending order: those that lie at `count` equal steps through
// the areas in the order of the triangles. Large ones are there several times. Precondition: count > 0.
std::vector<std::uint32_t> area_sample(const TriangleMesh& mesh, std::size_t count);

// Estimates occluded_area_ratio without a base as the share of the sample that is occluded. With n triangles its
// standard error is at most 1/(2 sqrt(n)). The sample is not empty.
double occluded_area_ratio(const TriangleMesh& mesh, const RayTree& rays, Vec3 up,
                           std::span<const std::uint32_t> sample);

}  // namespace qchopper
