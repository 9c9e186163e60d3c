// Points spread evenly over surfaces, each standing for the same area.
//
// mm. Stratified by area along the order of the triangles, from a fixed seed: the same meshes give the same samples, on
// every platform (tests/segment/access/surface_samples_test.cpp). Turk, "Generating random points in triangles" (1990).

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct SurfaceSample {
    Vec3 point;
    Vec3 normal;                 // unit: the outward normal of the triangle
    std::uint32_t mesh = 0;      // index of the surface
    std::uint32_t triangle = 0;  // of that mesh
};

struct SurfaceSamples {
    std::vector<SurfaceSample> sample;  // in the order of the surfaces and their triangles
    double area_each_mm2 = 0;           // the area that one sample stands for
};

struct SampledSurface {
    const TriangleMesh* mesh = nullptr;  // not null
    std::vector<bool> is_left_out;       // one per triangle, or empty: none is left out
};

constexpr std::size_t default_surface_samples = 20'000;

// Divides the area of all triangles that are not left out into `count` shares of equal size, and takes one random point
// of each. Triangles without area carry no sample. No sample at all if there is no area. Precondition: count > 0.
// O(triangles + count).
SurfaceSamples surface_samples(std::span<const SampledSurface> surfaces, std::size_t count = default_surface_samples);

}  // namespace qchopper
