// What it costs to cut a model under load: the tension and shear on the sections of planes, by the strength.
//
// mm, MPa. The sections C of a plane are the sets of voxels that it crosses and that are joined by faces. Its value is
// the sum over C of (1/A_C) * the integral over C of (alpha_t max(n.S n, 0) + alpha_s |S n - (n.S n) n|) / strength
// (L. Luo, I. Baran, S. Rusinkiewicz, W. Matusik, "Chopper: partitioning models into 3D-printable parts", 2012, section
// 3; alpha_t = alpha_s = 1). Held to polygons of plane and cube by tests/segment/structure/section_stress_test.cpp.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "segment/structure/stress.h"

namespace qchopper {

struct SectionStress {
    double value = 0;              // the term of the plane
    std::uint32_t sections = 0;    // that it has
    std::uint32_t too_coarse = 0;  // of these: over half the area is under 3 voxels thick (thick_voxels)
    double area_mm2 = 0;
    bool operator==(const SectionStress&) const = default;
};

// A part of a stressed model whose sections are asked for.
struct StressedPart {
    std::shared_ptr<const StressedModel> model;  // not null
    std::vector<std::uint32_t> voxels;           // positions in the model's list, ascending
    std::vector<VoxelNeighbours> neighbours;     // per voxel of the part: positions in the part's list, or no_voxel
};

// The voxels of the model whose centres lie inside a closed mesh. Those of the pieces of a cut are the piece's, but for
// centres on the plane. O(triangles + voxels log voxels).
StressedPart stressed_part(std::shared_ptr<const StressedModel> model, const TriangleMesh& mesh);

// One result per offset, ascending. Precondition: the normal is a unit vector. One pass over the voxels;
// O(voxels + crossings of voxels and planes).
std::vector<SectionStress> section_stress(const StressedPart& part, Vec3 normal, std::span<const double> offsets);

}  // namespace qchopper
