// Solids with one outline along y: slots whose openness is known.

#pragma once

#include <cstdint>
#include <vector>

#include "segment/cut/ear_clipping.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A polygon in x and z, extruded along y.
inline TriangleMesh extruded(const std::vector<Point2>& outline, double y0, double y1) {
    TriangleMesh mesh;
    const auto n = static_cast<std::uint32_t>(outline.size());
    Loop loop;
    for (const double y : {y0, y1}) {
        for (const Point2& p : outline) mesh.points.push_back({p.x, y, p.y});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        loop.push_back(i);
        mesh.triangles.push_back({i, n + i, n + j});
        mesh.triangles.push_back({i, n + j, j});
    }
    for (const auto& [a, b, c] : clip_ears(outline, loop, {})) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({n + a, n + c, n + b});
    }
    return mesh;
}

}  // namespace qchopper
