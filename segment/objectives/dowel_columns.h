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
#include "segment/raster/solid_lines.h"

namespace qchopper {

// The lines in plane coordinates (plane_frame.h) about `origin`: (column, row) of the map is line (i, j), which stands
// at (i, j) x spacing, less the first ones. Heights along the normal.
struct SolidColumns {
    std::int32_t first_i = 0;
    std::int32_t first_j = 0;
    SolidLines map;
};

// Precondition: a closed mesh. O(points + triangles + crossings of lines and triangles).
SolidColumns solid_columns(const TriangleMesh& mesh, Vec3 normal, Vec3 origin, double spacing);

struct DowelSite {
    std::int32_t i = 0;
    std::int32_t j = 0;
    SolidSpan offsets;  // of the planes across which a dowel fits
};

// Row by row, ascending in i and in offsets.
std::vector<DowelSite> dowel_sites(const SolidColumns& columns, const ConnectorOptions& dowel);

}  // namespace qchopper
