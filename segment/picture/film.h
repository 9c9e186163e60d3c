// What is seen at every sample of a picture, by rasterising the triangles with a depth buffer.
//
// Samples lie supersampling times finer than pixels, at the middles of their squares. Of several surfaces the nearest
// to the camera is seen; of equally near ones the triangle with the least number, whatever the number of threads
// (tests/segment/picture/film_test.cpp: the same depths as by casting a ray through every sample).

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "segment/picture/camera.h"

namespace qchopper {

struct Film {
    static constexpr std::uint64_t nothing = std::numeric_limits<std::uint64_t>::max();

    std::size_t width = 0;  // samples
    std::size_t height = 0;
    double mm_per_sample = 1;
    // Row by row from the top: the bits of the depth from the camera's origin (mm, a float, positive) above, the number
    // of the triangle below, counted through all meshes in their order.
    std::vector<std::uint64_t> seen;

    std::uint64_t at(std::size_t x, std::size_t y) const { return seen[y * width + x]; }
    static std::uint32_t triangle(std::uint64_t sample) { return static_cast<std::uint32_t>(sample); }
    static float depth(std::uint64_t sample);
    // The point of the view plane through the camera's origin from which the sample looks.
    Vec3 start(const Camera& camera, std::size_t x, std::size_t y) const;
};

// Precondition: the camera frames the meshes, which have fewer than 2^32 - 1 triangles together.
Film rasterised(std::span<const ColouredMesh> meshes, const Camera& camera, const PictureOptions& options);

}  // namespace qchopper
