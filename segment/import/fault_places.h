// Where the faults of a scan are, a few places of each kind, so that they can be shown.
//
// In the unit and the coordinates of the mesh. Where a kind has more faults than max_places_of_kind, every n-th in the
// order of the mesh is taken, the first among them. Tests: tests/segment/import/fault_places_test.cpp.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "segment/mesh/connectivity/links.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

constexpr std::size_t max_places_of_kind = 100;

struct FaultPlaces {
    std::string kind;          // as the count is called in the document: "open_edges"
    std::vector<Vec3> points;  // 1 to max_places_of_kind
};

// Of `count` faults of which `place` gives the i-th place. `all` has no entry for a kind without faults.
void add_places(std::vector<FaultPlaces>& all, const char* kind, std::size_t count,
                const std::function<Vec3(std::size_t)>& place);

// An edge of two faces that run along it the same way, or of three faces or more.
struct IrregularEdge {
    std::uint32_t half_edge = 0;  // the first of them
    std::size_t up = 0;           // faces that run along it from the smaller point to the larger one
    std::size_t down = 0;
    bool is_inconsistent() const { return up + down == 2; }
    bool is_touching() const { return up == down; }  // solids that only touch
};
// In the order of their first half-edges. Precondition: `links` are those of the mesh. O(n log n) in the result.
std::vector<IrregularEdge> irregular_edges(const TriangleMesh& mesh, const Links& links);

// The middles of edges with one face, with two that run along it the same way, with three or more, and of those among
// them along which as many run one way as the other; points where surfaces only touch; centroids of triangles that have
// the corners of an earlier one. Precondition: `links` and `edges` are those of the mesh. O(n log n) in the triangles
// where any is repeated, else O(faults).
void add_link_places(std::vector<FaultPlaces>& all, const TriangleMesh& mesh, const Links& links,
                     const std::vector<IrregularEdge>& edges);

// The centroids of triangles with two corners in one point. Equal points need not be welded.
void add_collapsed_places(std::vector<FaultPlaces>& all, const TriangleMesh& mesh);

// Of triangles, their centroids.
void add_face_places(std::vector<FaultPlaces>& all, const char* kind, const TriangleMesh& mesh,
                     const std::vector<std::uint32_t>& triangles);

}  // namespace qchopper
