// Row by row of the disc: each is a window of some width, and the largest value in it is the larger of those in two
// windows of a power of two that cover it (H. Yuan and M. J. Atallah, "Data structures for range minimum queries in
// multidimensional arrays", 2010). The windows of one row of the map are doubled in place, and are used for all rows of
// the disc of that size before the next doubling. O(cells * radius / cell).
//
// Marks are bits of words: a row is widened by one cell to each side at a time, and where it is as wide as rows of the
// disc it is united with the rows of the result that lie so far off.

#include "segment/raster/disc_dilation.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "segment/raster/cells_under.h"

namespace qchopper {
namespace {

constexpr double rounding = 1e-3;  // mm, of heights in single precision

struct DiscRow {
    std::ptrdiff_t row = 0;
    std::size_t half = 0;  // cells on each side of the middle
};

// By the largest power of two that fits into the row.
std::vector<std::vector<DiscRow>> disc_rows(double cells) {
    const auto reach = static_cast<std::ptrdiff_t>(cells);
    std::vector<std::vector<DiscRow>> rows(
        static_cast<std::size_t>(std::bit_width(2 * static_cast<unsigned>(reach) + 1)));
    for (std::ptrdiff_t row = -reach; row <= reach; ++row) {
        const auto across = static_cast<double>(row);
        const auto half = static_cast<std::size_t>(std::sqrt(std::max(0.0, cells * cells - across * across)));
        rows[static_cast<std::size_t>(std::bit_width(2 * half + 1)) - 1].push_back({row, half});
    }
    return rows;
}

}  // namespace

namespace {

// From the first cell of a row that is not lower than a height to the last one.
std::vector<CellSpan> spans_from(const HeightField& map, float from) {
    std::vector<CellSpan> spans(map.rows);
    parallel_for(0, map.rows, [&](std::size_t row) {
        const float* first = &map.height[row * map.columns];
        const float* last = first + map.columns;
        const auto is_high = [from](float height) { return height >= from; };
        const float* high = std::find_if(first, last, is_high);
        if (high == last) return;
        spans[row].first = static_cast<std::size_t>(high - first);
        while (!is_high(*(last - 1))) --last;
        spans[row].end = static_cast<std::size_t>(last - first);
    });
    return spans;
}

}  // namespace

HeightField dilate_by_disc(const HeightField& map, double radius, float from) {
    assert(radius >= 0);
    const double cells = radius / map.cell;
    const auto reach = static_cast<std::size_t>(cells);
    const std::vector<std::vector<DiscRow>> by_level = disc_rows(cells);
    const std::size_t columns = map.columns + 2 * reach;
    std::vector<float> window(columns * map.rows, HeightField::nothing);
    for (std::size_t row = 0; row < map.rows; ++row) {
        std::copy_n(&map.height[row * map.columns], map.columns, &window[row * columns + reach]);
    }
    const std::vector<CellSpan> spans = spans_from(map, from);
    HeightField highest = map;
    for (std::size_t level = 0; level < by_level.size(); ++level) {
        const std::size_t width = std::size_t{1} << level;
        parallel_for(0, map.rows, [&](std::size_t row) {
            float* own = &highest.height[row * map.columns];
            for (const DiscRow& part : by_level[level]) {
                const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(row) + part.row;
                if (at < 0 || at >= static_cast<std::ptrdiff_t>(map.rows)) continue;
                const auto source = static_cast<std::size_t>(at);
                const CellSpan& span = spans[source];
                if (span.first == span.end) continue;
                const float* first = &window[source * columns + reach - part.half];
                const float* last = first + (2 * part.half + 1 - width);
                const std::size_t end = std::min(map.columns, span.end + part.half);
                for (std::size_t c = span.first - std::min(span.first, part.half); c < end; ++c) {
                    own[c] = std::max({own[c], first[c], last[c]});
                }
            }
        });
        parallel_for(0, map.rows, [&](std::size_t row) {
            if (spans[row].first == spans[row].end) return;
            float* own = &window[row * columns];
            for (std::size_t c = 0; c + width < columns; ++c) own[c] = std::max(own[c], own[c + width]);
        });
    }
    return highest;
}

void raise_over_disc(HeightField& tip, const HeightField& map, double radius, double above, double lowest) {
    assert(tip.height.size() == map.height.size());
    const auto less = static_cast<float>(above);
    // A little more, for rounding.
    const HeightField highest = dilate_by_disc(map, radius, static_cast<float>(lowest + above - rounding));
    for (std::size_t i = 0; i < tip.height.size(); ++i) {
        tip.height[i] = std::max(tip.height[i], highest.height[i] - less);
    }
}

namespace {

using Words = std::vector<std::uint64_t>;
constexpr std::size_t word_bits = 64;

// Unites a row with another one that is shifted by so many cells to both sides; what leaves its words is left out.
void unite_shifted(Words& to, const Words& from, std::size_t cells) {
    const std::size_t words = cells / word_bits;
    const std::size_t bits = cells % word_bits;
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (i >= words) {
            to[i] |= from[i - words] << bits;
            if (bits > 0 && i > words) to[i] |= from[i - words - 1] >> (word_bits - bits);
        }
        if (i + words < from.size()) {
            to[i] |= from[i + words] >> bits;
            if (bits > 0 && i + words + 1 < from.size()) to[i] |= from[i + words + 1] << (word_bits - bits);
        }
    }
}

}  // namespace

CellMask marked_within(const CellMask& marks, std::size_t columns, std::size_t rows, double cells) {
    assert(marks.size() == columns * rows && cells >= 0);
    const std::size_t width = (columns + word_bits - 1) / word_bits;
    Words found(width * rows, 0);
    std::vector<DiscRow> by_half;
    for (const std::vector<DiscRow>& some : disc_rows(cells)) by_half.insert(by_half.end(), some.begin(), some.end());
    std::stable_sort(by_half.begin(), by_half.end(),
                     [](const DiscRow& a, const DiscRow& b) { return a.half < b.half; });
    const auto is_marked = [](std::uint8_t mark) { return mark != 0; };
    Words own(width);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::uint8_t* first = &marks[row * columns];
        const std::uint8_t* last = first + columns;
        const std::uint8_t* marked = std::find_if(first, last, is_marked);
        if (marked == last) continue;
        std::fill(own.begin(), own.end(), 0);
        for (; marked != last; marked = std::find_if(marked + 1, last, is_marked)) {
            const auto c = static_cast<std::size_t>(marked - first);
            own[c / word_bits] |= std::uint64_t{1} << (c % word_bits);
        }
        Words wide = own;
        std::size_t half = 0;
        for (const DiscRow& part : by_half) {
            while (half < part.half) unite_shifted(wide, own, ++half);
            const std::ptrdiff_t to = static_cast<std::ptrdiff_t>(row) + part.row;
            if (to < 0 || to >= static_cast<std::ptrdiff_t>(rows)) continue;
            std::uint64_t* words = &found[static_cast<std::size_t>(to) * width];
            for (std::size_t i = 0; i < width; ++i) words[i] |= wide[i];
        }
    }
    CellMask result(marks.size());
    parallel_for(0, rows, [&](std::size_t row) {
        for (std::size_t i = 0; i < width; ++i) {
            const std::uint64_t word = found[row * width + i];
            if (word == 0) continue;
            std::uint8_t* bytes = &result[row * columns + i * word_bits];
            const std::size_t count = std::min(word_bits, columns - i * word_bits);
            for (std::size_t c = 0; c < count; ++c) bytes[c] = static_cast<std::uint8_t>(word >> c & 1U);
        }
    });
    return result;
}

namespace {

// Visits the heights of cells within the radius of a place, that of its own cell first, as long as `wants_more`.
template <class Visit>
void visit_disc(const HeightField& map, double x, double y, double radius, const Visit& wants_more) {
    const double column = x / map.cell - 0.5;
    const double row = y / map.cell - 0.5;
    const double cells = radius / map.cell;
    const auto within = [](double value, std::size_t count) {
        return static_cast<std::ptrdiff_t>(std::clamp(value, 0.0, static_cast<double>(count)));
    };
    const double own_column = std::round(column);
    const double own_row = std::round(row);
    if (own_column >= 0 && own_row >= 0 && own_column < static_cast<double>(map.columns) &&
        own_row < static_cast<double>(map.rows) &&
        !wants_more(map.at(static_cast<std::size_t>(own_column), static_cast<std::size_t>(own_row)))) {
        return;
    }
    const std::ptrdiff_t end_row = within(std::floor(row + cells) + 1, map.rows);
    for (std::ptrdiff_t r = within(std::ceil(row - cells), map.rows); r < end_row; ++r) {
        const double across = static_cast<double>(r) - row;
        const double half = std::sqrt(std::max(0.0, cells * cells - across * across));
        const std::ptrdiff_t first = within(std::ceil(column - half), map.columns);
        const std::ptrdiff_t end = within(std::floor(column + half) + 1, map.columns);
        const float* heights = &map.height[static_cast<std::size_t>(r) * map.columns];
        for (std::ptrdiff_t c = first; c < end; ++c) {
            if (!wants_more(heights[c])) return;
        }
    }
}

}  // namespace

float dilation_at(const HeightField& map, double x, double y, double radius) {
    float highest = HeightField::nothing;
    visit_disc(map, x, y, radius, [&](float height) {
        highest = std::max(highest, height);
        return true;
    });
    return highest;
}

bool is_dilation_above(const HeightField& map, double x, double y, double radius, double height) {
    bool is_above = false;
    visit_disc(map, x, y, radius, [&](float own) {
        is_above = static_cast<double>(own) > height;
        return !is_above;
    });
    return is_above;
}

}  // namespace qchopper
