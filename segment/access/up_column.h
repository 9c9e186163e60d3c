// How far samples of a piece are open along the up direction of a base.
//
// The scan's table has it if up is one of its directions; otherwise rays are cast for it, one per sample, in parallel.

#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "segment/access/accessibility.h"
#include "segment/access/tool_directions.h"

namespace qchopper {

class UpColumn {
 public:
    // Both must outlive this. `up` is a unit vector.
    UpColumn(const SampledScan& scan, const PieceAccessibility& accessibility, Vec3 up)
        : accessibility_(accessibility), direction_(index_of(scan.directions, up)) {
        if (direction_ == scan.directions.size()) cast_ = PieceRays(scan, accessibility).distances(up);
    }
    // As PieceAccessibility::distance. `row` is an index of PieceAccessibility::sample.
    float distance(std::size_t row) const {
        return cast_.empty() ? accessibility_.distances(row)[direction_] : cast_[row];
    }
    bool is_open(std::size_t row) const { return std::isinf(distance(row)); }

 private:
    const PieceAccessibility& accessibility_;
    std::size_t direction_;    // of the scan, or the number of them
    std::vector<float> cast_;  // empty: the table is asked
};

}  // namespace qchopper
