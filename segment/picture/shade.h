// Computes the colour of a point of the scene: a soft key light from the upper left of the camera, a fill light from
// the right and the light of the sky, less what other surfaces occlude.
//
// Colours are linear, 0 to 1 per channel. The directions of the ambient rays depend on the number of the pixel only, so
// that the picture does not depend on the threads (tests/segment/picture/picture_test.cpp).

#pragma once

#include <cstdint>

#include "segment/picture/scene.h"

namespace qchopper {

// Orthographic. right, up and forward are perpendicular and of length 1.
struct Camera {
    Vec3 right;
    Vec3 up;
    Vec3 forward;
    Vec3 origin;  // of the ray at the middle of the picture, in front of the scene
    double mm_per_pixel = 1;
};

// The transfer function of sRGB (IEC 61966-2-1) and its inverse; to_rgb clamps to 0 to 1.
Vec3 to_linear(Rgb colour);
Rgb to_rgb(Vec3 linear);

// With 0 ambient rays the light of the sky is constant. Precondition: the point is a hit of this scene.
Vec3 shade(const Scene& scene, const SurfaceHit& point, const Camera& camera, int ambient_rays, std::uint32_t pixel);

}  // namespace qchopper
