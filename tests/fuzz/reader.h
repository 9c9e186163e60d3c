// The test of every mesh reader: any bytes give a sound mesh or an InputError.

#pragma once

#include <cmath>

#include "segment/io/read_mesh.h"
#include "tests/fuzz/demand.h"

namespace qchopper {

// Coordinates are finite, corners are indices of points, caps are none or one per triangle.
inline void demand_sound(const RawMesh& scan) {
    const TriangleMesh& mesh = scan.mesh;
    for (const Vec3& p : mesh.points) demand(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) demand(corner < mesh.points.size());
    }
    demand(mesh.cap_of.empty() || mesh.cap_of.size() == mesh.triangles.size());
}

template <class Parse>
void try_to_read(const Parse& parse) {
    or_refused(InputFault::mesh, [&] { demand_sound(parse()); });
}

}  // namespace qchopper
