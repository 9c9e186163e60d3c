// How many of the offsets of planes are below a value: a table of cells of equal width leaves few to compare.

#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace qchopper {

class OffsetCounts {
 public:
    // They must outlive this. Precondition: there is one, and they ascend. O(offsets).
    explicit OffsetCounts(std::span<const double> offsets) : offsets_(offsets) {
        assert(!offsets.empty() && std::is_sorted(offsets.begin(), offsets.end()));
        const double range = offsets.back() - offsets.front();
        const std::size_t cells = cells_per_offset * offsets.size();
        low_ = offsets.front();
        last_ = static_cast<double>(cells - 1);
        scale_ = range > 0 ? last_ / range : 0;
        first_.assign(cells + 1, 0);
        for (const double offset : offsets) ++first_[static_cast<std::size_t>(cell(offset)) + 1];
        for (std::size_t c = 0; c < cells; ++c) first_[c + 1] += first_[c];
    }
    std::uint32_t at_most(double value) const {
        return count(cell(value), [value](double offset) { return offset <= value; });
    }
    std::uint32_t less_than(double value) const {
        return count(cell(value), [value](double offset) { return offset < value; });
    }
    // The same for many values. Both spans have the same size.
    void at_most(std::span<const double> values, std::span<std::uint32_t> result) const {
        many(values, result, [](double offset, double value) { return offset <= value; });
    }
    void less_than(std::span<const double> values, std::span<std::uint32_t> result) const {
        many(values, result, [](double offset, double value) { return offset < value; });
    }

 private:
    static constexpr std::size_t cells_per_offset = 16;

    // Never less for a larger value.
    std::int32_t cell(double value) const {
        return static_cast<std::int32_t>(std::min(std::max((value - low_) * scale_, 0.0), last_));
    }
    template <class Counts>
    std::uint32_t count(std::int32_t in, const Counts& counts) const {
        const auto c = static_cast<std::size_t>(in);
        std::uint32_t result = first_[c];
        while (result < first_[c + 1] && counts(offsets_[result])) ++result;
        return result;
    }
    template <class Counts>
    void many(std::span<const double> values, std::span<std::uint32_t> result, const Counts& counts) const {
        assert(values.size() == result.size());
        constexpr std::size_t at_once = 64;
        std::array<std::int32_t, at_once> cells;
        for (std::size_t first = 0; first < values.size(); first += at_once) {
            const std::size_t size = std::min(at_once, values.size() - first);
            for (std::size_t i = 0; i < size; ++i) cells[i] = cell(values[first + i]);
            for (std::size_t i = 0; i < size; ++i) {
                const double value = values[first + i];
                result[first + i] = count(cells[i], [&](double offset) { return counts(offset, value); });
            }
        }
    }

    std::span<const double> offsets_;
    double low_ = 0;
    double last_ = 0;  // cell
    double scale_ = 0;
    std::vector<std::uint32_t> first_;  // per cell: the offsets in earlier ones
};

}  // namespace qchopper
