// Which samples of a piece are open along the up direction of a base.
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
    // `row` is an index of PieceAccessibility::sample.
    bool is_open(std::size_t row) const {
        return cast_.empty() ? accessibility_.is_open(row, direction_) : std::isinf(cast_[row]);
    }

 private:
    const PieceAccessibility& accessibility_;
    std::size_t direction_;    // of the scan, or the number of them
    std::vector<float> cast_;  // empty: the table is asked
};

}  // namespace qchopper
