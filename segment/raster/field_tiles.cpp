#include "segment/raster/field_tiles.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstdint>

#include "segment/raster/square_dilation.h"

namespace qchopper {

FieldTiles::FieldTiles(std::size_t columns, std::size_t rows)
    : columns_(columns),
      tile_columns_((columns + side - 1) / side),
      tile_rows_((rows + side - 1) / side),
      marked_(tile_columns_ * tile_rows_, 0) {}

void FieldTiles::add(std::size_t cell) {
    assert(tile_of(cell) < marked_.size());
    std::atomic_ref<std::uint8_t>(marked_[tile_of(cell)]).store(1, std::memory_order_relaxed);
}

FieldTiles FieldTiles::grown(std::size_t cells) const {
    FieldTiles wider = *this;
    wider.marked_ = dilate_by_square(std::move(wider.marked_), tile_columns_, tile_rows_, (cells + side - 1) / side);
    return wider;
}

FieldTiles FieldTiles::common(const FieldTiles& other) const {
    assert(columns_ == other.columns_ && tile_rows_ == other.tile_rows_);
    FieldTiles both = *this;
    for (std::size_t tile = 0; tile < marked_.size(); ++tile) {
        if (other.marked_[tile] == 0) both.marked_[tile] = 0;
    }
    return both;
}

bool FieldTiles::is_empty() const {
    return std::all_of(marked_.begin(), marked_.end(), [](std::uint8_t mark) { return mark == 0; });
}

std::vector<CellSpan> FieldTiles::spans(std::size_t row) const {
    std::vector<CellSpan> spans;
    const std::uint8_t* marks = &marked_[row / side * tile_columns_];
    for (std::size_t tile = 0; tile < tile_columns_; ++tile) {
        if (marks[tile] == 0) continue;
        const std::size_t end = std::min(columns_, (tile + 1) * side);
        if (!spans.empty() && spans.back().end == tile * side) {
            spans.back().end = end;
        } else {
            spans.push_back({tile * side, end});
        }
    }
    return spans;
}

}  // namespace qchopper
