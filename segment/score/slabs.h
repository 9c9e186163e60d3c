// The slabs between the offsets of one normal, and the small graph of what hangs together in each of them.
//
// A node is a connected set of vertices in one slab. Triangles inside a slab are summed up in its node, patch by patch
// where a whole patch lies in it; a triangle that reaches over several slabs is kept aside as a crossed one.

#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/plane_section.h"
#include "segment/score/prepared.h"

namespace qchopper {

// What is added up over the triangles of a part: faces, volume (mm3), and what looks up and down along the normal, by
// area (mm2) or by count.
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
    void add_look(double along) {
        up += along > 0 ? along : 0;
        down += along < 0 ? -along : 0;
    }
};

// Sums of many parts (nodes, loops or merged ones), each with those of every bound of the piece. Merging parts is
// adding their rows.
class SumTable {
 public:
    SumTable() = default;
    SumTable(std::size_t parts, std::size_t bounds) : bounds_(bounds), parts_(parts), bases_(parts * bounds) {}
    PartSums& part(std::size_t p) { return parts_[p]; }
    const PartSums& part(std::size_t p) const { return parts_[p]; }
    std::span<BaseSums> bases(std::size_t p) { return std::span(bases_).subspan(p * bounds_, bounds_); }
    std::span<const BaseSums> bases(std::size_t p) const { return std::span(bases_).subspan(p * bounds_, bounds_); }
    std::size_t bounds() const { return bounds_; }

    void add(std::size_t to, const SumTable& from, std::size_t p) {
        assert(bounds_ == from.bounds_);
        parts_[to] += from.parts_[p];
        for (std::size_t b = 0; b < bounds_; ++b) bases_[to * bounds_ + b] += from.bases_[p * bounds_ + b];
    }

 private:
    std::size_t bounds_ = 0;
    std::vector<PartSums> parts_;
    std::vector<BaseSums> bases_;  // part by part
};

// A triangle whose corners lie in different slabs.
struct CrossedTriangle {
    std::uint32_t triangle;
    std::array<std::uint32_t, 3> node;  // per corner
    std::array<std::uint16_t, 3> slab;  // per corner: the number of offsets at or below it
    std::uint16_t low;                  // least and largest slab: the planes low .. high-1 cross it
    std::uint16_t high;
    std::uint32_t first_crossing;  // in Slabs::point and exit
    std::array<double, 3> height;
    double along;  // its share in the undercut along the normal: signed area, or 1 times the unit normal's cosine
    double volume;
};

inline TriangleCrossing crossing(const CrossedTriangle& c, std::size_t plane) {
    return triangle_crossing(c.slab[0] > plane, c.slab[1] > plane, c.slab[2] > plane);
}

struct Slabs {
    std::vector<std::uint16_t> node_slab;            // per node
    SumTable inside;                                 // per node: the triangles inside its slab
    SumTable above;                                  // per node: crossed triangles whose lowest corner it has
    SumTable below;                                  // per node: crossed triangles whose highest corner it has
    std::vector<std::array<std::uint32_t, 2>> ties;  // nodes that a crossed triangle has in common; some of them repeat
    std::vector<CrossedTriangle> crossed;            // patch by patch
    std::vector<Point2> point;                       // per crossing of a triangle: where its exit edge meets the plane
    std::vector<std::uint32_t> exit;     // per crossing: the half-edge through which the surface leaves downwards
    std::vector<std::uint32_t> node_of;  // per point
    std::size_t nodes() const { return node_slab.size(); }
};

// `offsets` ascending, none at a vertex's height.
Slabs slabs(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets);

// Adds a crossed triangle, or its part on one side, to a part's sums.
inline void add_part(SumTable& table, std::size_t part, const PreparedPiece& prepared, const CrossedTriangle& c,
                     double share, double faces) {
    PartSums& sums = table.part(part);
    sums.faces += faces;
    sums.volume += share * c.volume;
    sums.add_look((prepared.unit.empty() ? share : faces) * c.along);
    if (table.bounds() > 0) add_to_bases(table.bases(part), prepared, c.triangle, share, faces);
}

}  // namespace qchopper
