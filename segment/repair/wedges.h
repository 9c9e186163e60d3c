// Pairs the half-edges around an edge of many faces by the wedges of material that they bound.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace qchopper {

// `ring`: the half-edges in the order of their angles (around_edge in edge_groups.h). A face that runs down has
// material on its left, one that runs up on its right, so they match like brackets around the ring. Calls pair(down,
// up) for each match; where as many run up as down, all are matched. O(ring) (tests/segment/repair/balance_test.cpp,
// tests/segment/repair/split_non_manifold_test.cpp).
template <class RunsUp, class Pair>
void for_each_wedge(std::span<const std::uint32_t> ring, const RunsUp& runs_up, const Pair& pair) {
    std::vector<std::uint32_t> open;
    std::vector<std::uint32_t> closing;  // of brackets that open at the end of the ring
    for (const std::uint32_t h : ring) {
        if (!runs_up(h)) {
            open.push_back(h);
        } else if (open.empty()) {
            closing.push_back(h);
        } else {
            pair(open.back(), h);
            open.pop_back();
        }
    }
    for (const std::uint32_t h : closing) {
        if (open.empty()) return;
        pair(open.back(), h);
        open.pop_back();
    }
}

}  // namespace qchopper
