// A mesh to be drawn, with its colour or those of its triangles, its place and its name.

#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "segment/mesh/triangle_mesh.h"
#include "segment/picture/colour.h"

namespace qchopper {

struct ColouredMesh {
    const TriangleMesh* mesh = nullptr;  // stays the caller's
    Rgb colour = bone_colour;
    Vec3 shift;             // mm, added to every point
    std::string name = {};  // written on it; empty: nothing
    // With both, triangle t has the colour palette[colour_of[t]] in place of `colour`; both stay the caller's.
    std::span<const Rgb> palette = {};
    std::span<const std::uint8_t> colour_of = {};  // per triangle
};

}  // namespace qchopper
