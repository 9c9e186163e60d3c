// The borders between the regions of a surface.
//
// Tests: tests/segment/regions/labels_test.cpp.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/regions/face_graph.h"

namespace qchopper {

// A connected part of the edges between two regions.
struct RegionBorder {
    std::array<std::uint32_t, 2> region{};  // ascending
    std::vector<std::uint32_t> edges;       // dual edges, ascending
};

// By the regions, then by the first edge; so parts of one border follow each other. `of` has a region per triangle.
// Edges that share a point are connected. O(edges log edges).
std::vector<RegionBorder> region_borders(const FaceGraph& graph, std::span<const std::uint32_t> of);

// The connected parts of edges between two regions, by the first edge of each. O(edges log edges).
std::vector<RegionBorder> connected_parts(const FaceGraph& graph, const RegionBorder& border);

}  // namespace qchopper
