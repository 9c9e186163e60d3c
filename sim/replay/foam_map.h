// The map of one direction of foam.h, and the columns of foam in it.

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "base/box.h"
#include "base/pose.h"
#include "sim/replay/foam.h"

namespace qchopper {

struct FoamTile {
    static constexpr std::int32_t side = 64;
    static constexpr std::size_t cells = static_cast<std::size_t>(side) * side;
    struct Below {
        std::uint32_t cell = 0;
        float low = 0;
        float high = 0;
    };
    std::vector<float> cut = std::vector<float>(cells, std::numeric_limits<float>::infinity());
    // The highest interval of each column; low >= high: none is left.
    std::vector<float> low, high;
    std::vector<Below> below;  // further ones, by cell, of each cell the highest last
    float least_cut = std::numeric_limits<float>::infinity();
    std::uint64_t version = 0;  // of the other maps when the columns were made; 0: not made
    // Highest foam of each square of 16 x 16 cells; too high is allowed.
    std::array<float, 16> top{};
};

// Cells of a half-open range.
struct CellRange {
    std::int32_t x_begin = 0;
    std::int32_t x_end = 0;
    std::int32_t y_begin = 0;
    std::int32_t y_end = 0;
};

class FoamMap {
 public:
    FoamMap(const Box& block, Vec3 out, double cell);

    CellRange range(double x_min, double x_max, double y_min, double y_max) const;
    double middle_x(std::int32_t i) const { return x_min_ + (i + 0.5) * cell_; }
    double middle_y(std::int32_t j) const { return y_min_ + (j + 0.5) * cell_; }
    const FoamTile* tile(std::int32_t tx, std::int32_t ty) const { return tiles_[index(tx, ty)].get(); }
    FoamTile& made_tile(std::int32_t tx, std::int32_t ty);
    std::int32_t tiles_x() const { return tiles_x_; }
    std::int32_t tiles_y() const { return tiles_y_; }
    // Height to which the cell of a point is cleared; infinite outside.
    float cut_at(double x, double y) const;
    // Takes from the intervals what was removed along this direction. The line is from + t * along, in this frame.
    void remove_from(std::vector<Interval>& intervals, Vec3 from, Vec3 along) const;
    // Distance from a point of this frame to the nearest removed point of it, at most `most`.
    double distance_to_removed(Vec3 point, double most) const;
    // Where the line meets the block; empty if it does not.
    Interval block_on(Vec3 from, Vec3 along) const;

    Pose frame_in_block;
    Box block;
    double top = 0;             // of the block in this frame
    std::uint64_t version = 1;  // grows with every change

 private:
    std::size_t index(std::int32_t tx, std::int32_t ty) const { return static_cast<std::size_t>(ty) * tiles_x_ + tx; }

    double cell_;
    double x_min_ = 0;
    double y_min_ = 0;
    std::int32_t tiles_x_ = 0;
    std::int32_t tiles_y_ = 0;
    std::vector<std::unique_ptr<FoamTile>> tiles_;
};

}  // namespace qchopper
