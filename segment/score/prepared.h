// What the sweep needs to know of a piece whatever the normal: made once per piece, shared by all its normals.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/cut/piece.h"
#include "segment/mesh/edges.h"
#include "segment/mesh/shells.h"
#include "segment/score/objectives.h"
#include "segment/score/patches.h"

namespace qchopper {

constexpr std::uint16_t no_base = 0xFFFF;

// What looks up and what looks down about one bound of the piece, by area (mm2) or by count, and the faces of its cap.
struct BaseSums {
    double up = 0;
    double down = 0;
    double faces = 0;
    void operator+=(const BaseSums& b) {
        up += b.up;
        down += b.down;
        faces += b.faces;
    }
};

struct PreparedPiece {
    const Piece* piece = nullptr;  // stays the caller's
    Vec3 origin;                   // of the cones: the first point
    Edges edges;
    Shells shells;
    std::vector<TriangleSums> sums;
    std::vector<Vec3> unit;  // per triangle, unit normals; only if undercut counts triangles
    Patches patches;
    std::vector<BaseSums> base_sums;   // per patch, and in it per bound
    std::vector<Vec3> up;              // per bound of the piece, Bound::up()
    std::vector<std::uint16_t> base;   // per triangle: index in piece->bounds of its cap, or no_base; empty: no caps
    std::vector<Vec3> vertex_normals;  // only for the thesis' fragility
    // What undercut multiplies with a direction: the area vector, or the unit normal if triangles are counted.
    Vec3 look(std::size_t triangle) const { return unit.empty() ? sums[triangle].area : unit[triangle]; }
};

// Adds a triangle to the sums of every bound: `share` of its area, counted as `faces` triangles.
void add_to_bases(std::span<BaseSums> sums, const PreparedPiece& prepared, std::uint32_t triangle, double share,
                  double faces);

PreparedPiece prepare(const Piece& piece, const Objectives& objectives);

}  // namespace qchopper
