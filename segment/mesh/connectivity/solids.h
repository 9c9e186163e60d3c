// Groups the shells of a closed mesh to solids.
//
// mm. A solid is one outer shell together with the cavities in its material. A shell inside a cavity is a solid of its
// own (tests/segment/mesh/connectivity/solids_test.cpp). Precondition of all: the mesh is closed (edges.h), `shells`
// are those of the mesh, `solids` those of the shells, and the axis is not zero.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/connectivity/shells.h"

namespace qchopper {

// Links a cavity to its enclosing shell: from the vertex of the cavity that is farthest along a direction perpendicular
// to the axis, a straight line in that direction meets the surface of the material around the cavity first. The line
// runs at one height along the axis, so no plane perpendicular to the axis separates its ends. Where the cavity touches
// another surface at that vertex, other directions are tried.
struct CavityLink {
    std::uint32_t cavity = 0;    // a shell
    std::uint32_t vertex = 0;    // of the cavity: the start of the line
    std::uint32_t triangle = 0;  // where the line leaves the material
};

// One link for every shell of negative or no volume; none for those with nothing around them. Two passes over the
// triangles, however many cavities there are; up to twelve if some touch other surfaces or have nothing around them.
std::vector<CavityLink> cavity_links(const TriangleMesh& mesh, const Shells& shells, Vec3 axis);

struct Solids {
    std::vector<std::uint32_t> solid_of_shell;  // one per shell; numbered by their first shell
    std::size_t count = 0;
};
// Each cavity by its link. A negative shell with nothing around it, which is inside out, is a solid of its own.
Solids solids(const TriangleMesh& mesh, const Shells& shells, Vec3 axis);

// The same with the pairs of shells given that belong to one solid.
Solids solids(const Shells& shells, std::span<const std::array<std::uint32_t, 2>> pairs);

// One number per triangle: its solid.
std::vector<std::uint32_t> solid_of_triangle(const Shells& shells, const Solids& solids);

// One mesh per solid, in the order of their first triangle; triangles in the order of the input. A mesh of one solid
// keeps its points as well.
std::vector<TriangleMesh> split_solids(const TriangleMesh& mesh, Vec3 axis);
std::vector<TriangleMesh> split_solids(const TriangleMesh& mesh, const Shells& shells, const Solids& solids);

}  // namespace qchopper
