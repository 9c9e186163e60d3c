// An axis-parallel box.

#pragma once

#include "base/vec3.h"

namespace qchopper {

struct Box {
    Vec3 min;
    Vec3 max;
    bool operator==(const Box&) const = default;
    Vec3 size() const { return max - min; }
    Vec3 centre() const { return 0.5 * (min + max); }
};

}  // namespace qchopper
