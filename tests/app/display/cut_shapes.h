// Shapes, whole and really cut, for the tests of this folder.

#pragma once

#include <vector>

#include "segment/cut/cut.h"
#include "segment/mesh/measure.h"
#include "tests/bumpy_torus.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {

inline std::vector<shapes::Named> awkward_shapes() {
    std::vector<shapes::Named> all = shapes::all_closed();
    all.push_back({"bumpy torus", bumpy_torus(40)});
    return all;
}

// The whole mesh cut by a skew plane near its middle: above, below.
inline std::vector<TriangleMesh> halves_of(const TriangleMesh& mesh, std::int32_t number, Vec3 normal) {
    const Plane plane = canonical({normalized(normal), dot(normalized(normal), bounds(mesh).centre()) + 0.01317});
    const std::optional<CutHalves> halves = cut(mesh, plane, number);
    if (!halves) return {mesh};
    return {halves->above.mesh, halves->below.mesh};
}

// Four parts of a mesh with caps of the cuts 1 to 3, as far as the planes meet it.
inline std::vector<TriangleMesh> parts_of(const TriangleMesh& mesh) {
    std::vector<TriangleMesh> parts;
    std::int32_t number = 2;
    for (const TriangleMesh& half : halves_of(mesh, 1, {0.61, 0.31, 0.83})) {
        for (TriangleMesh& part : halves_of(half, number, {0.83, -0.47, 0.23})) parts.push_back(std::move(part));
        ++number;
    }
    return parts;
}

}  // namespace qchopper
