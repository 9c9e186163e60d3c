// What the tool reaches from the directions of a setup, by one height field per direction.
//
// mm. A triangle counts by the share of it that a direction reaches, the largest over the directions. Agrees with rays
// from the surface within half a percent of the area, per direction (tests/cam/setup/mapped_access_test.cpp). The
// result does not depend on the number of threads.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cam/setup/limiting_tools.h"
#include "cam/setup/setup.h"
#include "cam/setup/stock_points.h"
#include "cam/setup/surface_access.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct HeightFieldOptions {
    double cell = 0;                       // mm; 0: a 700th of the longest side of the piece's box, 0.25 mm at least
    std::size_t stock_points = 1U << 20U;  // in the piece's box, to measure foam and rest material with
};

struct MappedAccess {
    SurfaceAccess access;  // method mapped; all_directions_share, further, too_narrow_mm2 are left at 0
    std::vector<SurfaceState>
        states;  // per triangle, of the largest part of it; those of the base and of flush caps are `reached`
    std::vector<float> reached;               // per triangle, the share that is reached with the holder
    std::optional<StockPoints> stock_points;  // what is left in the piece's box; nothing where that is flat
};

// Of a triangle the part that no map reaches is steep if it is steep to one of the directions, else hidden; the part
// that a map reaches, but holder and spindle do not allow, is `holder`: they may not touch the piece (any other
// direction's foam is taken as removed first) nor come below z = 0. With a tool for which steep does not count, steep
// triangles count for the depth of a direction, because the side of the tool cuts them.
//
// Triangles that are ignored count in no area, depth or depth of foam. Foam is what lies above z = 0 in the block,
// outside of the piece and below its surface in all maps; holder and spindle are not asked. Its volume is that of
// points on a grid (stock_points.h): its standard deviation is about half a grid step times the square root of the area
// that bounds the foam times the step, its bias at most half a cell of the map times the area that is steep to the
// directions. Its depth is measured from a cell's width above hidden surface, and holds the parts of the piece that lie
// over it; it is right to 1/4096 of the diagonal of the piece's box, and the deepest ten-thousandth of that surface is
// left out. The rest material is measured on cells of between a seventh and two thirds of the radius: with the latter a
// fifth of a corner's is missed, and none is found of a radius below two cells of the map.
//
// The depth of a direction is right to 1/4096 of the block's diagonal and leaves out the deepest ten-thousandth of the
// area that it reaches, and what lies within a cell of higher surface.
//
// Of the setup are used its base, flush caps, pose and block, the tool axes of its access and whether steep counts;
// without a smallest radius there is no rest material. Preconditions: the mesh is that of the piece, consistent and
// closed, and has area; there is a tool axis, and none is more than 90 degrees from `up`. Throws as height_field()
// does. O(directions x (triangles + cells)); beside the mesh at most 8 bytes a cell of a single map, 24 bytes a
// triangle and a bit a foam point.
MappedAccess mapped_access(const TriangleMesh& mesh, const Setup& setup, const LimitingTools& tools,
                           const HeightFieldOptions& options = {});

}  // namespace qchopper
