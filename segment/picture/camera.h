// What a picture shows, its options, and its orthographic camera.
//
// Lengths in mm, sizes in pixels. `right`, `up` and `forward` are orthonormal.

#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "segment/mesh/triangle_mesh.h"
#include "segment/picture/colour.h"

namespace qchopper {

// A mesh to be drawn, with its colour or those of its triangles, its place and its name.
struct ColouredMesh {
    const TriangleMesh* mesh = nullptr;  // stays the caller's
    Rgb colour = bone_colour;
    Vec3 shift;             // mm, added to every point
    std::string name = {};  // written on it; empty: nothing
    // With both, triangle t has the colour palette[colour_of[t]] in place of `colour`; both stay the caller's.
    std::span<const Rgb> palette = {};
    std::span<const std::uint8_t> colour_of = {};  // per triangle
};

struct PictureOptions {
    int width = 1200;  // pixels
    int height = 900;
    Vec3 view{-0.55, 0.75, -0.38};  // from the eye to the meshes; any length
    Vec3 up{0, 0, 1};
    Rgb background{250, 250, 248};
    int supersampling = 2;  // samples per pixel: this squared
    int ambient_rays = 8;   // per point at which ambient light is computed; 0: constant light
    double outline = 1.2;   // width of the dark line at the border of a piece, in pixels; 0: none
    double frame = 0.06;    // empty border, as a share of the picture
    bool labels = true;     // names of the meshes, and a scale bar
    double letters = 0.02;  // height of the names' capital letters, as a share of the picture's
};

struct Camera {
    Vec3 right;
    Vec3 up;
    Vec3 forward;
    Vec3 origin;  // seen in the middle of the picture, in front of everything
    double mm_per_pixel = 1;
};

// Frames all points of the meshes, moved by their shifts. Without any point the camera is at the origin.
Camera framed(std::span<const ColouredMesh> meshes, const PictureOptions& options);

}  // namespace qchopper
