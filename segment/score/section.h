// The loops in which the planes of one normal cross the surface, without cutting it.
//
// Following the surface from crossing to crossing (slabs.h) closes the loops, which are all run clockwise around
// material seen against the normal.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/score/slabs.h"

namespace qchopper {

struct SectionLoop {
    std::uint16_t plane = 0;   // index of the offset
    std::uint32_t points = 0;  // number of crossings
    double area_mm2 = 0;       // signed: positive around material
    std::uint32_t node_above = 0;
    std::uint32_t node_below = 0;
    std::uint32_t first_crossing = 0;  // where it starts; Section::next goes on
};

struct Section {
    std::vector<std::uint32_t> next;      // per crossing: the one that follows on its loop
    std::vector<SectionLoop> loops;       // by plane, ascending
    std::vector<std::size_t> first_loop;  // per plane and one more
    SumTable above;                       // per loop: the parts of crossed triangles
    SumTable below;
};

// The piece must be closed.
Section find_section(const PreparedPiece& prepared, const Slabs& slabs, std::span<const double> offsets);

// A cap region of one plane: its loops (indices in Section::loops) and what a cut there would make of it.
struct SectionRegion {
    std::vector<std::size_t> loops;
    double area_mm2 = 0;
    double triangles = 0;  // N + 2L - 4
};
std::vector<SectionRegion> regions(const Section& section, const Slabs& slabs, std::size_t plane);

}  // namespace qchopper
