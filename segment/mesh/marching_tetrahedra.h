// The surface where a field that is given at the points of a body-centred cubic lattice is 0.
//
// Each tetrahedron of the lattice has at most two triangles, whose corners lie on its edges, so the surface is manifold
// and does not intersect itself, whatever the values; it ends only where values are not known
// (tests/segment/sample/isosurface_test.cpp, tests/segment/fuse/distance_grid_test.cpp). Marching tetrahedra: A. Doi
// and A. Koide, "An efficient method of triangulating equi-valued surfaces by using tetrahedral cells" (1991); the
// lattice after F. Labelle and J. Shewchuk, "Isosurface stuffing" (2007). O(1) per cell.

#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A lattice point in half cells: corners of cells are even, their centres odd. 0 to 2^20.
struct LatticePoint {
    int x = 0;
    int y = 0;
    int z = 0;
    bool operator==(const LatticePoint&) const = default;
};

// A hash table of points by the lattice edge that they lie on. Open addressing, linear probing.
class EdgeMap {
 public:
    static constexpr std::uint32_t absent = std::numeric_limits<std::uint32_t>::max();

    EdgeMap() : keys_(1 << 12, free_key), points_(1 << 12, absent) {}

    // The point of this edge; `absent` if the edge is new.
    std::uint32_t& operator[](std::uint64_t key) {
        if (2 * used_ >= keys_.size()) grow();
        const std::size_t at = find(key);
        if (keys_[at] == free_key) {
            keys_[at] = key;
            ++used_;
        }
        return points_[at];
    }

 private:
    static constexpr std::uint64_t free_key = std::numeric_limits<std::uint64_t>::max();

    std::size_t find(std::uint64_t key) const {
        const std::size_t mask = keys_.size() - 1;
        std::size_t at = (key * 0x9e3779b97f4a7c15U >> 20) & mask;
        while (keys_[at] != free_key && keys_[at] != key) at = (at + 1) & mask;
        return at;
    }

    void grow() {
        std::vector<std::uint64_t> keys(2 * keys_.size(), free_key);
        std::vector<std::uint32_t> points(2 * points_.size(), absent);
        keys.swap(keys_);
        points.swap(points_);
        for (std::size_t i = 0; i < keys.size(); ++i) {
            if (keys[i] == free_key) continue;
            const std::size_t at = find(keys[i]);
            keys_[at] = keys[i];
            points_[at] = points[i];
        }
    }

    std::vector<std::uint64_t> keys_;
    std::vector<std::uint32_t> points_;
    std::size_t used_ = 0;
};

// A field has
//   double value(LatticePoint) const    below 0 inside; not a number where it is not known
//   Vec3 crossing(LatticePoint a, LatticePoint b) const    between points of unlike signs, at neither of them
class MarchingTetrahedra {
 public:
    // Only counts triangles if asked to.
    explicit MarchingTetrahedra(bool only_counts = false) : only_counts_(only_counts) {}

    // The twelve tetrahedra about the lines from the centre of the cell with this lowest corner to those of the next
    // cells in x, y and z: each has such a line and one edge of the square face between the two cells. One of which a
    // value is not known is left out. Precondition: each cell is marched once.
    template <class Field>
    void march_cell(const Field& field, LatticePoint low) {
        const LatticePoint centre{low.x + 1, low.y + 1, low.z + 1};
        for (int axis = 0; axis < 3; ++axis) {
            const LatticePoint next = shifted(centre, axis, 2);
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            const LatticePoint q0 = shifted(low, axis, 2);
            const LatticePoint q1 = shifted(q0, u, 2);
            const LatticePoint q2 = shifted(q1, v, 2);
            const LatticePoint q3 = shifted(q0, v, 2);
            march_tetrahedron(field, {centre, next, q0, q1});
            march_tetrahedron(field, {centre, next, q1, q2});
            march_tetrahedron(field, {centre, next, q2, q3});
            march_tetrahedron(field, {centre, next, q3, q0});
        }
    }

    std::size_t count() const { return count_; }
    TriangleMesh& mesh() { return mesh_; }

 private:
    static LatticePoint shifted(LatticePoint p, int axis, int by) {
        (axis == 0 ? p.x : axis == 1 ? p.y : p.z) += by;
        return p;
    }

    // The corners are right-handed: the vectors from the first one to the others have a positive determinant.
    template <class Field>
    void march_tetrahedron(const Field& field, const std::array<LatticePoint, 4>& corner) {
        unsigned inside = 0;
        for (unsigned i = 0; i < 4; ++i) {
            const double value = field.value(corner[i]);
            if (value != value) return;
            inside |= (value < 0 ? 1U : 0U) << i;
        }
        const int count_inside = std::popcount(inside);
        if (count_inside == 0 || count_inside == 4) return;
        count_ += count_inside == 2 ? 2 : 1;
        if (only_counts_) return;
        // the corners, those on one side in front, as an even permutation
        static constexpr std::array<std::array<unsigned, 4>, 16> order{{{0, 1, 2, 3},
                                                                        {0, 1, 2, 3},
                                                                        {1, 0, 3, 2},
                                                                        {0, 1, 2, 3},
                                                                        {2, 0, 1, 3},
                                                                        {0, 2, 3, 1},
                                                                        {1, 2, 0, 3},
                                                                        {3, 0, 2, 1},
                                                                        {3, 0, 2, 1},
                                                                        {0, 3, 1, 2},
                                                                        {1, 3, 2, 0},
                                                                        {2, 0, 1, 3},
                                                                        {2, 3, 0, 1},
                                                                        {1, 0, 3, 2},
                                                                        {0, 1, 2, 3},
                                                                        {0, 1, 2, 3}}};
        const std::array<unsigned, 4>& o = order[inside];
        const auto on = [&](unsigned a, unsigned b) { return point_on(field, corner[o[a]], corner[o[b]]); };
        if (count_inside == 1) {
            mesh_.triangles.push_back({on(0, 1), on(0, 2), on(0, 3)});
        } else if (count_inside == 3) {
            mesh_.triangles.push_back({on(0, 1), on(0, 3), on(0, 2)});
        } else {
            add_quadrangle({on(0, 2), on(0, 3), on(1, 3), on(1, 2)});
        }
    }

    void add_quadrangle(const std::array<std::uint32_t, 4>& q) {
        const auto length = [&](unsigned a, unsigned b) { return norm(mesh_.points[q[a]] - mesh_.points[q[b]]); };
        if (length(0, 2) <= length(1, 3)) {
            mesh_.triangles.push_back({q[0], q[1], q[2]});
            mesh_.triangles.push_back({q[0], q[2], q[3]});
        } else {
            mesh_.triangles.push_back({q[0], q[1], q[3]});
            mesh_.triangles.push_back({q[1], q[2], q[3]});
        }
    }

    template <class Field>
    std::uint32_t point_on(const Field& field, LatticePoint a, LatticePoint b) {
        // twice the middle of an edge identifies it
        const auto key = static_cast<std::uint64_t>(a.x + b.x) << 42 | static_cast<std::uint64_t>(a.y + b.y) << 21 |
                         static_cast<std::uint64_t>(a.z + b.z);
        std::uint32_t& point = point_of_[key];
        if (point == EdgeMap::absent) {
            point = static_cast<std::uint32_t>(mesh_.points.size());
            mesh_.points.push_back(field.crossing(a, b));
        }
        return point;
    }

    bool only_counts_;
    std::size_t count_ = 0;
    TriangleMesh mesh_;
    EdgeMap point_of_;
};

}  // namespace qchopper
