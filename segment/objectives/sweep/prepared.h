// Prepares a piece for the sweep: all that does not depend on the normal, computed once and shared by all normals.
//
// Lengths in mm. O(points + triangles * (1 + half-spaces)); memory in prepared.cpp.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/cut/piece.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/shells.h"
#include "segment/objectives/objectives.h"
#include "segment/objectives/old_joints.h"
#include "segment/objectives/sweep/clusters.h"
#include "segment/structure/section_stress.h"

namespace qchopper {

constexpr std::uint16_t no_base = 0xFFFF;

// Sums for one half-space of the piece as the base: the weighted normals projected on its up direction, upward and
// downward ones apart, by area (mm2) or by count; and the faces of its cap.
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

// The axes of the piece's oriented box, and the box of each cluster along them.
struct PreparedSizes {
    std::array<Vec3, 3> axis;
    std::vector<std::array<double, 6>> of_cluster;  // least coordinates, then largest ones; empty: not needed
};

// A point of a cap, with the outward normal of the cap.
struct CapPoint {
    std::uint32_t point = 0;
    Vec3 outward;
};

struct PreparedPiece {
    const Piece* piece = nullptr;  // not owned: must outlive this
    Vec3 origin;                   // of the cones: the first point
    Edges edges;
    Shells shells;
    std::vector<TriangleSums> sums;  // per triangle
    std::vector<Vec3> unit;          // per triangle, unit normals; only if undercut counts triangles
    Clusters clusters;
    std::vector<BaseSums> base_sums;   // per cluster, and in it per half-space of the piece
    std::vector<Vec3> up;              // per half-space of the piece, HalfSpace::up()
    std::vector<std::uint16_t> base;   // per triangle: the half-space that it is a cap of, or no_base; empty: no caps
    std::vector<Vec3> vertex_normals;  // only for the thesis' fragility and the binary one
    std::vector<CapPoint> cap_points;  // only for the binary one
    PreparedSizes sizes;               // only if sizes are needed
    std::vector<OldJoint> old_joints;  // only for connector in the form `spread`
    bool has_seam = false;             // whether lengths of outlines are
    std::optional<StressedPart> stressed;  // only if structure has a weight and the piece has stress
    // The vector that undercut projects on a direction: the area vector, or the unit normal if triangles are counted.
    Vec3 weighted_normal(std::size_t triangle) const { return unit.empty() ? sums[triangle].area : unit[triangle]; }
};

// Adds a triangle to the sums of every half-space: `share` of its area, counted as `faces` triangles. `sums`: one per
// half-space.
void add_to_bases(std::span<BaseSums> sums, const PreparedPiece& prepared, std::uint32_t triangle, double share,
                  double faces);

// Preconditions: the mesh is consistent (triangle_mesh.h), the piece has fewer than no_base half-spaces. An open mesh
// is prepared too, but must not be swept (edges.faults). `axes`: of the piece's oriented box; null: it is found if it
// is needed.
PreparedPiece prepare(const Piece& piece, const Objectives& objectives, const std::array<Vec3, 3>* axes = nullptr);

}  // namespace qchopper
