// Closes the open border loops of a mesh: small holes flat, adding no point, large ones with a faired fill.
//
// Existing points and triangles keep their order and their bits; the new ones come last, and new triangles get no_cap
// where the mesh has caps. The bunny of the Stanford scanning repository comes out with 69,664 faces
// (tests/segment/repair/fill_holes_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// How holes are closed.
enum class Fill {
    by_size,  // flat where no edge across the hole is longer than flat_chord_share, else fair
    flat,     // with triangles between the points of the border
    fair,     // refined to the density of the border and faired to continue the curvature of the surface around it
    none
};

struct FillOptions {
    Fill fill = Fill::by_size;
    double flat_chord_share = 0.1;  // of the diagonal of the mesh's box
};

// A border loop that was not closed.
struct OpenHole {
    Vec3 centre;  // mean of the points on its border
    std::size_t edges = 0;
};

struct FilledHoles {
    std::size_t filled = 0;
    std::size_t faired = 0;     // of these
    std::size_t triangles = 0;  // added
    std::size_t points = 0;     // added
    std::vector<OpenHole> left;
};

// Precondition: the mesh is manifold apart from its borders, and no border loop touches itself or another one in a
// point (split_non_manifold_vertices in manifold.h). Throws Cancelled, and then leaves the mesh as it was.
FilledHoles fill_holes(TriangleMesh& mesh, const FillOptions& options = {}, const Context& context = {});

// Triangles that close one loop of points in space, adding no point: those with the least dihedral angles and area (P.
// Liepa, "Filling holes in meshes", 2003, as in CGAL). Their corners are positions in the loop, ascending, so each
// triangle is oriented as the loop runs. beyond[i], one per point, is the third corner of the triangle on the other
// side of the edge from loop[i] to the next point. Empty if no surface is found.
std::vector<Triangle> fill_loop(const std::vector<Vec3>& loop, const std::vector<Vec3>& beyond);

}  // namespace qchopper
