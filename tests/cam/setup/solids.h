// Solids of rectangular cells, for tests of what a tool reaches: their areas and volumes are known.

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper::test_pieces {

// Coordinates from `min` to `max` in steps of about `step`, both ends included.
inline std::vector<double> steps(double min, double max, double step) {
    const auto count = static_cast<std::size_t>(std::lround((max - min) / step));
    std::vector<double> all;
    for (std::size_t i = 0; i <= count; ++i) {
        all.push_back(min + (max - min) * static_cast<double>(i) / static_cast<double>(count));
    }
    return all;
}

// Of the cells between consecutive coordinates those whose middle `is_solid`. Closed, outwards; what lies at the least
// z and faces down is the cap of cut 0.
template <class IsSolid>
TriangleMesh cell_solid(const std::vector<double>& xs, const std::vector<double>& ys, const std::vector<double>& zs,
                        const IsSolid& is_solid) {
    const std::array<const std::vector<double>*, 3> at{&xs, &ys, &zs};
    const auto is_filled = [&](const std::array<int, 3>& cell) {
        Vec3 middle;
        for (int i = 0; i < 3; ++i) {
            const std::vector<double>& own = *at[static_cast<std::size_t>(i)];
            const int k = cell[static_cast<std::size_t>(i)];
            if (k < 0 || k + 1 >= static_cast<int>(own.size())) return false;
            middle[i] = 0.5 * (own[static_cast<std::size_t>(k)] + own[static_cast<std::size_t>(k) + 1]);
        }
        return is_solid(middle);
    };
    TriangleMesh mesh;
    std::map<std::array<int, 3>, std::uint32_t> index;
    const auto point = [&](const std::array<int, 3>& corner) {
        const auto [found, is_new] = index.try_emplace(corner, static_cast<std::uint32_t>(mesh.points.size()));
        if (is_new) {
            mesh.points.push_back({xs[static_cast<std::size_t>(corner[0])], ys[static_cast<std::size_t>(corner[1])],
                                   zs[static_cast<std::size_t>(corner[2])]});
        }
        return found->second;
    };
    const auto add_side = [&](const std::array<int, 3>& cell, std::size_t axis, bool is_far) {
        std::array<int, 3> next = cell;
        next[axis] += is_far ? 1 : -1;
        if (is_filled(next)) return;
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        std::array<std::uint32_t, 4> corner{};
        for (std::size_t k = 0; k < 4; ++k) {
            std::array<int, 3> c = cell;
            c[axis] += is_far ? 1 : 0;
            c[u] += k == 1 || k == 2 ? 1 : 0;
            c[v] += k >= 2 ? 1 : 0;
            corner[is_far ? k : 3 - k] = point(c);
        }
        const std::int32_t cap = axis == 2 && !is_far && cell[2] == 0 ? 0 : no_cap;
        mesh.triangles.push_back({corner[0], corner[1], corner[2]});
        mesh.triangles.push_back({corner[0], corner[2], corner[3]});
        mesh.cap_of.insert(mesh.cap_of.end(), 2, cap);
    };
    for (int x = 0; x + 1 < static_cast<int>(xs.size()); ++x) {
        for (int y = 0; y + 1 < static_cast<int>(ys.size()); ++y) {
            for (int z = 0; z + 1 < static_cast<int>(zs.size()); ++z) {
                const std::array<int, 3> cell{x, y, z};
                if (!is_filled(cell)) continue;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    for (const bool is_far : {false, true}) add_side(cell, axis, is_far);
                }
            }
        }
    }
    return mesh;
}

}  // namespace qchopper::test_pieces
