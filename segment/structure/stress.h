// The stress in a whole model that stands upright under a load, voxel by voxel, and what the analysis leaves open.
//
// mm, N, MPa. Linear elasticity of one material: its modulus cancels, because nothing is moved by a given amount.
// Voxels are bricks (brick.h) joined by faces only. A solid stands if its lowest voxel is within the lowest 5 % of the
// model's height; it is held at its exterior nodes within the lowest 5 % of its own height (after L. Luo, I. Baran,
// S. Rusinkiewicz, W. Matusik, "Chopper: partitioning models into 3D-printable parts", 2012, section 3). The others
// float: they are reported and have no stress (tests/segment/structure/stress_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/context.h"
#include "segment/structure/voxels.h"

namespace qchopper {

struct StructureOptions {
    Vec3 up;                       // the upright direction, against gravity; not zero
    double density_kg_per_m3 = 0;  // above 0
    double strength_mpa = 0;       // above 0
    bool has_own_weight = true;
    double force_n = 0;          // downwards, spread over the exterior nodes of the highest 5 % of the largest solid
    double poisson_ratio = 0.3;  // 0 <= it < 0.5
    double voxel_mm = 0;         // side of a voxel; 0: the least with at most `unknowns` unknowns
    std::size_t unknowns = 300'000;
    bool operator==(const StructureOptions&) const = default;
};

// Along the axes of the mesh.
struct Stress {
    double xx = 0;
    double yy = 0;
    double zz = 0;
    double xy = 0;
    double yz = 0;
    double zx = 0;
    bool operator==(const Stress&) const = default;
};

// The stress on a plane with this normal, in MPa.
inline Vec3 traction(const Stress& s, Vec3 n) {
    return {s.xx * n.x + s.xy * n.y + s.zx * n.z, s.xy * n.x + s.yy * n.y + s.yz * n.z,
            s.zx * n.x + s.yz * n.y + s.zz * n.z};
}

struct FloatingSolid {
    std::size_t voxels = 0;
    Vec3 centre;             // the mean of its voxels
    bool is_hinged = false;  // it meets what stands by an edge or a corner of voxels
    bool operator==(const FloatingSolid&) const = default;
};

struct StructureReport {
    std::size_t unknowns = 0;
    std::size_t iterations = 0;
    double residual = 0;
    std::vector<FloatingSolid> floating;  // the largest first
    std::size_t standing_voxels = 0;
    std::size_t thin_voxels = 0;     // of those that stand: under 3 voxels thick (thick_voxels)
    std::size_t hinges = 0;          // nodes where voxels that stand meet by an edge or a corner only
    double largest_tension_mpa = 0;  // principal stress
    Vec3 largest_tension_at;         // the centre of that voxel
    bool operator==(const StructureReport&) const = default;
};

struct StressedModel {
    VoxelGrid grid;
    double strength_mpa = 0;
    std::vector<std::uint32_t> voxels;  // ascending, floating ones too
    std::vector<Stress> stress;         // per voxel, in MPa; 0 where it floats
    std::vector<std::uint8_t> is_thick;
    StructureReport report;
    bool operator==(const StressedModel&) const = default;
};

// The relative residual at which the solution is taken.
constexpr double structure_residual = 1e-6;

// Throws InputError (use) where an option is out of its range or the voxels are too many, mesh if no voxel lies inside
// or the solution does not converge; Cancelled. Precondition: the mesh is closed (edges.h).
StressedModel stress_of(const TriangleMesh& mesh, const StructureOptions& options, const Context& context);

}  // namespace qchopper
