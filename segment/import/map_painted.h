// Carries marks from a painted copy of a scan to the imported scan, whose triangles are others after its repair.
//
// Every triangle takes the mark of the place of the painted surface that is nearest to its centroid; so what fills a
// hole follows the surface around it. Where two sheets are nearer to each other than the painted surface is to the
// scan, a triangle may take the mark of the other sheet. The result does not depend on the number of threads
// (tests/segment/import/map_painted_test.cpp).

#pragma once

#include <cstdint>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// One per triangle of `scan`: 1 or 0. Both meshes are in the same frame; `painted` has triangles and TriangleMesh::
// ignored. O((triangles of both) log (triangles of painted)).
std::vector<std::uint8_t> mapped_marks(const TriangleMesh& painted, const TriangleMesh& scan);

// The points of `scan` that are marked, each as the corner nearest to it of the painted triangle that is nearest to it.
// `is_marked`: one per point of `painted`. O(points of scan x log (triangles of painted)).
std::vector<Vec3> mapped_points(const TriangleMesh& painted, const std::vector<std::uint8_t>& is_marked,
                                const TriangleMesh& scan);

// The share of the area of `painted`, 0 to 1, whose triangles have their centroid at least as far as `distance`, above
// 0, from the surface of `scan`. O((triangles of both) log (triangles of scan)).
double share_off_scan(const TriangleMesh& painted, const TriangleMesh& scan, double distance);

}  // namespace qchopper
