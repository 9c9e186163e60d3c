// A mesh to be drawn, with its colour and place.

#pragma once

#include "segment/mesh/triangle_mesh.h"
#include "segment/picture/colour.h"

namespace qchopper {

struct Coloured {
    const TriangleMesh* mesh = nullptr;  // stays the caller's
    Rgb colour = bone_colour;
    Vec3 shift;  // mm, added to every point
};

}  // namespace qchopper
