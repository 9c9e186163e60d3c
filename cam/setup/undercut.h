// Measures how much of a piece's surface faces down when one of its caps lies on the table: the thesis' undercut.
//
// Undercut u(phi): Nicholson, "QChopper", 2016, section 4.2.4, the base left out: with it the share is one half for
// every closed surface. In [0, 1/2) on a closed piece with a base (tests/cam/setup/undercut_test.cpp). `base` is the
// number of the cut whose cap lies on the table, `up` a unit vector.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Projected areas along `up`, in mm2.
struct Facing {
    double up = 0;                   // of what faces up, base left out
    double down = 0;                 // of what faces down, base left out
    double base = 0;                 // of the base, signed: positive when it faces down
    std::size_t triangles_up = 0;    // base left out, those at right angles to `up` counted too
    std::size_t triangles_down = 0;  // base left out
    // Share of what faces down, by area and by the number of triangles; 1/2 where there is none.
    double undercut() const { return up + down > 0 ? down / (up + down) : 0.5; }
    double undercut_by_count() const {
        const auto all = static_cast<double>(triangles_up + triangles_down);
        return all > 0 ? static_cast<double>(triangles_down) / all : 0.5;
    }
};
// Caps of the cuts `sawn` are left out of both. Precondition: the mesh is consistent, and `up` is not zero.
Facing facing(const TriangleMesh& mesh, Vec3 up, std::optional<std::int32_t> base,
              std::span<const std::int32_t> sawn = {});

}  // namespace qchopper
