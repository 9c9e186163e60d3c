// A label per triangle: the region of the surface that it belongs to.
//
// Regions are numbered from 0 in the order of their first triangle, so that equal divisions are equal labels
// (tests/segment/regions/labels_test.cpp). No order of regions means anything else.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "segment/regions/face_graph.h"

namespace qchopper {

struct Labels {
    std::vector<std::uint32_t> of;  // one per triangle, below `count`
    std::size_t count = 0;
    bool operator==(const Labels&) const = default;
};

// One region per value. O(triangles) on average.
Labels numbered(const std::vector<std::uint32_t>& values);

// The same with each connected part of a region as a region of its own. O(triangles).
Labels connected(const FaceGraph& graph, const Labels& labels);

// The area of each region, mm2.
std::vector<double> region_areas(const FaceGraph& graph, const Labels& labels);

// Joins each region below a share of the area of all, the smallest first, to the neighbour with which it has the
// longest border. A region without a neighbour stays. O(edges log edges).
Labels without_small(const FaceGraph& graph, const Labels& labels, double min_share);

}  // namespace qchopper
