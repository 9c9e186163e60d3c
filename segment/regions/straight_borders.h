// Straightens the borders between regions: each open border becomes a shortest path along edges between its ends.
//
// P. Sander, J. Snyder, S. Gortler and H. Hoppe, "Texture mapping progressive meshes" (2001). Tests:
// tests/segment/regions/straight_borders_test.cpp.

#pragma once

#include "segment/regions/labels.h"

namespace qchopper {

// The ends stay, and the path stays within the two regions. A border stays as it is if it is closed, if it touches
// itself, if it has an edge that turns by max_chart_turn (labelling.h) or more, because such an edge is where it
// belongs, and where no shorter path leaves both regions connected. Borders in the order of their regions, each with
// those before as they became. As many regions as before. O(triangles log triangles) for each border of the two
// regions.
Labels with_straight_borders(const FaceGraph& graph, const Labels& labels);

}  // namespace qchopper
