// A mesh as the browser draws it: points on a grid of 14 bits, triangles in groups of skin and caps.
//
// For display alone: no figure is taken from it. All meshes of a project stand on one grid over the box of its scan, so
// that the caps of two pieces that meet at a cut have the same points (tests/app/display/display_mesh_test.cpp). The
// grid moves a point by at most 0.87 steps.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/box.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct DisplayGrid {
    Vec3 origin;      // mm: the point {0, 0, 0}
    double step = 1;  // mm
    bool operator==(const DisplayGrid&) const = default;
};

constexpr std::uint16_t max_display_coordinate = (1U << 14) - 1;  // steps
using DisplayPoint = std::array<std::uint16_t, 3>;                // steps from the origin

enum class DisplaySurface : std::uint8_t { skin, cap };

// Triangles in a row.
struct DisplayGroup {
    DisplaySurface surface = DisplaySurface::skin;
    std::int32_t cut = no_cap;  // whose cap it is
    std::uint32_t first = 0;
    std::uint32_t faces = 0;
    bool operator==(const DisplayGroup&) const = default;
};

struct DisplayMesh {
    DisplayGrid grid;
    std::vector<DisplayPoint> points;
    std::vector<Triangle> triangles;
    std::vector<DisplayGroup> groups;  // the skin first, then caps by ascending cut; each once, none empty
    bool operator==(const DisplayMesh&) const = default;
};

// The grid whose points reach over the box. Throws InputError (mesh) if that is larger than numbers are.
DisplayGrid display_grid(const Box& box);

// The nearest of the grid; of a point outside of it one at its border. Precondition: coordinates are finite.
DisplayPoint nearest_point(const DisplayGrid& grid, Vec3 p);

// mm.
Vec3 place(const DisplayGrid& grid, const DisplayPoint& point);

// Whether what is said above holds, points are numbered in the order of their first use and all used, no triangle has
// two equal corners, and the grid is finite with a step above 0. O(points + triangles).
bool is_valid(const DisplayMesh& mesh);

// The mesh on the grid: points on one grid point become one, triangles that have two of them equal are left out, and
// triangles come in an order in which each follows a neighbour where it can, which is what packs well. Points outside
// of the grid are moved to its border. Precondition: coordinates are finite, caps are of cuts 0 and above.
DisplayMesh display_mesh(const TriangleMesh& mesh, const DisplayGrid& grid);

}  // namespace qchopper
