// Selects triangles of a mesh, with their caps and what of them is ignored, or divides a mesh into parts.
//
// Triangles keep their order. O(triangles + points), however many parts there are
// (tests/segment/mesh/submesh_test.cpp).

#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Keeps the values whose flag is set, in their order. `is_kept` has one flag per value.
template <class Value>
void keep_marked(std::vector<Value>& values, const std::vector<bool>& is_kept) {
    assert(values.size() == is_kept.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (is_kept[i]) values[kept++] = values[i];
    }
    values.resize(kept);
}

// Keeps the triangles whose flag is set. `is_kept` has one flag per triangle. All points stay.
void keep_triangles(TriangleMesh& mesh, const std::vector<bool>& is_kept);

// One mesh per group. `group_of` has one entry per triangle: its group, below `count`. A mesh has the points that its
// triangles use, in the order of their first use. Precondition: no two groups share a point.
std::vector<TriangleMesh> submeshes(const TriangleMesh& mesh, std::span<const std::uint32_t> group_of,
                                    std::size_t count);

}  // namespace qchopper
