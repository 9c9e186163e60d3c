// A mesh to be drawn, with its colour, place and name.

#pragma once

#include <string>

#include "segment/mesh/triangle_mesh.h"
#include "segment/picture/colour.h"

namespace qchopper {

struct ColouredMesh {
    const TriangleMesh* mesh = nullptr;  // stays the caller's
    Rgb colour = bone_colour;
    Vec3 shift;             // mm, added to every point
    std::string name = {};  // written on it; empty: nothing
};

}  // namespace qchopper
