// Disjoint sets of numbers from 0.
//
// The root of a set is its smallest member, so results do not depend on the order in which sets were united; a parent
// is never larger than its child. Amortised O(log n) per operation. Trees after B. Galler and M. Fischer, "An improved
// equivalence algorithm" (1964); path halving after R. Tarjan and J. van Leeuwen, "Worst-case analysis of set union
// algorithms" (1984).

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

    // Adds a set of one member, and returns that.
    std::uint32_t add() {
        parent.push_back(static_cast<std::uint32_t>(parent.size()));
        return parent.back();
    }

    // The smallest member of the set of a.
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
