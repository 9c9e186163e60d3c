// The horizontal sections of what stands at the end of finishing: those of the piece near its base, and the foam that
// no tool of its directions removes.
//
// mm, in setup coordinates. Of the piece only what is joined to the base below the section counts: what hangs down
// beside it carries nothing. Areas and second moments are exact sums over edges (Green's theorem); those of the foam
// are sums over the columns of StockPoints, of which one counts where all of it stands from the base plane up. Without
// foam, a setup that is turned about z has the same sections to rounding (tests/cam/setup/workholding_test.cpp).

#pragma once

#include <vector>

#include "cam/setup/setup.h"
#include "cam/setup/stock_points.h"
#include "cam/setup/workholding.h"
#include "segment/mesh/polygon.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct StandingSection {
    double z = 0;
    double area_mm2 = 0;  // 0: nothing stands here, and so is all that follows
    Point2 centroid;
    double modulus_mm3 = 0;  // of the weakest direction (workholding.h)
    double width = 0;        // smallest distance of two parallel lines around it
    double reach = 0;        // of its farthest point from the centroid
};

// At z = 0, the flat side or the point on which the piece lies, and at 12 heights up to a third of its own. `foam`:
// what is left around the piece; null where it is not known. Precondition: the mesh is closed and has a point.
// O(triangles), and O(columns x height) of the foam.
std::vector<StandingSection> standing_sections(const TriangleMesh& mesh, const Setup& setup,
                                               const StockPoints* stock_points = nullptr);

// Preconditions: the cell has a machine, the block of the setup is one of its stock, and the first section is that at
// 0.
Workholding check_workholding(const std::vector<StandingSection>& sections, const Setup& setup, const Cell& cell);

}  // namespace qchopper
