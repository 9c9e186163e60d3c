// Finds the loops in which the planes of one normal cross the surface, without cutting it.
//
// mm. All loops run clockwise around material seen against the normal. A crossing is a triangle crossed by one plane;
// the crossings of Slabs are numbered triangle by triangle, plane by plane. Held to cutting by
// tests/segment/objectives/sweep/sweep_test.cpp.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/objectives/sweep/slabs.h"

namespace qchopper {

struct SectionLoop {
    std::uint16_t plane = 0;            // index of the offset
    std::uint32_t points = 0;           // number of crossings
    double area_mm2 = 0;                // signed: positive around material
    std::uint32_t component_above = 0;  // slab components (slabs.h) beside the loop
    std::uint32_t component_below = 0;
    std::uint32_t first = 0;  // its first crossing, in Section::order
};

struct Section {
    std::vector<std::uint32_t> order;     // the crossings, loop by loop as they follow each other
    std::vector<Point2> point;            // Slabs::point in this order: read one after the other, they cost least
    std::vector<SectionLoop> loops;       // by plane, ascending
    std::vector<std::size_t> first_loop;  // per plane, and one more at which the last one ends
    SumTable above;                       // per loop: the parts of crossed triangles
    SumTable below;

    std::span<const std::uint32_t> crossings(const SectionLoop& loop) const {
        return std::span(order).subspan(loop.first, loop.points);
    }
    std::span<const Point2> points(const SectionLoop& loop) const {
        return std::span(point).subspan(loop.first, loop.points);
    }
};

// Preconditions: the piece is closed; `slabs` made of the same offsets.
Section find_section(const PreparedPiece& prepared, const Slabs& slabs, std::span<const double> offsets);

// A cap region of one plane, as a cut there would make it.
struct SectionRegion {
    std::vector<std::size_t> loops;  // in Section::loops, the outer one first
    double area_mm2 = 0;
    double triangles = 0;                  // of its cap: N + 2L - 4 for N points on L loops
    std::array<std::uint32_t, 2> solid{};  // in CutEvaluation::solids, above and below; filled in by the sweep
};

// Loops of two points have no region, as in the cut (cap.cpp). `plane`: index of the offset.
std::vector<SectionRegion> regions(const Section& section, std::size_t plane);

// The sections of all planes of one normal.
struct SweptSections {
    Slabs slabs;
    Section section;
    std::vector<std::vector<SectionRegion>> regions;  // per plane
};

}  // namespace qchopper
