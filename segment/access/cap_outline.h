// The boundary of a cap, from which follows its area below any plane.
//
// mm. Equal to the area of the cap cut by the plane (tests/segment/access/cap_outline_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/access/unreachable.h"

namespace qchopper {

class CapOutline {
 public:
    // `triangles` are those of the cap.
    CapOutline(const TriangleMesh& mesh, const OwnedCap& cap, std::span<const std::uint32_t> triangles);

    const OwnedCap& cap() const { return cap_; }

    // mm2, one per offset: of the planes of a normal, a unit vector, the offsets ascending. O(edges + offsets +
    // crossings).
    std::vector<double> area_below(Vec3 normal, std::span<const double> offsets) const;

 private:
    OwnedCap cap_;
    Vec3 origin_;  // a point of the cap: heights count from it
    std::vector<std::array<Vec3, 2>> edges_;
};

// One per cap. O(triangles x caps).
std::vector<CapOutline> outlines(const TriangleMesh& mesh, std::span<const OwnedCap> caps);

}  // namespace qchopper
