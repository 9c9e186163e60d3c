// Where a ball-ended tool fits: surface that is in sight of the tool but too narrow for it.
//
// mm. A ball of radius r that stands over the surface point p has its centre on the normal n there; it fits if no
// surface is nearer to the centre than r. If it may leave some foam on p, its centre stands that much higher, and does
// not touch p itself. A larger ball never fits where a smaller one does not, because it contains it
// (tests/segment/access/tool_fit_test.cpp).

#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "segment/access/surface_samples.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A scan is a surface of flat triangles with noise: beside every concave edge a ball that had to touch p exactly would
// not fit, however shallow the edge. What a ball may leave on p lets edges pass at which the surface turns by up to
// acos(r / (r + lift)), 10 degrees for a radius of 3 mm; in return a slot fits only from a width of 2 r + lift. Of a CT
// scan with triangles 0.5 mm long a ball of 1.5 mm misses 35 % of the surface without it, 13 % with it, and 11 % with
// four times as much. Not a share of r: then a larger ball could fit where a smaller one does not.
constexpr double default_lift_mm = 0.05;

struct BallFit {
    double radius = 0;              // > 0
    double allowance = 0;           // of foam that is left on the surface anyway; >= 0
    double lift = default_lift_mm;  // what the ball may leave where no allowance is; > 0
    // The centre stands at p + (radius + height_mm()) n.
    double height_mm() const { return std::max(allowance, lift); }
};

// Per sample whether the ball does not fit. Triangles of which is_left_out is true (one per triangle, or empty) hinder
// no ball: caps, because another piece or the table lies there. The samples lie on the mesh. In parallel, the same
// result for any number of threads. One tree of the mesh, then O(log triangles) per sample on average.
std::vector<bool> too_narrow(const TriangleMesh& mesh, const std::vector<bool>& is_left_out,
                             std::span<const SurfaceSample> samples, const BallFit& ball);

}  // namespace qchopper
