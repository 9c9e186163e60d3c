// Hierarchical clustering of the triangles of a mesh: the two neighbouring clusters that are cheapest to join are
// joined, until that costs too much or few enough are left.
//
// The engine of the methods that contract the dual graph; what a join costs is theirs (ClusterModel). Costs are kept in
// a heap over the dual edges. Those of clusters that have grown meanwhile are computed again only when they come to its
// top: exact where joining never makes a further join cheaper, otherwise such a join comes later than it might
// (tests/segment/regions/merging_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>

#include "segment/regions/labels.h"

namespace qchopper {

// What is common to two neighbouring clusters.
struct SharedBorder {
    double length = 0;  // mm
    double turn = 0;    // radians: the mean angle between the normals on both sides, weighted by length
};

class ClusterModel {
 public:
    virtual ~ClusterModel() = default;
    // Clusters are numbered as the triangles; a cluster has the number of one of its members.
    virtual double cost(std::uint32_t a, std::uint32_t b, const SharedBorder& border) const = 0;
    // b becomes part of a.
    virtual void join(std::uint32_t a, std::uint32_t b, const SharedBorder& border) = 0;
};

struct MergeLimits {
    double max_cost = 0;  // no join costs more
    std::size_t regions = 1;
    double max_turn = 0;  // radians: nor is a border of a larger mean angle removed
};

// O(edges log edges) joins and evaluations of costs, as long as clusters grow evenly.
Labels merge_faces(const FaceGraph& graph, ClusterModel& model, const MergeLimits& limits);

}  // namespace qchopper
