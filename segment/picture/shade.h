// The light that a point of the scene sends to the camera: a wide key light from the upper left of the camera, a weak
// one from the right, and the ambient light that reaches the point.
//
// Colours are linear, 0 to 1 per channel (tests/segment/picture/picture_test.cpp).

#pragma once

#include "segment/picture/camera.h"
#include "segment/picture/scene.h"

namespace qchopper {

// sRGB (IEC 61966-2-1, 1999) to linear light and back; values outside 0 to 1 are clamped.
Vec3 to_linear(Rgb colour);
Rgb to_rgb(Vec3 linear);

// The lights of one picture, and the colours of its meshes.
class Shader {
 public:
    Shader(const Scene& scene, const Camera& camera);
    // `sky`: ambient light, 0 to 1.
    Vec3 colour(const SurfacePoint& point, double sky) const;

 private:
    struct Surface {
        Vec3 scanned;
        Vec3 cap;  // the same hue, lighter
    };
    std::vector<std::vector<Surface>> surfaces_;  // per mesh and colour of its palette
    Vec3 key_;
    Vec3 fill_;
    Vec3 half_;  // between the key light and the camera
};

}  // namespace qchopper
