// Counts the face and splits it by ear clipping. O(1) for a triangle; polygon.cpp states the cost of others.

#include "segment/io/formats/add_face.h"

#include "segment/io/formats/polygon.h"

namespace qchopper {

void add_face(RawMesh& scan, std::span<const std::uint32_t> corners) {
    ++scan.faces_in_file;
    if (corners.size() < 3) {
        ++scan.faces_without_area;
    } else if (corners.size() == 3) {
        scan.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    } else {
        split_polygon(scan.mesh.points, corners, scan.mesh.triangles);
    }
}

}  // namespace qchopper
