// A pass: a line along which the tip cuts without leaving the foam.
//
// mm, in the frame of the height fields of one direction (cl_surface.h).

#pragma once

#include <vector>

#include "base/vec3.h"

namespace qchopper {

struct PassPoint {
    Vec3 tip;
    bool is_rounded = false;  // whether the corner may be rounded as far as the operation says
};

struct Pass {
    std::vector<PassPoint> points;  // at least two; of a closed one the last is the first again
    bool is_closed = false;         // it may be begun anywhere, and in either direction
};

}  // namespace qchopper
