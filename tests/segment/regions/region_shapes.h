// Shapes of which the regions are known, and how well labels agree with them. mm, closed, outwards.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "segment/mesh/triangle_mesh.h"
#include "segment/regions/face_graph.h"

namespace qchopper::region_shapes {

struct Shape {
    std::string name;
    TriangleMesh mesh;
    std::vector<std::uint32_t> of;  // one per triangle: its region
    std::size_t regions = 0;
};

// Two balls of unequal radius at the ends of a bar along x: the bar is region 1, from x = bar_from to bar_to.
struct Dumbbell {
    Shape shape;
    double bar_from = 0;
    double bar_to = 0;
    double length = 0;  // of the bar
};
Dumbbell dumbbell();
Shape chain_of_balls();   // five of unequal size in a row
Shape hand();             // a palm and five fingers: six round cylinders of unequal size
Shape cube_with_posts();  // four posts on top, of squares: every edge is sharp
Shape two_boxes();        // an L
Shape cylinder();         // with flat ends; regions: the ends and the side

// Its regions are those flat sides of the first two that are connected: the charts.
std::vector<std::uint32_t> flat_sides(const FaceGraph& graph);

// Points moved at random by a standard deviation of `share` of the mean edge in each coordinate. Seeded.
TriangleMesh with_noise(TriangleMesh mesh, double share, unsigned seed);

// The same triangles in another order, with other first corners and numbers of points; `order` tells which one each
// was.
TriangleMesh in_other_order(const TriangleMesh& mesh, unsigned seed, std::vector<std::uint32_t>& order);

// L. Hubert and P. Arabie, "Comparing partitions" (1985), with area for the counts: 1 for equal divisions, 0 on average
// for unrelated ones.
double adjusted_rand_index(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b,
                           const std::vector<double>& area);

}  // namespace qchopper::region_shapes
