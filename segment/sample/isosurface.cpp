// Marching tetrahedra. An octree skips the blocks whose bounds of the field exclude 0, so the cost grows with the
// number of triangles, not of cells.

#include "segment/sample/isosurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "segment/mesh/marching_tetrahedra.h"

namespace qchopper {
namespace {

constexpr int leaf = 4;  // cells along the edge of the smallest octree block
constexpr int leaf_points = leaf + 1;

// Visits the blocks of the octree down to its leaves, and the tetrahedra of those.
class Octree {
 public:
    Octree(const Box& box, double spacing, bool only_counts, const Context& context)
        : origin_(box.min), half_(0.5 * spacing), context_(context), tetrahedra_(only_counts) {
        const Vec3 size = box.size();
        const double cells = std::max({size.x, size.y, size.z}) / spacing + 1;
        root_ = leaf;
        while (root_ < cells) root_ *= 2;
        for (int axis = 0; axis < 3; ++axis) extent_[axis] = static_cast<int>(std::ceil(size[axis] / spacing)) + 1;
    }

    void run(const BoneField& field) { visit_block(field, 0, 0, 0, root_); }

    std::size_t count() const { return tetrahedra_.count(); }
    TriangleMesh& mesh() { return tetrahedra_.mesh(); }

 private:
    // The field within a leaf, as the tetrahedra ask for it.
    struct Leaf {
        const Octree& tree;
        const BoneField& field;
        double value(LatticePoint p) const { return tree.value(p); }
        Vec3 crossing(LatticePoint a, LatticePoint b) const {
            return crossing_of(field, tree.at(a), tree.at(b), tree.value(a), tree.value(b));
        }
    };

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
        const Leaf known{*this, field};
        for (int k = 0; k < leaf; ++k) {
            for (int j = 0; j < leaf; ++j) {
                for (int i = 0; i < leaf; ++i) {
                    tetrahedra_.march_cell(known, {2 * (x + i), 2 * (y + j), 2 * (z + k)});
                }
            }
        }
    }

    // Five steps of the Illinois method: M. Dowell and P. Jarratt, "A modified regula falsi method for computing the
    // root of an equation" (1971). The point keeps a distance from the ends, so that every triangle has an area.
    static Vec3 crossing_of(const BoneField& field, Vec3 a, Vec3 b, double value_a, double value_b) {
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
    const Context& context_;
    int root_ = leaf;
    std::array<int, 3> extent_{};
    std::size_t leaves_ = 0;
    MarchingTetrahedra tetrahedra_;
    int x0_ = 0;
    int y0_ = 0;
    int z0_ = 0;
    std::array<double, leaf_points * leaf_points * leaf_points> corners_{};
    std::array<double, leaf_points * leaf_points * leaf_points> centres_{};
};

}  // namespace

std::size_t count_triangles(const BoneField& field, const Box& box, double spacing, const Context& context) {
    Octree octree(box, spacing, true, context);
    octree.run(field);
    return octree.count();
}

TriangleMesh isosurface(const BoneField& field, const Box& box, double spacing, const Context& context) {
    Octree octree(box, spacing, false, context);
    octree.run(field);
    return std::move(octree.mesh());
}

}  // namespace qchopper
