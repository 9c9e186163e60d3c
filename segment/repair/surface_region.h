// A small region of a mesh that is to be removed: how it grows, and its border loops.
//
// Tested with resolve.h (tests/segment/repair/resolve_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A mesh with its incidences: the twin of every half-edge and the triangles at every point. The mesh must outlive it
// and stay as it is.
struct MeshIncidence {
    const TriangleMesh& mesh;
    std::vector<std::uint32_t> twin;      // per half-edge (edges.h)
    std::vector<std::uint32_t> first_at;  // per point: where its triangles begin in `at`; one more at the end
    std::vector<std::uint32_t> at;        // triangles, ascending for each point

    explicit MeshIncidence(const TriangleMesh& whole);
    // Calls with(triangle) for all triangles that have this corner.
    template <class With>
    void for_each_at(std::uint32_t point, const With& with) const {
        for (std::uint32_t i = first_at[point]; i < first_at[point + 1]; ++i) with(at[i]);
    }
};

// A closed border of a region: the end of one half-edge of the region is the start of the next.
struct RegionLoop {
    std::vector<std::uint32_t> half_edges;
};

class SurfaceRegion {
 public:
    // `incidence` must outlive the region.
    SurfaceRegion(const MeshIncidence& incidence, const std::vector<std::uint32_t>& triangles);

    bool has(std::uint32_t triangle) const { return members_.contains(triangle); }
    const std::vector<std::uint32_t>& triangles() const { return triangles_; }

    // Adds all triangles that share a point with it.
    void grow();
    // Adds small parts of the surface that it cuts off, and the triangles around points that its border passes more
    // than once, until there are none.
    void tidy();

    // One border for every connected part. Nothing if the region reaches an open or non-manifold edge, or if a part has
    // no border or several: closing those would join what is separate.
    std::optional<std::vector<RegionLoop>> loops() const;

 private:
    void add(std::uint32_t triangle);
    // Both return whether they added a triangle.
    bool add_cut_off();
    bool add_non_manifold();
    bool is_border(std::uint32_t half_edge) const;
    // Half-edges whose twin is not in the region, in the order of the triangles.
    std::vector<std::uint32_t> border() const;

    const MeshIncidence& incidence_;
    std::vector<std::uint32_t> triangles_;
    std::unordered_set<std::uint32_t> members_;  // the same
};

}  // namespace qchopper
