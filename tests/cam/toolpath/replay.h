// Replays passes of a ball on a grid, plainly: the tip stands every quarter of a cell along each straight line.

#pragma once

#include <vector>

#include "cam/cell/cutting_tool.h"
#include "cam/toolpath/pass.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/raster/height_field.h"

namespace qchopper::test_pieces {

// What remains at the centres of the cells of a map, `from` being its heights before.
HeightField replayed(const HeightField& from, const std::vector<Pass>& passes, const CuttingTool& tool);

// A point of the piece's surface with its normal, both in the map.
struct SurfacePoint {
    Vec3 at;
    Vec3 normal;
    double area = 0;
};
// Points at most `spacing` apart on triangles that look along the map's direction.
std::vector<SurfacePoint> surface_points(const TriangleMesh& mesh, const HeightField& map, double spacing);

// How far along its normal the point is from what is free, in steps of 0.02 mm; `most` where it is farther.
double foam_over(const HeightField& remaining, const SurfacePoint& point, double most);

// The largest depth by which the tip, at some place along the passes, is nearer to a point than the ball's radius: by
// how much the ball cuts into the surface. Positive: it does.
double deepest_gouge(const std::vector<Pass>& passes, const CuttingTool& tool, const std::vector<SurfacePoint>& points,
                     const HeightField& frame);

double length_of(const std::vector<Pass>& passes);
std::size_t points_of(const std::vector<Pass>& passes);

}  // namespace qchopper::test_pieces
