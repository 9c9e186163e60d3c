// A surface that is curved everywhere, with thousands of faces and made at once: for tests of what reduces meshes.

#pragma once

#include <cmath>

#include "tests/shapes.h"

namespace qchopper {

// 2 n^2 faces, 180 mm wide; closed, and it does not run through itself.
inline TriangleMesh bumpy_torus(int n) {
    TriangleMesh mesh = shapes::torus({3, -2, 1}, 60, 25, n);
    for (Vec3& p : mesh.points) {
        p = p + Vec3{2 * std::sin(p.y / 5), 2 * std::sin(p.z / 4 + 1), 3 * std::sin(p.x / 6)};
    }
    return mesh;
}

}  // namespace qchopper
