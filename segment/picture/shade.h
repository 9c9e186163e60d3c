// How bright a point of the scene is: a soft key light from the upper left of the eye, and the light of the sky, less
// what stands in its way.
//
// Colours are linear light, 0 to 1 per channel. The random turns come from the pixel's own number, so the same pixel
// gets the same rays whoever computes it.

#pragma once

#include <cstdint>

#include "segment/picture/scene.h"

namespace qchopper {

struct Camera {
    Vec3 right;
    Vec3 up;
    Vec3 forward;
    Vec3 origin;  // of the middle of the picture, before everything
    double mm_per_pixel = 1;
};

Vec3 to_linear(Rgb colour);
Rgb to_rgb(Vec3 linear);

Vec3 shade(const Scene& scene, const SeenPoint& point, const Camera& camera, int ambient_rays, std::uint32_t pixel);

}  // namespace qchopper
