// Grey dilation and erosion of a surface by a tool that stands upright on it (J. Serra: Image Analysis and Mathematical
// Morphology, 1982).
//
// mm. Heights at the centres of cells; what lies beyond the map is not asked. The result does not depend on the number
// of threads (tests/sim/replay/reach/cutter_morphology_test.cpp).

#pragma once

#include <cstdint>
#include <vector>

#include "sim/replay/reach/surface_map.h"
#include "sim/replay/stock/cutter.h"
#include "sim/replay/stock/dexel_map.h"

namespace qchopper {

// Some of the cells of a map, in blocks of 32 x 8.
class CellBlocks {
 public:
    static constexpr std::int32_t wide = 32;
    static constexpr std::int32_t high = 8;

    // None of the cells.
    explicit CellBlocks(const SurfaceMap& map);
    static CellBlocks all_of(const SurfaceMap& map);

    // Some of the cells may lie beyond the map.
    void add(CellRange cells);
    // These and all that are at most so many cells from one of them, along both sides.
    CellBlocks grown(std::int32_t cells) const;
    bool has(std::int32_t column, std::int32_t row) const {
        return is_in_[static_cast<std::size_t>(row / high) * columns_ + column / wide] != 0;
    }

 private:
    std::int32_t columns_ = 0;
    std::int32_t rows_ = 0;
    std::vector<std::uint8_t> is_in_;
};

// The least heights at which the tip may stand, of the cells asked for; no_surface elsewhere. O(cells * (radius /
// cell)^2) at most, a fifth of it on smooth surfaces.
std::vector<float> dilated(const SurfaceMap& map, const Cutter& cutter, const CellBlocks& asked);

// The lowest surface that is left where tips stand on a map, of the cells asked for; -no_surface elsewhere. The same
// cost.
std::vector<float> eroded(const SurfaceMap& map, const Cutter& cutter, const CellBlocks& asked);

}  // namespace qchopper
