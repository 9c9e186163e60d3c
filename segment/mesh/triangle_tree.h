// A bounding-volume tree over the triangles of a mesh, for triangles near a box and the point nearest to another.
//
// mm. Boxes are single precision about the centre of the mesh. Rounding is monotonic, so boxes that meet in double
// precision meet here too: no triangle is missed (tests/segment/mesh/triangle_tree_test.cpp). O(log triangles) per
// query on average; 28 bytes per triangle, and 12 to 24 for the nodes.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct FloatBox {
    static constexpr float none = std::numeric_limits<float>::infinity();
    std::array<float, 3> min{none, none, none};  // a new box is empty and meets nothing
    std::array<float, 3> max{-none, -none, -none};
};

// Whether two boxes have a point in common.
inline bool do_meet(const FloatBox& a, const FloatBox& b) {
    // without branches: mispredicted ones cost more than the six comparisons
    const int meets = int{a.min[0] <= b.max[0]} & int{b.min[0] <= a.max[0]} & int{a.min[1] <= b.max[1]} &
                      int{b.min[1] <= a.max[1]} & int{a.min[2] <= b.max[2]} & int{b.min[2] <= a.max[2]};
    return meets != 0;
}

// The point of a triangle that is closest to p, and the shares of its corners in it: a share of a corner that the point
// does not lie towards is exactly 0. Of a degenerate triangle some point, perhaps not the closest.
struct NearestOfTriangle {
    Vec3 point;
    std::array<double, 3> share{};
};
NearestOfTriangle nearest_of_triangle(Vec3 p, const std::array<Vec3, 3>& triangle);
Vec3 closest_on_triangle(Vec3 p, const std::array<Vec3, 3>& triangle);

struct TriangleTree {
    static constexpr std::size_t per_leaf = 4;

    Vec3 centre;
    std::vector<std::uint32_t> order;   // triangles along a space-filling curve; per_leaf of them are a leaf
    std::vector<FloatBox> of_triangle;  // one per triangle, in that order
    std::vector<FloatBox> of_node;      // node 1 is the root, node n has the children 2n and 2n+1
    std::size_t leaves = 0;             // a power of two: node leaves + i is leaf i

    explicit TriangleTree(const TriangleMesh& mesh);

    // The box of a triangle in the coordinates of the tree.
    FloatBox box_of(const std::array<Vec3, 3>& corners) const;

    // Calls found(triangle) for every triangle whose box meets this one, which is in the coordinates of the tree.
    template <class Found>
    void for_each_near(const FloatBox& box, const Found& found) const {
        for_each_place_near(box, [&](std::size_t place) { found(order[place]); });
    }

    // The same with the places of the triangles in `order`.
    template <class Found>
    void for_each_place_near(const FloatBox& box, const Found& found) const {
        descend([&](const FloatBox& node) { return do_meet(node, box); },
                [&](std::size_t place) {
                    if (do_meet(of_triangle[place], box)) found(place);
                });
    }

    struct Nearest {
        double distance = std::numeric_limits<double>::infinity();
        Vec3 point;
        std::uint32_t triangle = 0;
    };
    // The nearest point of the surface, or the first one found that is no farther than `enough`. `mesh` is the one that
    // the tree was built from.
    Nearest nearest(const TriangleMesh& mesh, Vec3 p, double enough = 0) const;

    // Whether the surface is somewhere nearer to p than `distance`; `mesh` as above. Triangles of which is_left_out is
    // true (one per triangle, or empty) are passed over.
    bool is_any_nearer(const TriangleMesh& mesh, Vec3 p, double distance,
                       const std::vector<bool>& is_left_out = {}) const;

 private:
    template <class Enter, class Visit>
    void descend(const Enter& enter, const Visit& visit) const {
        std::array<std::size_t, 64> stack;
        std::size_t height = 0;
        if (leaves > 0 && enter(of_node[1])) stack[height++] = 1;
        while (height > 0) {
            const std::size_t node = stack[--height];
            if (node >= leaves) {
                const std::size_t begin = (node - leaves) * per_leaf;
                const std::size_t end = begin + per_leaf < order.size() ? begin + per_leaf : order.size();
                for (std::size_t place = begin; place < end; ++place) visit(place);
                continue;
            }
            if (enter(of_node[2 * node + 1])) stack[height++] = 2 * node + 1;
            if (enter(of_node[2 * node])) stack[height++] = 2 * node;
        }
    }
};

}  // namespace qchopper
