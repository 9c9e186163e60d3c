// Fits a smooth surface around a point of a mesh, robust against narrow grooves.
//
// Lengths are mm. Fits to samples of the mesh at a given spacing, on the same side of a wall, so that the cost of a fit
// does not grow with the density of the scan (tests/segment/repair/pen_grooves/pen_grooves_test.cpp).

#pragma once

#include <cstdint>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct SurfaceFit {
    bool is_good = false;  // enough samples on all sides; else depth and roughness are 0
    double depth = 0;      // of the point below the fitted surface, along the normal; negative: above
    double roughness = 0;  // root mean square distance from the fitted surface of the samples above it
    Vec3 normal;           // unit; the mean normal of the samples; zero where the point has no normal
};

class SurfaceFitter {
 public:
    // `reach`: radius around a point; `spacing`: of the samples; both above 0. The mesh must outlive the fitter and
    // keep its points.
    SurfaceFitter(const TriangleMesh& mesh, double reach, double spacing);

    // Fits at a point of the mesh. Samples below the surface have less weight the deeper they lie; those whose flag is
    // set in `left_out` (one per point) have none. May be called from several threads at once.
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
    std::vector<Vec3> normals_;    // one per point
    std::vector<Sample> samples_;  // ordered by cells as large as the reach
};

}  // namespace qchopper
