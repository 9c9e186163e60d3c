// What the sweep needs to know of a piece whatever the normal: made once per piece, shared by all its normals.

#pragma once

#include <cstdint>
#include <vector>

#include "segment/cut/piece.h"
#include "segment/mesh/edges.h"
#include "segment/mesh/shells.h"
#include "segment/score/objectives.h"

namespace qchopper {

// The area vector of a triangle (mm2), and the volume of the cone from `origin` to it (mm3).
struct TriangleSums {
    Vec3 area;
    double volume = 0;
};

constexpr std::uint16_t no_base = 0xFFFF;

struct PreparedPiece {
    const Piece* piece = nullptr;  // stays the caller's
    Vec3 origin;                   // of the cones: the first point
    Edges edges;
    Shells shells;
    std::vector<std::uint32_t> neighbour;  // per point: the nearest in memory of its earlier neighbours, or itself
    std::vector<TriangleSums> sums;
    std::vector<Vec3> unit;            // per triangle, unit normals; only if undercut counts triangles
    std::vector<Vec3> up;              // per bound of the piece, Bound::up()
    std::vector<std::uint16_t> base;   // per triangle: index in piece->bounds of its cap, or no_base; empty: no caps
    std::vector<Vec3> vertex_normals;  // only for the thesis' fragility
};

PreparedPiece prepare(const Piece& piece, const Objectives& objectives);

}  // namespace qchopper
