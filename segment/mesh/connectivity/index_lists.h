// Lists of indices, one after the other in one array: fans, loops, shells, half-edges of an edge.
//
// Invariant: `first` ascends from 0 to values.size(). Fewer than 2^32 values in all. Access is O(1).

#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace qchopper {

struct IndexLists {
    std::vector<std::uint32_t> values;
    std::vector<std::uint32_t> first{0};  // one per list, and the end of the last one

    std::size_t size() const { return first.size() - 1; }
    bool empty() const { return size() == 0; }
    std::span<const std::uint32_t> operator[](std::size_t list) const {
        assert(list < size());
        return std::span(values).subspan(first[list], first[list + 1] - first[list]);
    }
    // Makes a list of the values that were appended since the last call.
    void end_list() { first.push_back(static_cast<std::uint32_t>(values.size())); }

    struct Iterator {
        const IndexLists* lists;
        std::size_t at;
        std::span<const std::uint32_t> operator*() const { return (*lists)[at]; }
        Iterator& operator++() {
            ++at;
            return *this;
        }
        bool operator==(const Iterator&) const = default;
    };
    Iterator begin() const { return {this, 0}; }
    Iterator end() const { return {this, size()}; }
};

}  // namespace qchopper
