// Points inside of the piece are those in the spans of their columns (solid_lines.h). Maps take points away column by
// column, by the bits of words. O(triangles + crossings log crossings + points); 1 bit per point.

#include "cam/setup/stock_points.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "segment/raster/solid_lines.h"

namespace qchopper {
namespace {

constexpr std::size_t bits_per_word = 64;
constexpr double linear_cells = 3;  // largest difference, in cells, over which a surface is taken as linear

// The finalizer of splitmix64 (S. Vigna, public domain).
std::uint64_t mixed(std::uint64_t i) {
    i += 0x9e3779b97f4a7c15;
    i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9;
    i = (i ^ (i >> 27)) * 0x94d049bb133111eb;
    return i ^ (i >> 31);
}

// In 0..1, from 21 of the bits.
double fraction(std::uint64_t bits, int from) {
    return (static_cast<double>((bits >> from) & 0x1fffff) + 0.5) / 0x200000;
}

// The squares of a row of the grid that an interval may touch.
CellSpan squares(double low, double high, double step, std::size_t count) {
    const double most = static_cast<double>(count);
    const double first = std::clamp(std::floor(low / step), 0.0, most);
    const double end = std::clamp(std::floor(high / step) + 1, 0.0, most);
    return {static_cast<std::size_t>(first), static_cast<std::size_t>(end)};
}

// The value of a map at the cell that holds a place in cells, or `nothing` beside the map.
float nearest(const HeightField& map, double column, double row) {
    const std::optional<std::size_t> cell = map.cell_holding(column, row);
    return cell ? map.height[*cell] : HeightField::nothing;
}

// Between the middles of the four cells around a place in cells; `own`, that of the nearest, where they differ much.
double between(const HeightField& map, double column, double row, float own) {
    const double u = column - 0.5;
    const double v = row - 0.5;
    if (u < 0 || v < 0) return static_cast<double>(own);
    const auto c = static_cast<std::size_t>(u);
    const auto r = static_cast<std::size_t>(v);
    if (c + 1 >= map.columns || r + 1 >= map.rows) return static_cast<double>(own);
    const std::array<float, 4> h{map.at(c, r), map.at(c + 1, r), map.at(c, r + 1), map.at(c + 1, r + 1)};
    const auto [low, high] = std::minmax_element(h.begin(), h.end());
    if (!(static_cast<double>(*high) - static_cast<double>(*low) <= linear_cells * map.cell)) {
        return static_cast<double>(own);
    }
    const double x = u - static_cast<double>(c);
    const double y = v - static_cast<double>(r);
    return (1 - y) * ((1 - x) * static_cast<double>(h[0]) + x * static_cast<double>(h[1])) +
           y * ((1 - x) * static_cast<double>(h[2]) + x * static_cast<double>(h[3]));
}

// How many steps each side of a box is divided into for about `count` points. What is thinner than a step is one step,
// and the other sides have larger ones: else a thin box would have many more columns than points.
std::array<std::size_t, 3> steps_of(Vec3 size, double count) {
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return size[a] < size[b]; });
    std::array<std::size_t, 3> steps{1, 1, 1};
    const double least = size[order[0]];
    const double middle = size[order[1]];
    const double most = size[order[2]];
    double step = std::cbrt(least * middle * most / count);
    if (least < step) step = std::sqrt(middle * most / count);
    if (middle < step) step = most / count;
    for (int i = 0; i < 3; ++i) {
        steps[static_cast<std::size_t>(i)] = static_cast<std::size_t>(std::max(1.0, std::ceil(size[i] / step)));
    }
    return steps;
}

}  // namespace

StockPoints::StockPoints(const TriangleMesh& mesh, const Pose& piece_in_setup, const Box& box, std::size_t count)
    : piece_in_setup_(piece_in_setup), box_(box) {
    const Vec3 size = box.size();
    assert(is_consistent(mesh) && count > 0 && size.x > 0 && size.y > 0 && size.z > 0);
    counts_ = steps_of(size, static_cast<double>(count));
    step_ = {size.x / static_cast<double>(counts_[0]), size.y / static_cast<double>(counts_[1]),
             size.z / static_cast<double>(counts_[2])};
    words_ = (counts_[2] + bits_per_word - 1) / bits_per_word;

    struct Lines {
        const StockPoints& points;
        std::size_t columns;
        std::size_t rows;
        CellSpan columns_within(double low, double high) const { return squares(low, high, points.step_.x, columns); }
        CellSpan rows_within(double low, double high) const { return squares(low, high, points.step_.y, rows); }
        Point2 at(std::size_t column, std::size_t row) const {
            const Column at = points.column(row * columns + column);
            return {at.x - points.box_.min.x, at.y - points.box_.min.y};
        }
    };
    std::vector<Vec3> in_box;
    in_box.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) in_box.push_back(apply(piece_in_setup, p) - box.min);
    const SolidLines map = solid_lines(in_box, mesh.triangles, Lines{*this, counts_[0], counts_[1]});

    left_.assign(counts_[0] * counts_[1] * words_, 0);
    for (std::size_t index = 0; index < counts_[0] * counts_[1]; ++index) {
        const double start = column(index).start - box.min.z;
        const std::span<const SolidSpan> solid = map.at(index);
        auto next = solid.begin();
        for (std::size_t k = 0; k < counts_[2]; ++k) {
            const double z = start + static_cast<double>(k) * step_.z;
            while (next != solid.end() && next->high < z) ++next;
            if (next == solid.end() || !(next->low < z)) {
                left_[index * words_ + k / bits_per_word] |= std::uint64_t{1} << (k % bits_per_word);
            }
        }
    }
}

StockPoints::Column StockPoints::column(std::size_t index) const {
    const std::uint64_t bits = mixed(index);
    const std::size_t row = index / counts_[0];
    const auto x = static_cast<double>(index % counts_[0]);
    const auto y = static_cast<double>(row);
    return {box_.min.x + (x + fraction(bits, 0)) * step_.x, box_.min.y + (y + fraction(bits, 21)) * step_.y,
            box_.min.z + fraction(bits, 42) * step_.z};
}

// `surface` gives, for a place in cells and its height, the height of what is left there.
template <class Surface>
void StockPoints::mill_above(const HeightField& map, const Surface& surface) {
    const Pose setup_in_map = map.piece_in_field * inverse(piece_in_setup_);
    const Vec3 up = rotate(setup_in_map, {0, 0, step_.z});
    const double to_cells = 1 / map.cell;
    parallel_for(0, counts_[1], [&](std::size_t row) {
        for (std::size_t index = row * counts_[0]; index < (row + 1) * counts_[0]; ++index) {
            const Column at = column(index);
            const Vec3 first = apply(setup_in_map, {at.x, at.y, at.start});
            for (std::size_t word = 0; word < words_; ++word) {
                std::uint64_t& left = left_[index * words_ + word];
                for (std::uint64_t rest = left; rest != 0; rest &= rest - 1) {
                    const auto bit = static_cast<std::size_t>(std::countr_zero(rest));
                    const Vec3 p = first + static_cast<double>(word * bits_per_word + bit) * up;
                    if (p.z > surface(p.x * to_cells, p.y * to_cells, p.z)) left &= ~(std::uint64_t{1} << bit);
                }
            }
        }
    });
}

void StockPoints::mill(const HeightField& map) {
    const double near = linear_cells * map.cell;
    mill_above(map, [&](double column, double row, double z) {
        const float own = nearest(map, column, row);
        if (!(std::abs(z - static_cast<double>(own)) <= near)) return static_cast<double>(own);
        return between(map, column, row, own);
    });
}

void StockPoints::mill(const HeightField& map, const BallClosing& closing) {
    const double ratio = map.cell / closing.map->cell;
    const double near = linear_cells * map.cell;
    mill_above(map, [&](double column, double row, double z) {
        const float own = nearest(map, column, row);
        double height = static_cast<double>(own);
        if (z < height - near) return height;
        if (std::abs(z - height) <= near) height = between(map, column, row, own);
        // On a step of the surface a coarse cell holds both sides: the higher stays, the lower one is raised.
        const auto closed = static_cast<double>(nearest(*closing.closed, column * ratio, row * ratio));
        const auto open = static_cast<double>(nearest(*closing.map, column * ratio, row * ratio));
        if (!(closed > open)) return height;
        return std::min(std::max(height, closed), height + (closed - open));
    });
}

double StockPoints::volume_mm3() const {
    const std::size_t points =
        std::transform_reduce(left_.begin(), left_.end(), std::size_t{0}, std::plus<>(),
                              [](std::uint64_t word) { return static_cast<std::size_t>(std::popcount(word)); });
    return static_cast<double>(points) * step_.x * step_.y * step_.z;
}

std::vector<Point2> StockPoints::standing_up_to(double z) const {
    std::vector<Point2> standing;
    for (std::size_t index = 0; index < counts_[0] * counts_[1]; ++index) {
        const Column at = column(index);
        // The lowest point is asked always: it stands for what is below it too.
        const double steps = std::clamp((z - at.start) / step_.z, 0.0, static_cast<double>(counts_[2] - 1));
        const auto last = static_cast<std::size_t>(steps);
        std::size_t k = 0;
        while (k <= last && (left_[index * words_ + k / bits_per_word] >> (k % bits_per_word) & 1U) != 0) ++k;
        if (k > last) standing.push_back({at.x, at.y});
    }
    return standing;
}

}  // namespace qchopper
