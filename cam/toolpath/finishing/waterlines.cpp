// Marching squares; where opposite corners of a square are low, they stay apart, so that no line crosses the ridge
// between them. The pieces of a level are joined by the sides of squares on which they end, each of which begins one
// piece and ends one. O(squares + crossings log crossings) a level.

#include "cam/toolpath/finishing/waterlines.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>

#include "base/parallel.h"

namespace qchopper {
namespace {

// A piece of a line in a square, between two sides (CellSide).
struct LinePiece {
    std::uint32_t level = 0;
    std::uint64_t from = 0;
    std::uint64_t to = 0;
};
using LinePieces = std::vector<LinePiece>;

struct WaterlineRange {
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
    SquareLines(const HeightField& cl, const WaterlineRange& range) : cl_(cl), range_(range) {}

    void add(LinePieces& pieces, std::size_t column, std::size_t row) const {
        const std::size_t a = row * cl_.columns + column;
        const std::array<std::size_t, 4> cell{a, a + 1, a + 1 + cl_.columns, a + cl_.columns};
        const std::array<std::uint64_t, 4> side{2 * cell[0], 2 * cell[1] + 1, 2 * cell[3], 2 * cell[0] + 1};
        std::array<double, 4> z;
        for (std::size_t k = 0; k < 4; ++k) z[k] = static_cast<double>(cl_.height[cell[k]]);
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
    const HeightField& cl_;
    const WaterlineRange& range_;
};

class LineJoiner {
 public:
    LineJoiner(const HeightField& cl, double z, double jump, const EdgeRises* edges)
        : cl_(cl), z_(z), jump_(jump), edges_(edges) {}

    // Of the pieces of one level, sorted by where they begin.
    void join(std::size_t level, const LinePiece* first, const LinePiece* end, std::vector<Waterline>& lines) const {
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
                Waterline line{level, {}, is_closed};
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
    void add(Waterline& line, std::uint64_t side) const {
        const WaterlinePoint p = crossing(side);
        if (line.points.empty() || !(line.points.back().at == p.at)) line.points.push_back(p);
    }

    WaterlinePoint crossing(std::uint64_t side) const {
        const CellSide ends(cl_, side);
        const double a = static_cast<double>(cl_.height[ends.cell]);
        const double b = static_cast<double>(cl_.height[ends.next]);
        if (std::abs(b - a) <= jump_) return {ends.at((z_ - a) / (b - a))};
        const std::optional<double> share = edges_ != nullptr ? edges_->share_below(side, z_) : std::nullopt;
        const double from_low = share.value_or(0);
        return {ends.at(a < b ? from_low : 1 - from_low), !share, share.has_value()};
    }

    const HeightField& cl_;
    double z_;
    double jump_;
    const EdgeRises* edges_;
};

}  // namespace

std::vector<Waterline> waterlines(const HeightField& cl, const CellMask& mask, const Levels& levels,
                                  std::size_t divisor, std::size_t remainder, double jump, const EdgeRises* edges) {
    assert(levels.step > 0 && remainder < divisor && mask.size() == cl.height.size());
    if (cl.rows < 2 || cl.columns < 2) return {};
    const WaterlineRange range{levels, divisor, remainder};
    const SquareLines squares(cl, range);
    std::vector<LinePieces> by_row(cl.rows - 1);
    parallel_for(0, by_row.size(), [&](std::size_t row) {
        for (std::size_t c = 0; c + 1 < cl.columns; ++c) {
            if (mask[row * cl.columns + c] != 0) squares.add(by_row[row], c, row);
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
    std::vector<std::size_t> begins;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (i == 0 || pieces[i].level != pieces[i - 1].level) begins.push_back(i);
    }
    begins.push_back(pieces.size());
    std::vector<std::vector<Waterline>> by_level(begins.size() - 1);
    parallel_for(0, by_level.size(), [&](std::size_t i) {
        const std::size_t level = pieces[begins[i]].level;
        LineJoiner(cl, levels.height(level), jump, edges)
            .join(level, &pieces[begins[i]], pieces.data() + begins[i + 1], by_level[i]);
    });
    std::vector<Waterline> lines;
    for (auto& some : by_level) std::move(some.begin(), some.end(), std::back_inserter(lines));
    return lines;
}

}  // namespace qchopper
