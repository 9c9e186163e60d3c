// The rim is followed from side to side of cells with the region on the left, as border following does (S. Suzuki and
// K. Abe, "Topological structural analysis of digitized binary images by border following", 1985); cells that touch at
// a corner alone are apart. Each side stands for the middle of its cell. Points are left out as long as the line
// between those that stay is near to all that it replaces, and passes through cells of the region only or nearer still:
// along an oblique wall cells go in steps, and a tool that follows each of them has a corner every two millimetres.
// O(cells + points * points of a line).

#include "cam/toolpath/roughing_passes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace qchopper {
namespace {

constexpr double max_beside = 0.75;        // cells by which a line may pass beside a point that is left out
constexpr std::size_t max_left_out = 200;  // points in a line

struct CellPlace {
    std::ptrdiff_t column = 0;
    std::ptrdiff_t row = 0;
    bool operator==(const CellPlace&) const = default;
};

// Sides of a cell, counter-clockwise from below: the way along each, and the way out across it.
constexpr std::array<CellPlace, 4> along{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
constexpr std::array<CellPlace, 4> across{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

CellPlace operator+(CellPlace a, CellPlace b) {
    return {a.column + b.column, a.row + b.row};
}

class Rims {
 public:
    explicit Rims(const LevelRegion& region) : region_(region), is_done_(region.columns * region.rows, 0) {}

    // Closed, the first cell not repeated.
    std::vector<std::vector<CellPlace>> all() {
        std::vector<std::vector<CellPlace>> rims;
        for (std::size_t i = 0; i < is_done_.size(); ++i) {
            if (region_.is_allowed[i] == 0) continue;
            const CellPlace cell{static_cast<std::ptrdiff_t>(i % region_.columns),
                                 static_cast<std::ptrdiff_t>(i / region_.columns)};
            for (std::size_t side = 0; side < 4; ++side) {
                if (!is_in(cell + across[side]) && (is_done_[i] >> side & 1) == 0) rims.push_back(from(cell, side));
            }
        }
        return rims;
    }

 private:
    bool is_in(CellPlace cell) const { return region_.allowed(cell.column, cell.row); }

    std::uint8_t& done(CellPlace cell) {
        return is_done_[static_cast<std::size_t>(cell.row) * region_.columns + static_cast<std::size_t>(cell.column)];
    }

    std::vector<CellPlace> from(CellPlace cell, std::size_t side) {
        std::vector<CellPlace> rim;
        while ((done(cell) >> side & 1) == 0) {
            done(cell) = static_cast<std::uint8_t>(done(cell) | 1U << side);
            if (rim.empty() || rim.back() != cell) rim.push_back(cell);
            const CellPlace ahead = cell + along[side];
            if (!is_in(ahead)) {
                side = (side + 1) % 4;
            } else if (!is_in(ahead + across[side])) {
                cell = ahead;
            } else {
                cell = ahead + across[side];
                side = (side + 3) % 4;
            }
        }
        if (rim.size() > 1 && rim.front() == rim.back()) rim.pop_back();
        return rim;
    }

    const LevelRegion& region_;
    std::vector<std::uint8_t> is_done_;  // a bit per side
};

// Whether the line between the middles of two cells passes through allowed cells only.
bool is_line_in(const LevelRegion& region, CellPlace a, CellPlace b) {
    const auto columns = static_cast<double>(b.column - a.column);
    const auto rows = static_cast<double>(b.row - a.row);
    const auto samples = static_cast<std::size_t>(4 * std::max(std::abs(columns), std::abs(rows))) + 1;
    for (std::size_t i = 1; i < samples; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(samples);
        if (!region.allowed(a.column + std::lround(t * columns), a.row + std::lround(t * rows))) return false;
    }
    return true;
}

double distance_to_line(CellPlace p, CellPlace a, CellPlace b) {
    const auto x = static_cast<double>(b.column - a.column);
    const auto y = static_cast<double>(b.row - a.row);
    const auto u = static_cast<double>(p.column - a.column);
    const auto v = static_cast<double>(p.row - a.row);
    const double square = x * x + y * y;
    const double t = square > 0 ? std::clamp((u * x + v * y) / square, 0.0, 1.0) : 0;
    return std::hypot(u - t * x, v - t * y);
}

// The cells between are neighbours in their order, so that no place of the line is farther from them than they are.
bool is_line_near(const LevelRegion& region, const std::vector<CellPlace>& cells, std::size_t first, std::size_t last) {
    double farthest = 0;
    for (std::size_t i = first + 1; i < last; ++i) {
        farthest = std::max(farthest, distance_to_line(cells[i], cells[first], cells[last]));
    }
    if (farthest * region.cell <= region.beside) return true;
    return farthest <= max_beside && is_line_in(region, cells[first], cells[last]);
}

std::vector<CellPlace> reduced(const LevelRegion& region, const std::vector<CellPlace>& cells) {
    std::vector<CellPlace> kept{cells.front()};
    std::size_t first = 0;
    while (first + 1 < cells.size()) {
        std::size_t last = first + 1;
        while (last + 1 < cells.size() && last - first < max_left_out && is_line_near(region, cells, first, last + 1)) {
            ++last;
        }
        kept.push_back(cells[last]);
        first = last;
    }
    return kept;
}

class RoughingPasses {
 public:
    RoughingPasses(const LevelRegion& region, double height) : region_(region), height_(height) {}

    void add_rims() {
        Rims rims(region_);
        for (std::vector<CellPlace>& rim : rims.all()) {
            const auto outside = std::find_if(rim.begin(), rim.end(), [&](CellPlace cell) { return !wanted(cell); });
            if (outside == rim.end()) {
                if (rim.size() == 2) add(rim, false);
                if (rim.size() < 3) continue;
                rim.push_back(rim.front());
                add(rim, true);
                continue;
            }
            std::rotate(rim.begin(), outside, rim.end());
            add_wanted(rim);
        }
    }

    // Along whichever axis of the map has fewer of them.
    void add_rows(std::ptrdiff_t step) {
        std::vector<Row> rows = rows_along(step, false);
        std::vector<Row> turned = rows_along(step, true);
        if (turned.size() < rows.size()) rows = std::move(turned);
        for (const Row& row : rows) push({row.first, row.last}, false);
    }

    std::vector<Pass> take() { return std::move(passes_); }

 private:
    struct Row {
        CellPlace first;
        CellPlace last;
    };

    bool wanted(CellPlace cell) const { return region_.wanted(cell.column, cell.row); }

    std::vector<Row> rows_along(std::ptrdiff_t step, bool is_turned) const {
        const auto columns = static_cast<std::ptrdiff_t>(is_turned ? region_.rows : region_.columns);
        const auto count = static_cast<std::ptrdiff_t>(is_turned ? region_.columns : region_.rows);
        const auto cell = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
            return is_turned ? CellPlace{row, column} : CellPlace{column, row};
        };
        std::vector<Row> rows;
        // The first row lies in the middle of a step, so that the rim and it are not at the same place.
        for (std::ptrdiff_t row = step / 2; row < count; row += step) {
            std::ptrdiff_t first = 0;
            for (std::ptrdiff_t column = 0; column <= columns; ++column) {
                if (column < columns && wanted(cell(column, row))) continue;
                if (column - first > 1) rows.push_back({cell(first, row), cell(column - 1, row)});
                first = column + 1;
            }
        }
        return rows;
    }

    void add_wanted(const std::vector<CellPlace>& cells) {
        std::vector<CellPlace> part;
        for (const CellPlace cell : cells) {
            if (wanted(cell)) {
                part.push_back(cell);
                continue;
            }
            if (part.size() > 1) add(part, false);
            part.clear();
        }
        if (part.size() > 1) add(part, false);
    }

    void add(const std::vector<CellPlace>& cells, bool is_closed) { push(reduced(region_, cells), is_closed); }

    void push(const std::vector<CellPlace>& corners, bool is_closed) {
        Pass pass;
        pass.is_closed = is_closed;
        for (const CellPlace cell : corners) {
            pass.points.push_back({{region_.cell * (static_cast<double>(cell.column) + 0.5),
                                    region_.cell * (static_cast<double>(cell.row) + 0.5), height_},
                                   true});
        }
        if (pass.points.size() >= 2) passes_.push_back(std::move(pass));
    }

    const LevelRegion& region_;
    double height_;
    std::vector<Pass> passes_;
};

}  // namespace

std::vector<Pass> roughing_passes(const LevelRegion& region, double height, double step) {
    RoughingPasses passes(region, height);
    passes.add_rims();
    passes.add_rows(std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(step / region.cell)));
    return passes.take();
}

}  // namespace qchopper
