// Rows of lines, each on one thread: crossings of the triangles over the row, sorted by line and height, give the
// intervals of the target. A line on an edge may be counted by both triangles or by none: rows and columns are shifted
// by a small irrational part of a cell, and a line with an odd number of crossings is left out. O(lines * (crossings +
// maps)).

#include "sim/replay/volumes.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_tree.h"
#include "sim/replay/hole_check.h"
#include "sim/replay/reach/reachable.h"

namespace qchopper {
namespace {

struct Grid {
    double x_min = 0;
    double y_min = 0;
    double cell = 1;
    std::int32_t columns = 0;
    std::int32_t rows = 0;
    double x(std::int32_t i) const { return x_min + (i + 0.5) * cell; }
    double y(std::int32_t j) const { return y_min + (j + 0.5) * cell; }
};

struct LineHeight {
    std::int32_t column = 0;
    double z = 0;
    bool operator<(const LineHeight& o) const { return column != o.column ? column < o.column : z < o.z; }
};

Grid grid_over(const ReplayScene& scene, const VolumeOptions& options) {
    const Box box = bounds(*scene.target);
    const Vec3 least{std::max(box.min.x - options.around, scene.block.min.x),
                     std::max(box.min.y - options.around, scene.block.min.y), 0};
    const Vec3 most{std::min(box.max.x + options.around, scene.block.max.x),
                    std::min(box.max.y + options.around, scene.block.max.y), 0};
    const double cell = options.cell;
    // Middles of cells as in stock_model.h, moved by less than half a thousandth of a cell.
    Grid grid{std::floor(least.x / cell) * cell + 0.000314159 * cell,
              std::floor(least.y / cell) * cell + 0.000271828 * cell, cell, 0, 0};
    grid.columns = static_cast<std::int32_t>(std::ceil((most.x - grid.x_min) / cell));
    grid.rows = static_cast<std::int32_t>(std::ceil((most.y - grid.y_min) / cell));
    return grid;
}

// Where a triangle crosses the lines of a row.
void cross(const std::array<Vec3, 3>& t, const Grid& grid, std::int32_t row, std::vector<LineHeight>& crossings) {
    const double y = grid.y(row);
    std::array<std::pair<double, double>, 2> ends;  // x and z where the plane of the row cuts the sides
    std::size_t found = 0;
    for (std::size_t k = 0; k < 3 && found < 2; ++k) {
        const Vec3 a = t[k];
        const Vec3 b = t[(k + 1) % 3];
        if ((a.y <= y) == (b.y <= y)) continue;
        // The same two points in the same order for both triangles of a side, so that both cut it at the same place.
        const bool in_order = std::tie(a.y, a.x, a.z) < std::tie(b.y, b.x, b.z);
        const Vec3 p = in_order ? a : b;
        const Vec3 q = in_order ? b : a;
        const double s = (y - p.y) / (q.y - p.y);
        ends[found++] = {p.x + s * (q.x - p.x), p.z + s * (q.z - p.z)};
    }
    if (found < 2) return;
    if (ends[0].first > ends[1].first) std::swap(ends[0], ends[1]);
    const auto first =
        std::max(0, static_cast<std::int32_t>(std::ceil((ends[0].first - grid.x_min) / grid.cell - 0.5)));
    for (std::int32_t i = first; i < grid.columns && grid.x(i) < ends[1].first; ++i) {
        const double s = (grid.x(i) - ends[0].first) / (ends[1].first - ends[0].first);
        crossings.push_back({i, ends[0].second + s * (ends[1].second - ends[0].second)});
    }
}

// Which squares of 1 mm lie within `around` of the projection, never one that lies farther.
class Zone {
 public:
    Zone(const TriangleMesh& mesh, const Grid& grid, double around) : x_min_(grid.x_min), y_min_(grid.y_min) {
        columns_ = static_cast<std::int32_t>(std::ceil(grid.columns * grid.cell / square)) + 1;
        rows_ = static_cast<std::int32_t>(std::ceil(grid.rows * grid.cell / square)) + 1;
        std::vector<bool> covered(static_cast<std::size_t>(columns_) * rows_, false);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) cover(corners_of(mesh, t), covered);
        is_in_.assign(covered.size(), false);
        const auto reach = std::max(0, static_cast<std::int32_t>(std::floor(around / square)) - 2);
        for (std::int32_t j = 0; j < rows_; ++j) {
            for (std::int32_t i = 0; i < columns_; ++i) {
                if (covered[index(i, j)]) spread(i, j, reach, covered);
            }
        }
    }
    bool has(double x, double y) const {
        const auto i = static_cast<std::int32_t>((x - x_min_) / square);
        const auto j = static_cast<std::int32_t>((y - y_min_) / square);
        return i >= 0 && j >= 0 && i < columns_ && j < rows_ && is_in_[index(i, j)];
    }

 private:
    static constexpr double square = 1;
    std::size_t index(std::int32_t i, std::int32_t j) const { return static_cast<std::size_t>(j) * columns_ + i; }
    // Squares in whose box a small triangle lies; of a large one those on a net of points.
    void cover(const std::array<Vec3, 3>& t, std::vector<bool>& covered) const {
        const double longest = std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
        const int n = static_cast<int>(std::ceil(longest / square)) + 1;
        for (int a = 0; a <= n; ++a) {
            for (int b = 0; b <= n - a; ++b) {
                const Vec3 p =
                    t[0] + (static_cast<double>(a) / n) * (t[1] - t[0]) + (static_cast<double>(b) / n) * (t[2] - t[0]);
                const auto i = static_cast<std::int32_t>(std::floor((p.x - x_min_) / square));
                const auto j = static_cast<std::int32_t>(std::floor((p.y - y_min_) / square));
                if (i >= 0 && j >= 0 && i < columns_ && j < rows_) covered[index(i, j)] = true;
            }
        }
    }
    void spread(std::int32_t i, std::int32_t j, std::int32_t reach, const std::vector<bool>& covered) {
        // Inside of the projection nothing is new but the square itself.
        const auto is_covered = [&](std::int32_t a, std::int32_t b) {
            return a >= 0 && b >= 0 && a < columns_ && b < rows_ && covered[index(a, b)];
        };
        is_in_[index(i, j)] = true;
        if (is_covered(i - 1, j) && is_covered(i + 1, j) && is_covered(i, j - 1) && is_covered(i, j + 1)) return;
        for (std::int32_t b = std::max(0, j - reach); b <= std::min(rows_ - 1, j + reach); ++b) {
            for (std::int32_t a = std::max(0, i - reach); a <= std::min(columns_ - 1, i + reach); ++a) {
                if ((a - i) * (a - i) + (b - j) * (b - j) <= reach * reach) is_in_[index(a, b)] = true;
            }
        }
    }
    double x_min_;
    double y_min_;
    std::int32_t columns_ = 0;
    std::int32_t rows_ = 0;
    std::vector<bool> is_in_;
};

// Parts of `from` that lie in none of `without`; both ascending and apart.
std::vector<Dexel> difference(const std::vector<Dexel>& from, const std::vector<Dexel>& without) {
    std::vector<Dexel> left;
    for (Dexel i : from) {
        for (const Dexel& w : without) {
            if (w.high <= i.low || w.low >= i.high) continue;
            if (w.low > i.low) left.push_back({i.low, w.low});
            i.low = w.high;
            if (i.low >= i.high) break;
        }
        if (i.low < i.high) left.push_back(i);
    }
    return left;
}

class Measuring {
 public:
    Measuring(const StockModel& stock_model, const ReplayScene& scene, const VolumeOptions& options,
              const Context& context)
        : stock_model_(stock_model),
          scene_(scene),
          options_(options),
          grid_(grid_over(scene, options)),
          zone_(*scene.target, grid_, options.around),
          tree_(*scene.target),
          holes_(scene),
          known_(scene, {closing_cell, options.around}),
          over_floor_(scene, {closing_cell, options.around, options.floor_clearance}) {
        for (std::size_t d = 0; d < milling_orientations(scene); ++d) {
            const std::vector<std::size_t> tools = tools_along(scene, d);
            for (const Closing* closing : known_.along(d, tools, context)) closings_.push_back(closing);
            if (scene.orientations[d].tool_axis.z < upright) continue;
            for (const Closing* closing : over_floor_.along(d, tools, context)) floor_closings_.push_back(closing);
        }
        by_row_.resize(static_cast<std::size_t>(grid_.rows));
        for (std::uint32_t t = 0; t < scene.target->triangles.size(); ++t) {
            const std::array<Vec3, 3> c = corners_of(*scene.target, t);
            const auto [low, high] = std::minmax({c[0].y, c[1].y, c[2].y});
            const auto first =
                std::max(0, static_cast<std::int32_t>(std::ceil((low - grid_.y_min) / grid_.cell - 0.5)));
            for (std::int32_t j = first; j < grid_.rows && grid_.y(j) <= high; ++j) by_row_[j].push_back(t);
        }
    }
    VolumeFigures of_row(std::int32_t row) const;
    std::int32_t rows() const { return grid_.rows; }

 private:
    static constexpr double closing_cell = 1;
    static constexpr double upright = 0.999;  // height of a unit vector along the tool axis: 2.6 degrees
    void add_line(double x, double y, const std::vector<Dexel>& target, VolumeFigures& sum) const;
    bool stands(Vec3 p) const;

    const StockModel& stock_model_;
    const ReplayScene& scene_;
    const VolumeOptions& options_;
    Grid grid_;
    Zone zone_;
    TriangleTree tree_;
    HoleSpace holes_;
    Closings known_;
    Closings over_floor_;
    std::vector<const Closing*> closings_;        // of what the tools of the program reach
    std::vector<const Closing*> floor_closings_;  // of what they do where they are upright, with a clearance
    std::vector<std::vector<std::uint32_t>> by_row_;
};

VolumeFigures Measuring::of_row(std::int32_t row) const {
    std::vector<LineHeight> crossings;
    for (const std::uint32_t t : by_row_[static_cast<std::size_t>(row)]) {
        cross(corners_of(*scene_.target, t), grid_, row, crossings);
    }
    std::sort(crossings.begin(), crossings.end());
    VolumeFigures sum;
    std::vector<Dexel> target;
    std::size_t next = 0;
    for (std::int32_t i = 0; i < grid_.columns; ++i) {
        target.clear();
        std::size_t end = next;
        while (end < crossings.size() && crossings[end].column == i) ++end;
        const bool is_whole = (end - next) % 2 == 0;
        for (; is_whole && next + 1 < end; next += 2) target.push_back({crossings[next].z, crossings[next + 1].z});
        next = end;
        if (is_whole && zone_.has(grid_.x(i), grid_.y(row))) add_line(grid_.x(i), grid_.y(row), target, sum);
    }
    return sum;
}

bool Measuring::stands(Vec3 p) const {
    if (p.z < options_.floor) return false;
    const std::vector<const Closing*>& closings = p.z < options_.oblique_floor ? floor_closings_ : closings_;
    const bool is_reached = std::any_of(closings.begin(), closings.end(), [&](const Closing* closing) {
        const SurfaceMap& map = closing->map;
        const Vec3 q = apply_inverse(map.frame_in_setup, p);
        // Above the closing, its cells beside that of q included, by more than what cells do not know.
        return q.z > map.highest_about(q.x, q.y) + closing_cell;
    });
    return is_reached && !tree_.is_any_nearer(*scene_.target, p, options_.standing);
}

void Measuring::add_line(double x, double y, const std::vector<Dexel>& target, VolumeFigures& sum) const {
    const double area = grid_.cell * grid_.cell;
    const double step = std::max(options_.gouge_tolerance, 0.25);
    const std::vector<Dexel> stock_model =
        stock_model_.on_line({x, y, 0}, {0, 0, 1}, scene_.block.min.z, scene_.block.max.z);
    const auto parts = [&](const Dexel& i, const auto& visit) {
        const auto count = static_cast<int>(std::ceil((i.high - i.low) / step));
        for (int k = 0; k < count; ++k) {
            visit(Vec3{x, y, i.low + (k + 0.5) * (i.high - i.low) / count}, area * (i.high - i.low) / count);
        }
    };
    for (Dexel i : difference(stock_model, target)) {
        i.low = std::max(i.low, 0.0);
        if (i.low >= i.high) continue;
        sum.leftover_mm3 += area * (i.high - i.low);
        parts({i.low, i.high}, [&](Vec3 p, double volume) {
            if (!stands(p)) return;
            sum.standing_mm3 += volume;
            sum.standing_at = p;
        });
    }
    for (const Dexel& i : difference(target, stock_model)) {
        if (holes_.is_empty()) sum.gouge_mm3 += area * (i.high - i.low);
        parts(i, [&](Vec3 p, double volume) {
            if (!holes_.is_empty()) {
                if (holes_.has(p)) return;
                sum.gouge_mm3 += volume;
            }
            if (!tree_.is_any_nearer(*scene_.target, p, options_.gouge_tolerance)) sum.beyond_mm3 += volume;
        });
    }
}

}  // namespace

VolumeFigures measure_volumes(const StockModel& stock_model, const ReplayScene& scene, const VolumeOptions& options,
                              const Context& context) {
    const Measuring measuring(stock_model, scene, options, context);
    std::vector<VolumeFigures> rows(static_cast<std::size_t>(measuring.rows()));
    constexpr std::size_t lot = 128;
    for (std::size_t first = 0; first < rows.size(); first += lot) {
        context.check_cancelled();
        context.progress("rows of the volume measured", first, rows.size());
        parallel_for(first, std::min(rows.size(), first + lot),
                     [&](std::size_t j) { rows[j] = measuring.of_row(static_cast<std::int32_t>(j)); });
    }
    VolumeFigures sum;
    for (const VolumeFigures& row : rows) {
        sum.leftover_mm3 += row.leftover_mm3;
        sum.gouge_mm3 += row.gouge_mm3;
        sum.beyond_mm3 += row.beyond_mm3;
        if (row.standing_mm3 > 0 && sum.standing_mm3 == 0) sum.standing_at = row.standing_at;
        sum.standing_mm3 += row.standing_mm3;
    }
    return sum;
}

}  // namespace qchopper
