// Planes along the borders between regions: what a method proposes to the search.
//
// mm. Borders are the edges between two regions, by their connected parts, and the whole border of each region. A plane
// is fitted to all points of the edges by total least squares; the tenth of the length that is farthest from it is left
// out, and it is fitted again (tests/segment/regions/region_planes_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "segment/mesh/plane.h"
#include "segment/regions/labels.h"

namespace qchopper {

constexpr std::size_t max_region_planes = 64;
constexpr double min_border_share = 0.05;  // of the diagonal: shorter borders have no plane

struct BorderPlane {
    Plane plane;           // canonical
    double border_mm = 0;  // length of the border
};

struct RegionPlanes {
    std::vector<BorderPlane> planes;  // longest border first, at most max_region_planes
    std::size_t straight = 0;         // borders whose points lie nearly on a line, so that they have no plane
    std::size_t equal = 0;            // planes left out, within 0.5 degrees and 0.5 % of the diagonal of another
    std::size_t beyond = 0;           // planes left out because there are enough
};

// Precondition: the labels are of the mesh of the graph. O(edges log edges + planes^2).
RegionPlanes region_planes(const FaceGraph& graph, const Labels& labels);

}  // namespace qchopper
