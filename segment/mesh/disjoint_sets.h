// Disjoint sets of numbers (Galler and Fischer 1964; path halving after Tarjan and van Leeuwen 1984).
//
// The root of a set is its smallest member, so results do not depend on the order in which sets were united.

#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace qchopper {

struct DisjointSets {
    std::vector<std::uint32_t> parent;

    explicit DisjointSets(std::size_t size = 0) : parent(size) { std::iota(parent.begin(), parent.end(), 0U); }

    std::uint32_t add() {
        parent.push_back(static_cast<std::uint32_t>(parent.size()));
        return parent.back();
    }

    std::uint32_t root(std::uint32_t a) {
        assert(a < parent.size());
        while (parent[a] != a) a = parent[a] = parent[parent[a]];
        return a;
    }

    void unite(std::uint32_t a, std::uint32_t b) {
        assert(a < parent.size() && b < parent.size());
        if (parent[a] == parent[b]) return;  // most often, and without following parents
        a = root(a);
        b = root(b);
        if (a != b) parent[std::max(a, b)] = std::min(a, b);
    }
};

}  // namespace qchopper
