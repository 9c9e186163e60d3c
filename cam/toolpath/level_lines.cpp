// Marching squares; where opposite corners of a square are low, they stay apart, so that no line crosses the ridge
// between them. The pieces of a level are joined by the sides of squares on which they end, each of which begins one
// piece and ends one.

#include "cam/toolpath/level_lines.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/parallel.h"

namespace qchopper {
namespace {

// A piece of a line in a square, between two sides. A side is numbered by the cell where it begins, times two, plus one
// if it runs along a column.
struct LinePiece {
    std::uint32_t level = 0;
    std::uint64_t from = 0;
    std::uint64_t to = 0;
};
using LinePieces = std::vector<LinePiece>;

struct LevelRange {
    const Levels& levels;
    std::size_t divisor;
    std::size_t remainder;

    // The first level that is wanted and not below a height.
    std::size_t not_below(double z) const {
        const double number = std::max(0.0, std::ceil((z - levels.first) / levels.step));
        const auto n = static_cast<std::size_t>(number);
        const std::size_t over = (n + divisor - remainder) % divisor;
        return over == 0 ? n : n + divisor - over;
    }
};

class SquareLines {
 public:
    SquareLines(const HeightMap& tip, const LevelRange& range) : tip_(tip), range_(range) {}

    void add(LinePieces& pieces, std::size_t column, std::size_t row) const {
        const std::size_t a = row * tip_.columns + column;
        const std::array<std::size_t, 4> cell{a, a + 1, a + 1 + tip_.columns, a + tip_.columns};
        const std::array<std::uint64_t, 4> side{2 * cell[0], 2 * cell[1] + 1, 2 * cell[3], 2 * cell[0] + 1};
        std::array<double, 4> z;
        for (std::size_t k = 0; k < 4; ++k) z[k] = static_cast<double>(tip_.height[cell[k]]);
        const double high = *std::max_element(z.begin(), z.end());
        for (std::size_t n = range_.not_below(*std::min_element(z.begin(), z.end())); range_.levels.height(n) < high;
             n += range_.divisor) {
            const double level = range_.levels.height(n);
            const auto is_high = [&](std::size_t k) { return z[k % 4] > level; };
            for (std::size_t k = 0; k < 4; ++k) {
                if (is_high(k) || !is_high(k + 3)) continue;  // here a run of low corners begins
                std::size_t last = k;
                while (!is_high(last + 1)) ++last;
                pieces.push_back({static_cast<std::uint32_t>(n), side[last % 4], side[(k + 3) % 4]});
            }
        }
    }

 private:
    const HeightMap& tip_;
    const LevelRange& range_;
};

// The middles of the two cells of a side.
struct SideEnds {
    std::size_t cell;
    std::size_t other;
    Point2 from;
    Point2 to;

    SideEnds(const HeightMap& tip, std::uint64_t side) : cell(side / 2) {
        const bool is_upright = side % 2 != 0;
        other = is_upright ? cell + tip.columns : cell + 1;
        from = middle(tip, cell);
        to = middle(tip, other);
    }
    Point2 at(double share) const { return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)}; }

 private:
    static Point2 middle(const HeightMap& tip, std::size_t cell) {
        const std::size_t row = cell / tip.columns;
        const std::size_t column = cell % tip.columns;
        return {(static_cast<double>(column) + 0.5) * tip.cell, (static_cast<double>(row) + 0.5) * tip.cell};
    }
};

// How the surface rises along the sides on which an edge is: the highest so far at steps from the lower end.
class FoundEdges {
 public:
    FoundEdges(const HeightMap& tip, const LinePieces& pieces, double jump, const TipDilation* tool) : tip_(tip) {
        if (tool == nullptr) return;
        for (const LinePiece& piece : pieces) {
            for (const std::uint64_t side : {piece.from, piece.to}) {
                const SideEnds ends(tip, side);
                if (std::abs(tip.height[ends.cell] - tip.height[ends.other]) > jump) sides_.push_back(side);
            }
        }
        std::sort(sides_.begin(), sides_.end());
        sides_.erase(std::unique(sides_.begin(), sides_.end()), sides_.end());
        rises_.resize(sides_.size());
        parallel_ranges(0, sides_.size(), sides_at_once, [&](std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i) rises_[i] = rise_along(sides_[i], *tool);
        });
    }

    // How far from the lower end, as a share, the surface is not above a height; nothing if the edge is not the tool's.
    std::optional<double> share_below(std::uint64_t side, double z) const {
        const auto found = std::lower_bound(sides_.begin(), sides_.end(), side);
        if (found == sides_.end() || *found != side) return std::nullopt;
        const Rise& rise = rises_[static_cast<std::size_t>(found - sides_.begin())];
        if (rise.empty()) return std::nullopt;
        const auto above = std::upper_bound(rise.begin(), rise.end(), static_cast<float>(z));
        return static_cast<double>(above - rise.begin()) / steps;
    }

 private:
    static constexpr std::size_t steps = 16;
    static constexpr std::size_t sides_at_once = 256;
    using Rise = std::vector<float>;  // at the steps from the first on, but for the last

    Rise rise_along(std::uint64_t side, const TipDilation& tool) const {
        const SideEnds ends(tip_, side);
        const bool is_up = tip_.height[ends.cell] < tip_.height[ends.other];
        // Holder or foam may keep the tip off anywhere between.
        if (!is_of_tool(tip_, tool, is_up ? ends.other : ends.cell)) return {};
        Rise rise;
        float highest = -std::numeric_limits<float>::infinity();
        for (std::size_t k = 1; k < steps; ++k) {
            const double share = static_cast<double>(k) / steps;
            const Point2 p = ends.at(is_up ? share : 1 - share);
            highest = std::max(highest, static_cast<float>(tool.height(p.x, p.y)));
            rise.push_back(highest);
        }
        return rise;
    }

    const HeightMap& tip_;
    std::vector<std::uint64_t> sides_;
    std::vector<Rise> rises_;
};

class LineJoiner {
 public:
    LineJoiner(const HeightMap& tip, double z, double jump, const FoundEdges& edges)
        : tip_(tip), z_(z), jump_(jump), edges_(edges) {}

    // Of the pieces of one level, sorted by where they begin.
    void join(std::size_t level, const LinePiece* first, const LinePiece* end, std::vector<LevelLine>& lines) const {
        const auto count = static_cast<std::size_t>(end - first);
        std::vector<std::uint8_t> is_used(count, 0);
        std::vector<std::uint8_t> has_before(count, 0);
        std::vector<std::size_t> next(count, count);
        for (std::size_t i = 0; i < count; ++i) {
            const LinePiece* found = std::lower_bound(
                first, end, first[i].to, [](const LinePiece& piece, std::uint64_t side) { return piece.from < side; });
            if (found == end || found->from != first[i].to) continue;
            next[i] = static_cast<std::size_t>(found - first);
            has_before[next[i]] = 1;
        }
        for (const bool is_closed : {false, true}) {
            for (std::size_t i = 0; i < count; ++i) {
                if (is_used[i] != 0 || (!is_closed && has_before[i] != 0)) continue;
                LevelLine line{level, {}, is_closed};
                add(line, first[i].from);
                for (std::size_t at = i; at < count && is_used[at] == 0; at = next[at]) {
                    is_used[at] = 1;
                    add(line, first[at].to);
                }
                if (is_closed && line.points.size() > 1 && line.points.front().at == line.points.back().at) {
                    line.points.pop_back();
                }
                if (line.points.size() >= (is_closed ? 3U : 2U)) lines.push_back(std::move(line));
            }
        }
    }

 private:
    void add(LevelLine& line, std::uint64_t side) const {
        const LevelPoint p = crossing(side);
        if (line.points.empty() || !(line.points.back().at == p.at)) line.points.push_back(p);
    }

    LevelPoint crossing(std::uint64_t side) const {
        const SideEnds ends(tip_, side);
        const double a = static_cast<double>(tip_.height[ends.cell]);
        const double b = static_cast<double>(tip_.height[ends.other]);
        if (std::abs(b - a) <= jump_) return {ends.at((z_ - a) / (b - a))};
        const std::optional<double> share = edges_.share_below(side, z_);
        const double from_low = share.value_or(0);
        return {ends.at(a < b ? from_low : 1 - from_low), !share, share.has_value()};
    }

    const HeightMap& tip_;
    double z_;
    double jump_;
    const FoundEdges& edges_;
};

}  // namespace

std::vector<LevelLine> level_lines(const HeightMap& tip, const CellMask& mask, const Levels& levels,
                                   std::size_t divisor, std::size_t remainder, double jump, const TipDilation* tool) {
    assert(levels.step > 0 && remainder < divisor && mask.size() == tip.height.size());
    if (tip.rows < 2 || tip.columns < 2) return {};
    const LevelRange range{levels, divisor, remainder};
    const SquareLines squares(tip, range);
    std::vector<LinePieces> by_row(tip.rows - 1);
    parallel_for(0, by_row.size(), [&](std::size_t row) {
        for (std::size_t c = 0; c + 1 < tip.columns; ++c) {
            if (mask[row * tip.columns + c] != 0) squares.add(by_row[row], c, row);
        }
    });
    LinePieces pieces;
    for (LinePieces& some : by_row) {
        pieces.insert(pieces.end(), some.begin(), some.end());
        LinePieces().swap(some);
    }
    std::sort(pieces.begin(), pieces.end(), [](const LinePiece& a, const LinePiece& b) {
        return a.level != b.level ? a.level < b.level : a.from < b.from;
    });
    const FoundEdges edges(tip, pieces, jump, tool);
    std::vector<std::size_t> begins;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (i == 0 || pieces[i].level != pieces[i - 1].level) begins.push_back(i);
    }
    begins.push_back(pieces.size());
    std::vector<std::vector<LevelLine>> by_level(begins.size() - 1);
    parallel_for(0, by_level.size(), [&](std::size_t i) {
        const std::size_t level = pieces[begins[i]].level;
        LineJoiner(tip, levels.height(level), jump, edges)
            .join(level, &pieces[begins[i]], pieces.data() + begins[i + 1], by_level[i]);
    });
    std::vector<LevelLine> lines;
    for (auto& some : by_level) std::move(some.begin(), some.end(), std::back_inserter(lines));
    return lines;
}

}  // namespace qchopper
