// The foam around a piece as points of a grid: what tools that come from some directions leave of it.
//
// mm. Points stand in upright columns of the setup, one at a random place of each square of the grid, with a random
// start: so a flat side of the piece does not pass between all columns at once. The random numbers are always the same,
// and the result does not depend on the number of threads. An error of a map at the piece's outline, of up to half a
// cell, is an error here too: at most half a cell times the area of what is steep to the directions
// (tests/cam/setup/mapped_access_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/box.h"
#include "base/pose.h"
#include "segment/mesh/polygon.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// A map on cells of its own and its closing by a ball: how much higher than a map of the same piece and direction,
// but of finer cells, the surface is that the ball leaves.
struct BallClosing {
    const HeightField* map = nullptr;
    const HeightField* closed = nullptr;
};

class StockPoints {
 public:
    // All points of a box that lie outside of the piece, about `count` in the whole box. Preconditions: the mesh is
    // consistent and closed, the box is in setup coordinates and has a volume, count > 0. O(triangles + points).
    StockPoints(const TriangleMesh& mesh, const Pose& piece_in_setup, const Box& box, std::size_t count);

    // Takes away the points above the surface of a map, or above what a ball leaves of it. Between the centres of
    // cells the surface is linear, unless it differs there by more than three cells. O(points left).
    void mill(const HeightField& map);
    void mill(const HeightField& map, const BallClosing& closing);

    // Of the points that are left; each stands for an equal share of the box.
    double volume_mm3() const;

    // Of the columns whose points are all left from the bottom of the box up to a height: where they stand, and the
    // area for which each does. O(columns x points below).
    std::vector<Point2> standing_up_to(double z) const;
    double column_mm2() const { return step_.x * step_.y; }

 private:
    struct Column {
        double x;  // mm in the setup
        double y;
        double start;  // z of the first point
    };
    Column column(std::size_t index) const;
    template <class Surface>
    void mill_above(const HeightField& map, const Surface& surface);

    Pose piece_in_setup_;
    Box box_;
    std::array<std::size_t, 3> counts_{};
    Vec3 step_;
    std::size_t words_ = 0;            // per column
    std::vector<std::uint64_t> left_;  // a bit per point, column by column
};

}  // namespace qchopper
