// What must stay, seen along one direction, and how deep the tip of a tool may go over it.
//
// mm. Maps of one direction of a setup (cam/setup/height_map.h) that share their frame: z along the direction's out.
// Conservative: a tool whose tip is nowhere below the tip surface cuts into no point of the target between the middles
// of cells either, but for cell^2 / (8 * radius) where a path runs from one middle to the next.

#pragma once

#include <cstddef>

#include "cam/cell/carving_tool.h"
#include "cam/setup/height_map.h"
#include "cam/setup/setup.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct TargetOptions {
    double cell = 0.25;
    // Height, in setup coordinates, of the plane below which no tip may go: the foam under it stays.
    double floor_z = 0;
    double border = 0;  // how far the map goes beyond the projection of the block
};

// The highest point of the piece or of the floor over the whole of each cell, not only over its middle. It covers the
// projection of the block, and every cell has a height. Preconditions: the mesh is that of the piece, direction is one
// of setup.reach.directions, cell > 0. Throws as height_map() does. O(triangles + cells).
HeightMap target_map(const Setup& setup, const TriangleMesh& mesh, std::size_t direction, const TargetOptions& options);

// The point of a map in setup coordinates, and back.
Vec3 map_to_setup(const Setup& setup, const HeightMap& map, Vec3 point);
Vec3 setup_to_map(const Setup& setup, const HeightMap& map, Vec3 point);

// How far above its tip a tool is at a distance from its axis: 0 at the axis, infinite beyond its radius (ISO 14649-111
// gives the shapes; ball, flat, bull, cone). Precondition: r >= 0.
double tool_profile(const CarvingTool& tool, double r);

// The least height at which the tip may stand over each cell so that the tool, up to its flute and shank with its whole
// diameter, stays at least `allowance` away from the target: dilation of the map by the tool. O(cells * (radius /
// cell)^2) at most, on several threads.
HeightMap tip_surface(const HeightMap& target, const CarvingTool& tool, double allowance = 0);

}  // namespace qchopper
