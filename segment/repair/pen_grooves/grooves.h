// Finds grooves among the points that lie below the surface: connected sets that are long and nowhere wide.
//
// Lengths are mm (tests/segment/repair/pen_grooves/pen_grooves_test.cpp).

#pragma once

#include <cstdint>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

enum class GrooveKind : std::uint8_t {
    none,
    flank,  // belongs to a groove if it is connected to a seed
    seed
};

struct GrooveLimits {
    double max_width = 0;
    double max_depth = 0;
    double min_length = 0;
};

struct Groove {
    std::vector<std::uint32_t> points;  // ascending
    double area_mm2 = 0;
    double width = 0;   // mean
    double length = 0;  // area over width: of all branches together
    double depth = 0;   // of the deepest point
};

// The grooves within the limits, in the order of their first points. `kinds` and `depths`: one per point of the mesh.
std::vector<Groove> line_like_grooves(const TriangleMesh& mesh, const std::vector<GrooveKind>& kinds,
                                      const std::vector<double>& depths, const GrooveLimits& limits);

}  // namespace qchopper
