// Divides a mesh into the slabs between the offsets of one normal, and finds the graph of its slab components.
//
// A slab component, here called component, is a connected set of vertices in one slab. Triangles inside a slab are
// added to their component, whole clusters at once where possible; a triangle that reaches over several slabs is listed
// as a crossed triangle. mm; the sums that follow from it are held to those of cutting
// (tests/segment/objectives/sweep/sweep_test.cpp).

#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "segment/mesh/plane_section.h"
#include "segment/objectives/sweep/prepared.h"

namespace qchopper {

// Sums over the triangles of a part: faces, volume (mm3), and the weighted normals projected on the sweep's normal,
// upward and downward ones apart, by area (mm2) or by count.
struct PartSums {
    double faces = 0;
    double volume = 0;
    double up = 0;
    double down = 0;
    void operator+=(const PartSums& b) {
        faces += b.faces;
        volume += b.volume;
        up += b.up;
        down += b.down;
    }
    void add_projected(double along) {
        up += along > 0 ? along : 0;
        down += along < 0 ? -along : 0;
    }
};

// Along the axes of the piece's oriented box; the default holds nothing.
struct PartBox {
    std::array<double, 3> low{no_length, no_length, no_length};
    std::array<double, 3> high{-no_length, -no_length, -no_length};
    static constexpr double no_length = std::numeric_limits<double>::infinity();
    void include(std::size_t axis, double from, double to) {
        low[axis] = std::min(low[axis], from);
        high[axis] = std::max(high[axis], to);
    }
    void include(const PartBox& b) {
        for (std::size_t axis = 0; axis < 3; ++axis) include(axis, b.low[axis], b.high[axis]);
    }
    Vec3 size() const { return {high[0] - low[0], high[1] - low[1], high[2] - low[2]}; }
};

// Sums of many parts (components, loops or merged ones), and for each part the sums of every half-space of the piece,
// and its box along the axes of the piece's oriented box if boxes are asked for. Merging two parts adds their rows.
class SumTable {
 public:
    SumTable() = default;
    SumTable(std::size_t parts, std::size_t half_spaces, bool has_boxes = false)
        : half_spaces_(half_spaces), parts_(parts), bases_(parts * half_spaces), boxes_(has_boxes ? parts : 0) {}
    bool has_boxes() const { return !boxes_.empty(); }
    void add_boxes() { boxes_.resize(parts_.size()); }
    PartBox& box(std::size_t p) { return boxes_[p]; }
    const PartBox& box(std::size_t p) const { return boxes_[p]; }
    PartSums& part(std::size_t p) { return parts_[p]; }
    const PartSums& part(std::size_t p) const { return parts_[p]; }
    std::span<BaseSums> bases(std::size_t p) { return std::span(bases_).subspan(p * half_spaces_, half_spaces_); }
    std::span<const BaseSums> bases(std::size_t p) const {
        return std::span(bases_).subspan(p * half_spaces_, half_spaces_);
    }
    std::size_t half_spaces() const { return half_spaces_; }

    void add(std::size_t to, const SumTable& from, std::size_t p) {
        assert(half_spaces_ == from.half_spaces_);
        parts_[to] += from.parts_[p];
        for (std::size_t b = 0; b < half_spaces_; ++b)
            bases_[to * half_spaces_ + b] += from.bases_[p * half_spaces_ + b];
        if (!boxes_.empty() && !from.boxes_.empty()) boxes_[to].include(from.boxes_[p]);
    }

 private:
    std::size_t half_spaces_ = 0;
    std::vector<PartSums> parts_;
    std::vector<BaseSums> bases_;  // part by part
    std::vector<PartBox> boxes_;   // per part, or none
};

// A triangle whose corners lie in different slabs.
struct CrossedTriangle {
    std::uint32_t triangle;
    std::array<std::uint32_t, 3> component;  // per corner
    std::array<std::uint16_t, 3> slab;       // per corner: the number of offsets at or below it
    std::uint16_t low;                       // least and largest slab: the planes low .. high-1 cross it
    std::uint16_t high;
    std::uint32_t first_crossing;  // in Slabs::point and exit
    std::array<double, 3> height;
    double along;  // its weighted normal (PreparedPiece) projected on the sweep's normal
    double volume;
};

inline TriangleCrossing crossing(const CrossedTriangle& c, std::size_t plane) {
    return triangle_crossing(c.slab[0] > plane, c.slab[1] > plane, c.slab[2] > plane);
}

struct Slabs {
    std::vector<std::uint16_t> component_slab;  // per component
    SumTable inside;                            // per component: the triangles inside its slab
    SumTable above;                             // per component: crossed triangles whose lowest corner it has
    SumTable below;                             // per component: crossed triangles whose highest corner it has
    // Pairs of components that share a crossed triangle; some repeat.
    std::vector<std::array<std::uint32_t, 2>> connections;
    std::vector<CrossedTriangle> crossed;     // cluster by cluster
    std::vector<Point2> point;                // per crossing of a triangle: where its exit edge meets the plane
    std::vector<std::uint32_t> exit;          // per crossing: the half-edge through which the surface leaves downwards
    std::vector<std::uint32_t> component_of;  // per point of the mesh
    std::size_t components() const { return component_slab.size(); }
};

// Preconditions: at least one offset, ascending, none at the height of a vertex, fewer than 65,536; a unit normal. The
// slab number and the component number of a point share 32 bits (an assert checks that they fit).
Slabs slabs(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets);

// Adds a crossed triangle to the sums of a part: `share` of its area and volume, counted as `faces` triangles.
inline void add_part(SumTable& table, std::size_t part, const PreparedPiece& prepared, const CrossedTriangle& c,
                     double share, double faces) {
    PartSums& sums = table.part(part);
    sums.faces += faces;
    sums.volume += share * c.volume;
    sums.add_projected((prepared.unit.empty() ? share : faces) * c.along);
    if (table.half_spaces() > 0) add_to_bases(table.bases(part), prepared, c.triangle, share, faces);
}

}  // namespace qchopper
