// An axis-parallel box, given by its least and its largest corner.
//
// Lengths in mm. Box{} holds the origin alone: to bound points, begin with {p, p} of the first one.

#pragma once

#include <algorithm>

#include "base/vec3.h"

namespace qchopper {

struct Box {
    Vec3 min;
    Vec3 max;
    bool operator==(const Box&) const = default;
    Vec3 size() const { return max - min; }
    Vec3 centre() const { return 0.5 * (min + max); }
};

// Enlarges the box so that it holds p.
inline void extend(Box& box, Vec3 p) {
    box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
    box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
}

}  // namespace qchopper
