// What the tests of the sweep share: tilts, specimens of few faces, and the sides of a plane by name.

#pragma once

#include <array>
#include <map>
#include <span>

#include "segment/access/access_sweep.h"
#include "segment/sample/sample.h"

namespace qchopper {

constexpr std::array<double, 5> tilts{0, 30, 60, 85, 90};

inline std::span<const SideOnBase> side(const PlaneAccess& access, bool above) {
    return above ? access.above : access.below;
}

// Made once: that takes longer than all the rest.
inline const TriangleMesh& small_specimen(Specimen kind) {
    static std::map<Specimen, TriangleMesh> made;
    if (!made.contains(kind)) {
        SampleOptions options;
        options.faces = 6'000;
        made[kind] = sample(kind, options);
    }
    return made[kind];
}

}  // namespace qchopper
