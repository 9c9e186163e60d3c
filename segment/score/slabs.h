// The slabs between the offsets of one normal, and the small graph of what hangs together in each of them.
//
// A node is a connected set of vertices in one slab. Triangles inside a slab are summed up in its node; a triangle that
// reaches over several slabs is kept aside as a straddler. One pass over the vertices and one over the triangles.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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
    std::span<double> row(std::size_t r) { return {cells.data() + r * width, width}; }
    std::span<const double> row(std::size_t r) const { return {cells.data() + r * width, width}; }
};

inline void add(std::span<double> to, std::span<const double> from) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
}

// A triangle whose corners lie in different slabs.
struct Straddler {
    std::uint32_t triangle;
    std::array<std::uint32_t, 3> node;  // per corner
    std::array<std::uint16_t, 3> slab;  // per corner: the number of offsets at or below it
    std::uint16_t low;                  // least and largest slab: the planes low .. high-1 cross it
    std::uint16_t high;
    std::uint32_t first_record;  // number of its first crossing (section.h)
    std::array<double, 3> height;
    double along;  // its share in the undercut along the normal: signed area, or 1 times the unit normal's cosine
    double volume;
};

struct Slabs {
    SumLayout layout;
    std::vector<double> height;            // per point
    std::vector<std::uint32_t> node_of;    // per point
    std::vector<std::uint16_t> node_slab;  // per node
    SumTable sums;                         // per node: the triangles inside its slab
    std::vector<Straddler> straddlers;     // in the order of their triangles
    std::uint32_t records = 0;             // crossings of all straddlers
    std::size_t nodes() const { return node_slab.size(); }
};

// `offsets` ascending, none at a vertex's height.
Slabs slabs(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets);

// Adds a triangle to the old bases of a row: `share` of its area, counted as `faces` triangles.
void add_to_bases(std::span<double> row, const PreparedPiece& prepared, std::uint32_t triangle, double share,
                  double faces);

// Adds a straddler, or its part on one side, to a row.
inline void add_part(std::span<double> row, const PreparedPiece& prepared, const Straddler& s, double share,
                     double faces) {
    const double along = (prepared.unit.empty() ? share : faces) * s.along;
    row[sum_faces] += faces;
    row[sum_volume] += share * s.volume;
    row[sum_up] += along > 0 ? along : 0;
    row[sum_down] += along < 0 ? -along : 0;
    if (row.size() > sum_base) add_to_bases(row, prepared, s.triangle, share, faces);
}

}  // namespace qchopper
