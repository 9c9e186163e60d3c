// The surface of the foam that is left, as triangles: to be looked at, not to be measured.

#pragma once

#include <cstddef>

#include "base/box.h"
#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"
#include "sim/replay/stock/stock_model.h"

namespace qchopper {

// mm between the points of stock_surface() that give at most about so many triangles for a block that is not much more
// than its own surface; at least `least`.
double surface_spacing(const Box& block, std::size_t triangles, double least);

// One point in each cube of a grid in which foam and no foam meet, from where the edges of the cube leave the foam: the
// surface lies in the same cubes, so that no point of the mesh is farther from it than sqrt(3) spacings. What is
// thinner than a spacing may be missing. Triangles are counter-clockwise seen from outside; an edge may be of more than
// two. Same stock, same mesh, whatever the number of threads (tests/sim/replay/stages/stock_surface_test.cpp).
// Precondition: spacing > 0. Throws Cancelled.
TriangleMesh stock_surface(const StockModel& stock_model, double spacing, const Context& context = {});

}  // namespace qchopper
