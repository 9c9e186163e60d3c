// Compares what height fields reach with rays from the middles of triangles.

#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <numbers>
#include <vector>

#include "segment/mesh/measure.h"
#include "segment/mesh/rays.h"
#include "tests/cam/setup/access_case.h"

namespace qchopper::test_pieces {

// Of triangles that look to one side or another, shares of the area of the piece.
struct RayAreas {
    double by_rays = 0;
    double by_map = 0;
    double difference() const { return by_map - by_rays; }
};

// With edges of at most a length: each longer one is halved, for both of its triangles, so a closed mesh stays closed
// but for points that lie twice at one place.
inline TriangleMesh with_short_edges(const TriangleMesh& mesh, double most) {
    TriangleMesh fine;
    std::vector<std::array<Vec3, 3>> left;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) left.push_back(corners_of(mesh, t));
    while (!left.empty()) {
        const std::array<Vec3, 3> p = left.back();
        left.pop_back();
        std::size_t longest = 0;
        for (std::size_t k = 1; k < 3; ++k) {
            if (norm(p[(k + 1) % 3] - p[k]) > norm(p[(longest + 1) % 3] - p[longest])) longest = k;
        }
        const Vec3 a = p[longest];
        const Vec3 b = p[(longest + 1) % 3];
        const Vec3 c = p[(longest + 2) % 3];
        if (norm(b - a) > most) {
            const Vec3 middle = 0.5 * (a + b);
            left.push_back({a, middle, c});
            left.push_back({middle, b, c});
            continue;
        }
        const auto first = static_cast<std::uint32_t>(fine.points.size());
        fine.points.insert(fine.points.end(), p.begin(), p.end());
        fine.triangles.push_back({first, first + 1, first + 2});
    }
    return fine;
}

// Expects agreement within half a percent of the area for one direction; shows that of the faces within 5 degrees of
// vertical apart, which may differ by more. The middles of triangles stand for them, so these are to be small. Returns
// the share of the area that the rays reach.
inline double expect_rays_agree(const TriangleMesh& mesh, Vec3 direction, double cell) {
    AccessCase setup;
    setup.mesh = &mesh;
    setup.up = direction;
    setup.directions = {direction};
    setup.block = bounds(mesh);
    const MappedAccess found = mapped_access(setup, {cell, 1U << 10U});
    const std::array<const TriangleMesh*, 1> meshes{&mesh};
    const PreciseRays rays(meshes);
    const double off = 1e-6 * norm(bounds(mesh).size());
    const double sine = std::sin(5 * std::numbers::pi / 180);
    double all = 0;
    RayAreas others;
    RayAreas vertical;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 vector = area_vector(mesh, t);
        const double area = norm(vector);
        if (!(area > 0)) continue;
        all += area;
        const Vec3 n = normalized(vector);
        if (dot(n, direction) <= 0) continue;
        RayAreas& own = dot(n, direction) < sine ? vertical : others;
        const std::array<Vec3, 3> p = corners_of(mesh, t);
        const Vec3 from = (1.0 / 3) * (p[0] + p[1] + p[2]) + off * n;
        if (!rays.first_hit(0, from, direction)) own.by_rays += area;
        if (found.states[t] == SurfaceState::reached) own.by_map += area;
    }
    EXPECT_NEAR(others.by_map / all, others.by_rays / all, 0.005)
        << direction.x << " " << direction.y << " " << direction.z;
    std::cout << "towards " << direction.x << " " << direction.y << " " << direction.z << ": map less rays "
              << 100 * others.difference() / all << " % of the area, of faces within 5 degrees of vertical "
              << 100 * vertical.difference() / all << " %\n";
    return others.by_rays / all;
}

}  // namespace qchopper::test_pieces
