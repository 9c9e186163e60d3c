// Marching tetrahedra: A. Doi and A. Koide, "An efficient method of triangulating equi-valued surfaces by using
// tetrahedral cells" (1991); the lattice after F. Labelle and J. Shewchuk, "Isosurface stuffing" (2007). An octree
// skips the blocks whose bounds of the field exclude 0, so the cost grows with the number of triangles, not of cells.

#include "segment/sample/isosurface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace qchopper {
namespace {

constexpr int leaf = 4;  // cells along the edge of the smallest octree block
constexpr int leaf_points = leaf + 1;

// A lattice point in half cells: corners of cells are even, their centres odd.
struct LatticePoint {
    int x = 0;
    int y = 0;
    int z = 0;
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

// Visits the blocks of the octree down to its leaves, and the tetrahedra of those.
class MarchingTetrahedra {
 public:
    MarchingTetrahedra(const Box& box, double spacing, bool counts_only, const Context& context)
        : origin_(box.min), half_(0.5 * spacing), counts_only_(counts_only), context_(context) {
        const Vec3 size = box.size();
        const double cells = std::max({size.x, size.y, size.z}) / spacing + 1;
        root_ = leaf;
        while (root_ < cells) root_ *= 2;
        for (int axis = 0; axis < 3; ++axis) extent_[axis] = static_cast<int>(std::ceil(size[axis] / spacing)) + 1;
    }

    void run(const BoneField& field) { visit_block(field, 0, 0, 0, root_); }

    std::size_t count() const { return count_; }
    TriangleMesh& mesh() { return mesh_; }

 private:
    void visit_block(const BoneField& field, int x, int y, int z, int cells) {
        if (x >= extent_[0] || y >= extent_[1] || z >= extent_[2]) return;
        // and half a cell: the tetrahedra extend to the centres of the next cells
        const double half_edge = half_ * (cells + 0.5);
        const Vec3 centre = at({2 * x, 2 * y, 2 * z}) + Vec3{half_edge, half_edge, half_edge};
        BoneField local;
        const FieldRange range = range_in_ball(field, centre, std::sqrt(3.0) * half_edge * (1 + 1e-9), local);
        if (range.low > 0 || range.high < 0) return;
        if (cells == leaf) {
            march_leaf(local, x, y, z);
            return;
        }
        const int half = cells / 2;
        for (int i = 0; i < 8; ++i) {
            visit_block(local, x + (i & 1) * half, y + (i >> 1 & 1) * half, z + (i >> 2) * half, half);
        }
    }

    Vec3 at(LatticePoint p) const { return origin_ + Vec3{half_ * p.x, half_ * p.y, half_ * p.z}; }

    static std::size_t index(int x, int y, int z) {
        constexpr std::size_t row = leaf_points;
        return (static_cast<std::size_t>(z) * row + static_cast<std::size_t>(y)) * row + static_cast<std::size_t>(x);
    }
    double value(LatticePoint p) const {
        const LatticePoint local{p.x - 2 * x0_, p.y - 2 * y0_, p.z - 2 * z0_};
        return ((local.x & 1) != 0 ? centres_ : corners_)[index(local.x >> 1, local.y >> 1, local.z >> 1)];
    }

    void march_leaf(const BoneField& field, int x, int y, int z) {
        if ((++leaves_ & 1023) == 0) context_.check_cancelled();
        x0_ = x;
        y0_ = y;
        z0_ = z;
        bool has_inside = false;
        bool has_outside = false;
        for (int k = 0; k < leaf_points; ++k) {
            for (int j = 0; j < leaf_points; ++j) {
                for (int i = 0; i < leaf_points; ++i) {
                    const LatticePoint corner{2 * (x + i), 2 * (y + j), 2 * (z + k)};
                    const double c = corners_[index(i, j, k)] = value_at(field, at(corner));
                    const double d = centres_[index(i, j, k)] =
                        value_at(field, at({corner.x + 1, corner.y + 1, corner.z + 1}));
                    has_inside |= c < 0 || d < 0;
                    has_outside |= !(c < 0) || !(d < 0);
                }
            }
        }
        if (!has_inside || !has_outside) return;
        for (int k = 0; k < leaf; ++k) {
            for (int j = 0; j < leaf; ++j) {
                for (int i = 0; i < leaf; ++i) march_cell(field, {2 * (x + i), 2 * (y + j), 2 * (z + k)});
            }
        }
    }

    // The twelve tetrahedra about the lines from a cell's centre to those of the next cells in x, y and z: each has
    // such a line and one edge of the square face between the two cells.
    void march_cell(const BoneField& field, LatticePoint low) {
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

    static LatticePoint shifted(LatticePoint p, int axis, int by) {
        (axis == 0 ? p.x : axis == 1 ? p.y : p.z) += by;
        return p;
    }

    // The corners are right-handed: the vectors from the first one to the others have a positive determinant.
    void march_tetrahedron(const BoneField& field, const std::array<LatticePoint, 4>& corner) {
        unsigned inside = 0;
        for (unsigned i = 0; i < 4; ++i) inside |= (value(corner[i]) < 0 ? 1U : 0U) << i;
        const int count_inside = std::popcount(inside);
        if (count_inside == 0 || count_inside == 4) return;
        count_ += count_inside == 2 ? 2 : 1;
        if (counts_only_) return;
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

    std::uint32_t point_on(const BoneField& field, LatticePoint a, LatticePoint b) {
        // twice the middle of an edge identifies it
        const auto key = static_cast<std::uint64_t>(a.x + b.x) << 42 | static_cast<std::uint64_t>(a.y + b.y) << 21 |
                         static_cast<std::uint64_t>(a.z + b.z);
        std::uint32_t& point = point_of_[key];
        if (point == EdgeMap::absent) {
            point = static_cast<std::uint32_t>(mesh_.points.size());
            mesh_.points.push_back(crossing(field, at(a), at(b), value(a), value(b)));
        }
        return point;
    }

    // Five steps of the Illinois method: M. Dowell and P. Jarratt, "A modified regula falsi method for computing the
    // root of an equation" (1971). The point keeps a distance from the ends, so that every triangle has an area.
    static Vec3 crossing(const BoneField& field, Vec3 a, Vec3 b, double value_a, double value_b) {
        double low = 0;
        double high = 1;
        double t = 0.5;
        int last_side = 0;
        for (int step = 0; step < 5; ++step) {
            t = low + (high - low) * value_a / (value_a - value_b);
            const double v = value_at(field, a + t * (b - a));
            if (std::abs(v) < 1e-9) break;
            if ((v < 0) == (value_a < 0)) {
                low = t;
                value_a = v;
                if (last_side == 1) value_b *= 0.5;
                last_side = 1;
            } else {
                high = t;
                value_b = v;
                if (last_side == 2) value_a *= 0.5;
                last_side = 2;
            }
        }
        constexpr double margin = 0.08;
        t = std::clamp(t, margin, 1 - margin);
        return a + t * (b - a);
    }

    Vec3 origin_;
    double half_;
    bool counts_only_;
    const Context& context_;
    int root_ = leaf;
    std::array<int, 3> extent_{};
    std::size_t count_ = 0;
    std::size_t leaves_ = 0;
    TriangleMesh mesh_;
    EdgeMap point_of_;
    int x0_ = 0;
    int y0_ = 0;
    int z0_ = 0;
    std::array<double, leaf_points * leaf_points * leaf_points> corners_{};
    std::array<double, leaf_points * leaf_points * leaf_points> centres_{};
};

}  // namespace

std::size_t count_triangles(const BoneField& field, const Box& box, double spacing, const Context& context) {
    MarchingTetrahedra march(box, spacing, true, context);
    march.run(field);
    return march.count();
}

TriangleMesh isosurface(const BoneField& field, const Box& box, double spacing, const Context& context) {
    MarchingTetrahedra march(box, spacing, false, context);
    march.run(field);
    return std::move(march.mesh());
}

}  // namespace qchopper
