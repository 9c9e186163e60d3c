// Of all points that lie too deep, those that form lines: connected, long, and nowhere wide.
//
// Lengths are mm (tests/segment/repair/marks_test.cpp).

#pragma once

#include <cstdint>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

enum class DentKind : std::uint8_t {
    none,
    flank,  // belongs to a dent if it hangs together with a seed
    seed
};

struct DentLimits {
    double most_width = 0;
    double most_depth = 0;
    double least_length = 0;
};

struct Dent {
    std::vector<std::uint32_t> points;  // ascending
    double area_mm2 = 0;
    double width = 0;
    double length = 0;  // area over width: of all branches together
    double depth = 0;   // of the deepest point
};

// In the order of their first points. `kinds` and `depths`: one per point.
std::vector<Dent> line_like_dents(const TriangleMesh& mesh, const std::vector<DentKind>& kinds,
                                  const std::vector<double>& depths, const DentLimits& limits);

}  // namespace qchopper
