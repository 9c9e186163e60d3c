// The shells of a mesh (connected surfaces) and the solids that they bound.
//
// A solid is one outer shell together with the cavities in its material. A shell inside a cavity is a solid of
// its own (tests/segment/mesh/shells_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

constexpr std::size_t triangles_per_block = 128;

// Triangles that share a vertex belong to one shell. Shells are numbered by their first triangle.
struct Shells {
    std::vector<std::uint32_t> shell_of;  // per triangle
    std::vector<double> volume;           // per shell, signed mm3; negative: a cavity, or turned inside out
    std::vector<Box> box;                 // per shell
    std::vector<Box> block;               // per triangles_per_block consecutive triangles: to pass over many at once
    std::size_t count() const { return volume.size(); }
};
Shells shells(const TriangleMesh& mesh);

// Ties a cavity to the material around it: from its vertex that is farthest along a direction square to `axis`, a
// straight line in that direction meets the surface of that material first. The line runs at one height along `axis`,
// so a cut square to it never comes between. Where the cavity touches another surface at that vertex, other directions
// are tried.
struct Tether {
    std::uint32_t cavity = 0;    // shell
    std::uint32_t vertex = 0;    // of the cavity
    std::uint32_t triangle = 0;  // where the line leaves the material
};

// One tether for every negative shell, and for every one without volume; those with nothing around them have none: they
// are loose. One pass over the triangles, however many cavities there are; a few more if some touch other surfaces or
// are loose.
std::vector<Tether> tethers(const TriangleMesh& mesh, const Shells& shells, Vec3 axis);

// Groups the shells of a closed mesh into solids, each cavity by its tether.
struct Solids {
    std::vector<std::uint32_t> solid_of_shell;
    std::size_t count = 0;
    std::size_t loose_cavities = 0;  // negative shells with nothing around them: inside out, kept as solids
};
Solids solids(const TriangleMesh& mesh, const Shells& shells, Vec3 axis);

// The same with the pairs of shells given that are one solid. Nothing is said of loose cavities.
Solids solids(const Shells& shells, std::span<const std::array<std::uint32_t, 2>> ties);

// The sub-meshes of the solids, in the order of their first triangle, triangles in the order of the input.
std::vector<TriangleMesh> split_solids(const TriangleMesh& mesh, Vec3 axis);
std::vector<TriangleMesh> split_solids(const TriangleMesh& mesh, const Shells& shells, const Solids& solids);

// The part of the mesh whose triangles are numbered `group` in group_of; only points in use, in order of first use.
TriangleMesh extract(const TriangleMesh& mesh, const std::vector<std::uint32_t>& group_of, std::uint32_t group);

}  // namespace qchopper
