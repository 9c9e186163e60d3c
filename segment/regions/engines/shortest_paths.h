// Least costs of paths in a graph from one or several sources, each element going to its nearest source.
//
// The engine of all methods that grow regions from several seeds at once or measure how far elements are from
// representatives. E. Dijkstra, "A note on two problems in connexion with graphs" (1959). Ties go to the source and the
// element with the lower index (tests/segment/regions/shortest_paths_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "segment/regions/face_graph.h"

namespace qchopper {

struct Arc {
    std::uint32_t to = 0;
    double cost = 0;  // at least 0
};

// Arcs of element e: arcs[first[e]] up to arcs[first[e + 1]].
struct WeightedGraph {
    std::vector<std::uint32_t> first{0};
    std::vector<Arc> arcs;
    std::size_t size() const { return first.size() - 1; }
    std::span<const Arc> operator[](std::size_t element) const {
        return std::span(arcs).subspan(first[element], first[element + 1] - first[element]);
    }
};

// The triangles, with a cost per dual edge.
WeightedGraph weighted_faces(const FaceGraph& graph, std::span<const double> cost);

// The points, with the lengths of the edges, mm.
WeightedGraph weighted_points(const FaceGraph& graph);

constexpr std::uint32_t no_source = std::numeric_limits<std::uint32_t>::max();

struct ShortestPaths {
    std::vector<double> cost;           // infinite where no source reaches
    std::vector<std::uint32_t> source;  // its place in the list of sources, or no_source
    std::vector<std::uint32_t> order;   // the elements that are reached, by ascending cost
};

// `group`, if not empty, has a value per element: paths stay within the group of their source. O(arcs log elements).
ShortestPaths shortest_paths(const WeightedGraph& graph, std::span<const std::uint32_t> sources,
                             std::span<const std::uint32_t> group = {});

}  // namespace qchopper
