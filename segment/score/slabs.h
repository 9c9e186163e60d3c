// The slabs between the offsets of one normal, and the small graph of what hangs together in each of them.
//
// A node is a connected set of vertices in one slab. Triangles inside a slab are summed up in its node, patch by patch
// where a whole patch lies in it; a triangle that reaches over several slabs is kept aside as a straddler.

#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/polygon_nesting.h"
#include "segment/score/prepared.h"

namespace qchopper {

// What is added up over the triangles of a part: faces, volume, and for the normal and every old base what looks up
// and what looks down, by area or by count. A row of doubles, so that merging parts is adding rows.
//   0 faces | 1 volume | 2 up, 3 down along the normal | per base b: 4+3b up, 5+3b down, 6+3b faces on its cap
struct SumLayout {
    std::size_t bases = 0;
    std::size_t width() const { return 4 + 3 * bases; }
};
constexpr std::size_t sum_faces = 0;
constexpr std::size_t sum_volume = 1;
constexpr std::size_t sum_up = 2;
constexpr std::size_t sum_down = 3;
constexpr std::size_t sum_base = 4;

// Rows of sums, one per node, loop or part.
struct SumTable {
    std::size_t width = 0;
    std::vector<double> cells;
    SumTable() = default;
    SumTable(std::size_t rows, std::size_t columns) : width(columns), cells(rows * columns, 0.0) {}
    std::span<double> row(std::size_t r) {
        assert((r + 1) * width <= cells.size());
        return {cells.data() + r * width, width};
    }
    std::span<const double> row(std::size_t r) const {
        assert((r + 1) * width <= cells.size());
        return {cells.data() + r * width, width};
    }
};

inline void add(std::span<double> to, std::span<const double> from) {
    assert(to.size() == from.size());
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
}

// A triangle whose corners lie in different slabs.
struct Straddler {
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

// How one plane crosses one straddler.
struct Crossing {
    std::size_t lone;  // the corner that is alone on its side
    bool lone_is_above;
    std::size_t exit;  // the half-edge (0..2) from above to below: it starts at the corner of this number
};

inline Crossing crossing(const Straddler& s, std::size_t plane) {
    const bool above[3] = {s.slab[0] > plane, s.slab[1] > plane, s.slab[2] > plane};
    Crossing c{};
    c.lone_is_above = above[0] + above[1] + above[2] == 1;
    while (above[c.lone] != c.lone_is_above) ++c.lone;
    assert(c.lone < 3);
    c.exit = c.lone_is_above ? c.lone : (c.lone + 2) % 3;
    return c;
}

struct Slabs {
    SumLayout layout;
    std::vector<std::uint16_t> node_slab;            // per node
    SumTable inside;                                 // per node: the triangles inside its slab
    SumTable above;                                  // per node: straddlers whose lowest corner it has
    SumTable below;                                  // per node: straddlers whose highest corner it has
    std::vector<std::array<std::uint32_t, 2>> ties;  // nodes that a straddler has in common; some of them repeat
    std::vector<Straddler> straddlers;               // patch by patch
    std::vector<Point2> point;                       // per crossing of a straddler: where its exit edge meets the plane
    std::vector<std::uint32_t> exit;     // per crossing: the half-edge through which the surface leaves downwards
    std::vector<std::uint32_t> node_of;  // per point
    std::size_t nodes() const { return node_slab.size(); }
};

// `offsets` ascending, none at a vertex's height.
Slabs slabs(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets);

// Adds a straddler, or its part on one side, to a row.
inline void add_part(std::span<double> row, const PreparedPiece& prepared, const Straddler& s, double share,
                     double faces) {
    const double along = (prepared.unit.empty() ? share : faces) * s.along;
    row[sum_faces] += faces;
    row[sum_volume] += share * s.volume;
    row[sum_up] += along > 0 ? along : 0;
    row[sum_down] += along < 0 ? -along : 0;
    if (row.size() > sum_base) add_to_bases(row.subspan(sum_base), prepared, s.triangle, share, faces);
}

}  // namespace qchopper
