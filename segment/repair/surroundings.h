// The surface around a point as a smooth one that narrow dents do not pull down.
//
// Lengths are mm. Looks at samples of the mesh no denser than asked for, on the same side of a wall, so that the work
// for a point does not grow with the density of the scan (tests/segment/repair/marks_test.cpp).

#pragma once

#include <cstdint>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct SurfaceFit {
    bool is_good = false;  // enough samples on all sides
    double depth = 0;      // mm below the fitted surface, along the normal; negative: above
    double roughness = 0;  // root mean square distance from it of the samples above it
    Vec3 normal;           // of the surface around
};

class Surroundings {
 public:
    // `reach`: radius around a point; `spacing`: of the samples. The mesh stays the caller's, and as it is.
    Surroundings(const TriangleMesh& mesh, double reach, double spacing);

    // Fits at a point of the mesh. Samples that lie too deep count little; those that are known to (one flag per point)
    // do not count at all. May be called from many threads at once.
    SurfaceFit fit(std::uint32_t point, const std::vector<std::uint8_t>* left_out = nullptr) const;

 private:
    struct Sample {
        std::uint64_t cell = 0;
        std::uint32_t point = 0;
    };
    template <class Visit>
    void for_each_near(Vec3 p, const Visit& visit) const;

    const TriangleMesh& mesh_;
    double reach_;
    Vec3 origin_;
    std::vector<Vec3> normals_;
    std::vector<Sample> samples_;  // by cells as large as the reach
};

}  // namespace qchopper
