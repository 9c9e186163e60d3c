// A small piece of surface that is to be taken out of a mesh: how it grows, and the borders around it.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include "segment/mesh/edges.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A mesh with what its patches are asked about. The mesh must outlive it.
struct PatchSurroundings {
    const TriangleMesh& mesh;
    std::vector<std::uint32_t> twin;      // edges.h
    std::vector<std::uint32_t> first_at;  // per point: where its triangles begin in `at`; one more at the end
    std::vector<std::uint32_t> at;

    explicit PatchSurroundings(const TriangleMesh& whole);
    // Calls with(triangle) for all triangles that have this corner.
    template <class With>
    void for_each_at(std::uint32_t point, const With& with) const {
        for (std::uint32_t i = first_at[point]; i < first_at[point + 1]; ++i) with(at[i]);
    }
};

// A closed border of a patch: the end of one half-edge of the patch is the start of the next.
struct PatchLoop {
    std::vector<std::uint32_t> half_edges;
};

class SurfacePatch {
 public:
    SurfacePatch(const PatchSurroundings& surroundings, const std::vector<std::uint32_t>& triangles);

    bool has(std::uint32_t triangle) const { return members_.contains(triangle); }
    const std::vector<std::uint32_t>& triangles() const { return triangles_; }

    // Takes in all triangles that share a point with it.
    void grow();
    // Takes in small parts of the surface that it cuts off, and the triangles around points that its border passes
    // more than once, until there are none.
    void tidy();

    // One border for every connected part. Nothing if the patch reaches an open or non-manifold edge, or if a part has
    // no border or several: closing those would join what is apart.
    std::optional<std::vector<PatchLoop>> loops() const;

 private:
    void take(std::uint32_t triangle);
    bool takes_cut_off();
    bool takes_non_manifold();
    bool is_border(std::uint32_t half_edge) const;
    // Half-edges whose twin is not in the patch, in the order of the triangles.
    std::vector<std::uint32_t> border() const;

    const PatchSurroundings& around_;
    std::vector<std::uint32_t> triangles_;
    std::unordered_set<std::uint32_t> members_;  // the same
};

}  // namespace qchopper
