// Straightens the borders between regions: what of them is open becomes a shortest path along edges between its ends.
//
// P. Sander, J. Snyder, S. Gortler and H. Hoppe, "Texture mapping progressive meshes" (2001). Tests:
// tests/segment/regions/straight_borders_test.cpp.

#pragma once

#include "segment/regions/labels.h"

namespace qchopper {

// The ends stay, and the path stays within the two regions. Edges that turn by max_chart_turn (labelling.h) or more
// stay too, because a border belongs there; what lies between them is straightened part by part. A part stays as it is
// if it is closed, if it touches itself, and where no shorter path leaves both regions connected. Borders in the order
// of their regions, each with those before as they became. As many regions as before. O(triangles log triangles) of two
// regions for each part of a border between them.
Labels with_straight_borders(const FaceGraph& graph, const Labels& labels);

}  // namespace qchopper
