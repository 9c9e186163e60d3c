// The fields of the specimens, and the boxes that contain them.
//
// Lengths in mm. x points to the left of the animal, y to its front, z up; the femur stands on its condyles. Each
// box contains the isosurface (tests/segment/sample/sample_test.cpp).

#pragma once

#include "segment/mesh/measure.h"
#include "segment/sample/field.h"

namespace qchopper {

struct Bone {
    BoneField field;
    Box box;                  // contains the isosurface with a margin
    double base_spacing = 0;  // a lattice cell that resolves every process and every wall
};

Bone vertebra();
Bone femur();
Bone skull();

}  // namespace qchopper
