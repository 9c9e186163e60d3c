// Says what a scan is and what is wrong with it, without mending anything.
//
// Lengths are in the file's own unit. Bad meshes are described, not refused (tests/segment/intake/inspect_test.cpp).
// Everything but the first five counts is taken after equal points are welded, so that STL and PLY compare.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "segment/intake/read_mesh.h"
#include "segment/mesh/measure.h"

namespace qchopper {

// A border loop: where the surface is open.
struct BorderLoop {
    Vec3 centre;  // mean of its points
    std::size_t edges = 0;
};

struct Inspection {
    MeshFormat format = MeshFormat::ply_ascii;
    std::size_t faces_in_file = 0;  // polygons count once
    std::size_t points_in_file = 0;
    std::size_t faces_without_area = 0;  // fewer than three corners
    std::size_t triangles_in_file = 0;   // after polygons are split

    std::size_t triangles = 0;     // without the collapsed ones
    std::size_t vertices = 0;      // without the unreferenced ones
    std::size_t welded = 0;        // points equal to an earlier one
    std::size_t collapsed = 0;     // triangles with two corners in one point
    std::size_t unreferenced = 0;  // points in no triangle
    std::size_t no_area = 0;       // triangles with three different corners on one line
    Box box;                       // of the points in use
    std::size_t shells = 0;
    std::size_t cavities = 0;       // closed shells with negative volume inside another shell
    std::size_t inside_out = 0;     // closed shells with negative volume and nothing around them
    std::size_t open_edges = 0;     // edges of one triangle
    std::size_t inconsistent = 0;   // edges that both triangles run the same way
    std::size_t non_manifold = 0;   // edges of three triangles or more
    std::size_t pinched = 0;        // points where surfaces only touch
    std::vector<BorderLoop> holes;  // in order of their first edge
    double volume = 0;              // signed, file unit cubed; means something only when closed
    double area = 0;                // file unit squared
    bool is_closed() const { return open_edges == 0 && inconsistent == 0 && non_manifold == 0; }
};

Inspection inspect(const RawMesh& scan);

// "1.82 m x 0.94 m x 0.71 m": all in the unit that suits the longest, which gets three digits.
std::string size_in_words(Vec3 size_mm);

}  // namespace qchopper
