// The invariants of a closed mesh of a specimen.

#pragma once

#include <gtest/gtest.h>

#include <set>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/shells.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Of a closed mesh of one shell.
inline long genus(const TriangleMesh& mesh) {
    const long euler = static_cast<long>(mesh.points.size()) - static_cast<long>(mesh.triangles.size()) / 2;
    return 1 - euler / 2;
}

// The number of points around which the triangles do not form one ring.
inline std::size_t non_manifold_vertices(const TriangleMesh& mesh, const Edges& found) {
    std::vector<std::size_t> uses(mesh.points.size());
    std::vector<std::uint32_t> any(mesh.points.size());
    for (std::uint32_t h = 0; h < 3 * mesh.triangles.size(); ++h) {
        const std::uint32_t point = mesh.triangles[h / 3][h % 3];
        ++uses[point];
        any[point] = h;
    }
    std::size_t non_manifold = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        if (uses[v] == 0) {
            ++non_manifold;
            continue;
        }
        std::size_t around = 0;
        std::uint32_t h = any[v];
        do {
            const std::uint32_t back = found.twin[h];
            h = back % 3 == 2 ? back - 2 : back + 1;
            ++around;
        } while (h != any[v] && around <= uses[v]);
        non_manifold += around != uses[v];
    }
    return non_manifold;
}

inline void expect_valid_solid(const TriangleMesh& mesh) {
    const Edges found = edges(mesh);
    ASSERT_TRUE(found.faults.is_closed());
    EXPECT_EQ(non_manifold_vertices(mesh, found), 0U);
    EXPECT_EQ(shells(mesh).count(), 1U);
    EXPECT_GT(volume_mm3(mesh), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) ASSERT_GT(norm(area_vector(mesh, t)), 0) << t;
}

}  // namespace qchopper
