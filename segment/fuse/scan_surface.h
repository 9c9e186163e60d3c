// The surface of one range scan: a mesh, open at its borders, and how well each of its points was seen.
//
// In the unit and the frame of the scan until it is moved. A grid becomes triangles as G. Turk and M. Levoy, "Zippered
// polygon meshes from range images" (1994), section 2, have it: of four neighbours the two triangles with the shorter
// diagonal, of three one triangle, and none with an edge longer than a threshold, which would bridge a step in depth
// (tests/segment/fuse/range_scan_test.cpp). O(points).

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "segment/io/read_range_scan.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct ScanSurface {
    std::string name;
    TriangleMesh mesh;
    std::vector<Vec3> normals;   // one per point, unit or zero
    std::vector<float> weights;  // one per point, 0 to 1: less at borders, and where the scanner saw it at a slant
    std::vector<std::uint8_t> border;  // one per point: 1 if it is at an edge with one triangle
    std::vector<std::uint8_t> open;    // one per triangle: bit k is set if its edge from corner k on has no other one
};

// The median distance of neighbours in the grid; 0 if there are none.
double grid_spacing(const RangeScan& scan);

// Faces look towards the scanner, which is on the side of +z in the frame of a scan.
TriangleMesh triangulate(const RangeScan& scan, double longest_edge);

// Of a mesh that was made of a grid (`is_grid`) the angle between its normals and z counts in the weights; of another
// one nobody knows from where it was seen. Precondition: the mesh is consistent.
ScanSurface scan_surface(std::string name, TriangleMesh mesh, bool is_grid);

}  // namespace qchopper
