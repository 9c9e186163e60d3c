// The fields of the specimens, and the boxes that hold them.
//
// Lengths in mm. x runs to the animal's left, y to its front, z up; the femur stands on its condyles.

#pragma once

#include "segment/mesh/measure.h"
#include "segment/sample/field.h"

namespace qchopper {

struct Bone {
    BoneField field;
    Box box;                  // holds the surface with room to spare
    double base_spacing = 0;  // a lattice cell that resolves every process and every wall
};

Bone vertebra();
Bone femur();
Bone skull();

}  // namespace qchopper
