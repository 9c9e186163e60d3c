// The crossings of a plane's outline with the rows of a grid: what tells which of its points lie in the section, and in
// which region.
//
// mm, in the coordinates of Slabs::point. Row k lies at y = k x spacing.

#pragma once

#include <cstdint>
#include <vector>

#include "segment/objectives/sweep/section.h"

namespace qchopper {

struct RowCrossing {
    std::int32_t row = 0;
    double x = 0;
    std::uint32_t loop = 0;  // in Section::loops
};

// Of the loops of one plane that have regions, by row, then x. From an even number of crossings of a row to the next
// one the row lies in material. O(points of the loops + c log c) for c crossings.
std::vector<RowCrossing> row_crossings(const Section& section, const std::vector<SectionRegion>& regions,
                                       double spacing);

}  // namespace qchopper
