// Where dowels fit across all planes of one normal: one set of parallel lines through the piece answers for every
// offset.
//
// mm. A site is a point of a square grid across the normal. A dowel fits there at an offset if the piece is solid over
// depth + wall on both sides of the plane, along every line of the grid within diameter / 2 + wall of the axis. This is
// the objective's definition; placed holes are judged exactly (segment/joint/dowel_sites.h). Held to lines that are
// intersected one by one by tests/segment/objectives/sweep/connector_test.cpp.

#pragma once

#include <cstdint>
#include <vector>

#include "segment/mesh/triangle_mesh.h"
#include "segment/objectives/objectives.h"

namespace qchopper {

struct HeightRange {
    double low = 0;
    double high = 0;
    bool operator==(const HeightRange&) const = default;
};

// The grid in plane coordinates (plane_frame.h) about `origin`: column (i, j) stands at (i, j) x spacing.
struct SolidColumns {
    std::int32_t first_i = 0;
    std::int32_t first_j = 0;
    std::int32_t count_i = 0;
    std::int32_t count_j = 0;
    std::vector<std::uint32_t> first;  // per column, row by row: in `solid`; and one more
    std::vector<HeightRange> solid;    // heights along the normal between which the column is in material, ascending
    std::size_t index(std::int32_t i, std::int32_t j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(count_i) + static_cast<std::size_t>(i);
    }
};

// Precondition: a closed mesh. O(points + triangles + crossings of lines and triangles).
SolidColumns solid_columns(const TriangleMesh& mesh, Vec3 normal, Vec3 origin, double spacing);

struct DowelSite {
    std::int32_t i = 0;
    std::int32_t j = 0;
    HeightRange offsets;  // of the planes across which a dowel fits
};

// Row by row, ascending in i and in offsets.
std::vector<DowelSite> dowel_sites(const SolidColumns& columns, const ConnectorOptions& dowel);

}  // namespace qchopper
