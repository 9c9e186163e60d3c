// The cheapest set of edges that separates sources from sinks in an undirected graph.
//
// Tests: tests/segment/regions/minimum_cut_test.cpp, against all divisions of small graphs.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace qchopper {

struct CutEdge {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    double capacity = 0;  // above 0
};

struct MinimumCut {
    std::vector<bool> is_with_sources;  // one per element
    double weight = 0;                  // the capacities of all edges between the sides
};

// Precondition: no element is a source and a sink. With no source or no sink the weight is 0. Some O(edges) per path
// that is found, in practice a few times O(edges) in all.
MinimumCut minimum_cut(std::size_t elements, std::span<const CutEdge> edges, std::span<const std::uint32_t> sources,
                       std::span<const std::uint32_t> sinks);

}  // namespace qchopper
