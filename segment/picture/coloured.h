// A mesh to be drawn, with its colour and its shift.

#pragma once

#include "segment/mesh/triangle_mesh.h"
#include "segment/picture/colour.h"

namespace qchopper {

struct ColouredMesh {
    const TriangleMesh* mesh = nullptr;  // owned by the caller
    Rgb colour = bone_colour;
    Vec3 shift;  // mm, added to every point
};

}  // namespace qchopper
