// The solids that the shells of a closed mesh bound.
//
// A solid is one outer shell together with the cavities in its material. A shell inside a cavity is a solid of its own
// (tests/segment/mesh/solids_test.cpp). mm.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/shells.h"

namespace qchopper {

// Links a cavity to the shell that encloses it: from its vertex that is farthest along a direction square to `axis`, a
// straight line in that direction meets the surface of the material around the cavity first. The line runs at one
// height along `axis`, so a cut square to it never comes between. Where the cavity touches another surface at that
// vertex, other directions are tried.
struct CavityLink {
    std::uint32_t cavity = 0;    // shell
    std::uint32_t vertex = 0;    // of the cavity
    std::uint32_t triangle = 0;  // where the line leaves the material
};

// One link for every negative shell, and for every one without volume; those with nothing around them have none: they
// are loose. `shells` are those of the mesh; the
// axis is not zero. One pass over the triangles, however many cavities there are; a few more if some touch other
// surfaces or have nothing around them.
std::vector<CavityLink> cavity_links(const TriangleMesh& mesh, const Shells& shells, Vec3 axis);

// Groups the shells of a closed mesh, each cavity by its link.
struct Solids {
    std::vector<std::uint32_t> solid_of_shell;
    std::size_t count = 0;
    std::size_t loose_cavities = 0;  // negative shells with nothing around them: inside out, kept as solids
};
Solids solids(const TriangleMesh& mesh, const Shells& shells, Vec3 axis);

// The same with the pairs of shells given that are one solid. Nothing is said of loose cavities.
Solids solids(const Shells& shells, std::span<const std::array<std::uint32_t, 2>> pairs);

// Per triangle the number of its solid.
std::vector<std::uint32_t> solid_of_triangle(const Shells& shells, const Solids& solids);

// The sub-meshes of the solids, in the order of their first triangle, triangles in the order of the input.
std::vector<TriangleMesh> split_solids(const TriangleMesh& mesh, Vec3 axis);
std::vector<TriangleMesh> split_solids(const TriangleMesh& mesh, const Shells& shells, const Solids& solids);

}  // namespace qchopper
