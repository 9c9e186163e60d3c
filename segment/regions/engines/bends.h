// How much the surface bends at each dual edge, for methods that seek parts: from normals that are smoothed first, so
// that noise does not count as bends.
//
// Tests: tests/segment/regions/bends_test.cpp.

#pragma once

#include <vector>

#include "segment/regions/face_graph.h"

namespace qchopper {

// One per dual edge.
struct Bends {
    std::vector<double> turn;              // radians, 0 to pi, between smoothed normals
    std::vector<std::uint8_t> is_concave;  // 1: they lean towards each other
};

// Each of so many rounds replaces a normal by the mean of its own and its neighbours', weighted by area. O(edges) each.
constexpr int smoothing_rounds = 3;
Bends bends(const FaceGraph& graph, int rounds = smoothing_rounds);

// eta (1 - cos turn) per dual edge, with eta = 1 where the surface is concave: the angular distance of S. Katz and A.
// Tal (2003).
constexpr double convex_eta = 0.15;
std::vector<double> angular_distances(const FaceGraph& graph);

// Per dual edge: the angle, or another measure of a bend, and the path, each in its mean; the path has this share.
std::vector<double> mixed_with_paths(const FaceGraph& graph, std::vector<double> bend, double path_share);

// The two together: the distance of neighbours of Katz and Tal.
constexpr double path_share_of_neighbours = 0.05;
std::vector<double> neighbour_distances(const FaceGraph& graph);

}  // namespace qchopper
