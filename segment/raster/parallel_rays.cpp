// The rays are parallel, so no ray tree is needed: the queries are sorted into a grid across the normal, and each
// triangle visits the cells that its rectangle covers. Most triangles reach no ray; they are told by single-precision
// coordinates and the heights that the rays of a cell reach, with a margin for rounding. Edge functions after J.
// Pineda, "A parallel algorithm for polygon rasterization" (1988); a query on an edge belongs to one triangle by a
// symbolic shift, after H. Edelsbrunner and E. Mücke, "Simulation of simplicity" (1990). The crossing of
// line_crossing.h would round to other last bits, and divides twice per triangle and query before it rejects. O(points
// + triangles + queries in the cells covered); 12 bytes a point, about 130 a query.
//
// Why no tree of Embree, which pictures and setups use: at 1.9 million faces tree and rays took more than 1 s where the
// grid takes 0.5 s, the next piece would need another tree, and rays in single precision that graze an edge decide now
// this way, now that, so that the plain sum and the sweep differed.

#include "segment/raster/parallel_rays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "base/huge_pages.h"
#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/plane.h"
#include "segment/mesh/plane_frame.h"
#include "segment/mesh/polygon.h"
#include "segment/raster/shared_value.h"

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double cells_per_point = 2;

// A point in coordinates across the normal (u, v), and its height along it.
struct ProjectedPoint {
    double u;
    double v;
    double h;
};

ProjectedPoint projected(Vec3 normal, const PlaneFrame& frame, Vec3 p) {
    return {dot(frame.u, p), dot(frame.v, p), height(normal, p)};
}

// The same about the middle of the mesh, in single precision.
struct FlatPoint {
    float u;
    float v;
    float h;
};

// Projects the mesh and its rays. Differences between FlatPoints and exact coordinates are below `margin`.
class Projection {
 public:
    Projection(const TriangleMesh& mesh, Vec3 normal) : mesh_(mesh), normal_(normal), frame_(frame_across(normal)) {
        const Box box = bounds(mesh);
        middle_ = projected(normal_, frame_, box.centre());
        margin = static_cast<float>(1e-6 * (norm(box.size()) + 1e-3 * norm(box.centre())));
    }
    ProjectedPoint exact(Vec3 p) const { return projected(normal_, frame_, p); }
    ProjectedPoint corner(std::uint32_t point) const { return exact(mesh_.points[point]); }
    FlatPoint flat(const ProjectedPoint& p) const {
        return {static_cast<float>(p.u - middle_.u), static_cast<float>(p.v - middle_.v),
                static_cast<float>(p.h - middle_.h)};
    }

    float margin = 0;  // mm

 private:
    const TriangleMesh& mesh_;
    Vec3 normal_;
    PlaneFrame frame_;
    ProjectedPoint middle_{};
};

// The box of a triangle, grown by the margin.
struct FlatBox {
    FlatPoint low;
    FlatPoint high;
};

FlatBox flat_box(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c, float margin) {
    return {
        {std::min({a.u, b.u, c.u}) - margin, std::min({a.v, b.v, c.v}) - margin, std::min({a.h, b.h, c.h}) - margin},
        {std::max({a.u, b.u, c.u}) + margin, std::max({a.v, b.v, c.v}) + margin, std::max({a.h, b.h, c.h}) + margin}};
}

// Positive if the triangle faces up; wrong by at most eight times the margin times the sum of its width and height.
float flat_facing(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

// Heights that some rays reach; none without rays.
struct Reach {
    float low = std::numeric_limits<float>::infinity();
    float high = -std::numeric_limits<float>::infinity();
    void include(const Reach& other) {
        low = std::min(low, other.low);
        high = std::max(high, other.high);
    }
};

// Heights that the rays of a grid's cells reach, at several resolutions: a cell of each level is as wide as two of the
// level before, and holds the heights of itself and of its three neighbours to the right and above. So one cell answers
// for a box that is no wider than it.
class ReachPyramid {
 public:
    ReachPyramid() = default;
    ReachPyramid(std::vector<Reach> of_cell, std::size_t columns, std::size_t rows, FlatPoint origin,
                 std::array<float, 2> cells_per_mm)
        : origin_(origin), cells_per_mm_(cells_per_mm) {
        while (true) {
            levels_.push_back({columns, rows, with_neighbours(of_cell, columns, rows)});
            if (columns == 1 && rows == 1) break;
            of_cell = halved(of_cell, columns, rows);
            columns = (columns + 1) / 2;
            rows = (rows + 1) / 2;
        }
    }

    bool may_meet(const FlatBox& box) const {
        const float low_u = (box.low.u - origin_.u) * cells_per_mm_[0];
        const float low_v = (box.low.v - origin_.v) * cells_per_mm_[1];
        const float high_u = (box.high.u - origin_.u) * cells_per_mm_[0];
        const float high_v = (box.high.v - origin_.v) * cells_per_mm_[1];
        const Level& finest = levels_.front();
        if (high_u < 0 || high_v < 0 || low_u > static_cast<float>(finest.columns) ||
            low_v > static_cast<float>(finest.rows)) {
            return false;
        }
        const float wide = std::min(std::max(high_u - low_u, high_v - low_v), 65536.0F);
        const auto level = std::min<std::size_t>(std::bit_width(static_cast<unsigned>(wide)), levels_.size() - 1);
        const Level& at = levels_[level];
        const std::size_t column = std::min(static_cast<std::size_t>(std::max(low_u, 0.0F)) >> level, at.columns - 1);
        const std::size_t row = std::min(static_cast<std::size_t>(std::max(low_v, 0.0F)) >> level, at.rows - 1);
        const Reach& reach = at.cells[row * at.columns + column];
        return reach.low <= box.high.h && reach.high >= box.low.h;
    }

 private:
    struct Level {
        std::size_t columns;
        std::size_t rows;
        std::vector<Reach> cells;  // row by row
    };

    static std::vector<Reach> with_neighbours(const std::vector<Reach>& cells, std::size_t columns, std::size_t rows) {
        std::vector<Reach> grown = cells;
        for (std::size_t r = 0; r < rows; ++r) {
            for (std::size_t c = 0; c < columns; ++c) {
                Reach& reach = grown[r * columns + c];
                if (c + 1 < columns) reach.include(cells[r * columns + c + 1]);
                if (r + 1 < rows) reach.include(cells[(r + 1) * columns + c]);
                if (c + 1 < columns && r + 1 < rows) reach.include(cells[(r + 1) * columns + c + 1]);
            }
        }
        return grown;
    }

    static std::vector<Reach> halved(const std::vector<Reach>& cells, std::size_t columns, std::size_t rows) {
        const std::size_t half = (columns + 1) / 2;
        std::vector<Reach> coarse(half * ((rows + 1) / 2));
        for (std::size_t r = 0; r < rows; ++r) {
            for (std::size_t c = 0; c < columns; ++c) coarse[r / 2 * half + c / 2].include(cells[r * columns + c]);
        }
        return coarse;
    }

    FlatPoint origin_{};
    std::array<float, 2> cells_per_mm_{};
    std::vector<Level> levels_;
};

struct GridPoint {
    ProjectedPoint at;
    double reach;
    std::uint32_t query;
};

// The queries of one direction, sorted by cell; about two cells per query.
class RayGrid {
 public:
    RayGrid(const Projection& projection, std::span<const RayQuery> queries, bool up) {
        std::vector<GridPoint> points;
        for (std::uint32_t q = 0; q < queries.size(); ++q) {
            assert(queries[q].reach >= 0);
            if (queries[q].up == up) points.push_back({projection.exact(queries[q].from), queries[q].reach, q});
        }
        if (points.empty()) return;
        Rectangle2 all;
        for (const GridPoint& p : points) all.include({p.at.u, p.at.v});
        low_ = all.min;
        const double wide = std::max(all.max.x - low_.x, 1e-9);
        const double tall = std::max(all.max.y - low_.y, 1e-9);
        const double cell = std::sqrt(wide * tall / (cells_per_point * static_cast<double>(points.size())));
        columns_ = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(wide / cell) + 1, 1, 8192);
        rows_ = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(tall / cell) + 1, 1, 8192);
        per_u_ = static_cast<double>(columns_) / wide;
        per_v_ = static_cast<double>(rows_) / tall;
        first_.assign(static_cast<std::size_t>(columns_ * rows_) + 2, 0);
        for (const GridPoint& p : points) ++first_[cell_of(p.at) + 2];
        for (std::size_t c = 2; c < first_.size(); ++c) first_[c] += first_[c - 1];
        points_.resize(points.size());
        for (const GridPoint& p : points) points_[first_[cell_of(p.at) + 1]++] = p;
        assert(std::is_sorted(first_.begin(), first_.end()) && first_.back() == points_.size());
        find_reaches(projection, up);
    }

    // Whether a ray can meet a triangle in the box; false only if none can.
    bool may_meet(const FlatBox& box) const { return !points_.empty() && reaches_.may_meet(box); }

    // Calls visit(point) for every query in the cells that a rectangle touches.
    template <typename Visit>
    void each_in(double low_u, double low_v, double high_u, double high_v, const Visit& visit) const {
        const std::ptrdiff_t c0 = column(low_u);
        const std::ptrdiff_t c1 = column(high_u);
        const std::ptrdiff_t r0 = row(low_v);
        const std::ptrdiff_t r1 = row(high_v);
        if (c1 < 0 || r1 < 0 || c0 >= columns_ || r0 >= rows_) return;
        for (std::ptrdiff_t r = std::max<std::ptrdiff_t>(r0, 0); r <= std::min(r1, rows_ - 1); ++r) {
            const auto base = static_cast<std::size_t>(r * columns_);
            const std::size_t begin = first_[base + static_cast<std::size_t>(std::max<std::ptrdiff_t>(c0, 0))];
            const std::size_t end = first_[base + static_cast<std::size_t>(std::min(c1, columns_ - 1)) + 1];
            for (std::size_t i = begin; i < end; ++i) visit(points_[i]);
        }
    }

 private:
    // Rounded down, and clamped so that it fits an integer however far away. Without std::floor, which is a call.
    static std::ptrdiff_t whole(double x) { return static_cast<std::ptrdiff_t>(std::clamp(x, -4.0, 16384.0) + 4) - 4; }
    std::ptrdiff_t column(double u) const { return whole((u - low_.x) * per_u_); }
    std::ptrdiff_t row(double v) const { return whole((v - low_.y) * per_v_); }
    std::size_t cell_of(const ProjectedPoint& p) const {
        return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(row(p.v), 0, rows_ - 1) * columns_ +
                                        std::clamp<std::ptrdiff_t>(column(p.u), 0, columns_ - 1));
    }

    void find_reaches(const Projection& projection, bool up) {
        const float margin = projection.margin;
        std::vector<Reach> of_cell(static_cast<std::size_t>(columns_ * rows_));
        for (const GridPoint& p : points_) {
            const float h = projection.flat(p.at).h;
            const auto reach = static_cast<float>(p.reach);
            Reach& own = of_cell[cell_of(p.at)];
            own.low = std::min(own.low, h - margin - (up ? 0 : reach));
            own.high = std::max(own.high, h + margin + (up ? reach : 0));
        }
        const FlatPoint origin = projection.flat({low_.x, low_.y, 0});
        reaches_ = ReachPyramid(std::move(of_cell), static_cast<std::size_t>(columns_), static_cast<std::size_t>(rows_),
                                origin, {static_cast<float>(per_u_), static_cast<float>(per_v_)});
    }

    ReachPyramid reaches_;
    Point2 low_;  // least u and v of the queries
    double per_u_ = 0;
    double per_v_ = 0;
    std::ptrdiff_t columns_ = 0;
    std::ptrdiff_t rows_ = 0;
    std::vector<std::size_t> first_;
    std::vector<GridPoint> points_;
};

double turn(const ProjectedPoint& a, const ProjectedPoint& b, const ProjectedPoint& p) {
    return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
}

// The edge function of a directed edge: positive on its left. Computed from the smaller end point, so that the two
// triangles at an edge get opposite numbers to the last bit.
double side(const ProjectedPoint& a, const ProjectedPoint& b, bool is_forward, const ProjectedPoint& p) {
    return is_forward ? turn(a, b, p) : -turn(b, a, p);
}

// The sign of the same for a point on the line, as if it lay a little to the right and much less above. So a point on
// an edge or a vertex belongs to exactly one of the triangles around it.
double side_if_shifted(const ProjectedPoint& a, const ProjectedPoint& b) {
    return a.v != b.v ? a.v - b.v : b.u - a.u;
}

// Updates the distances of the queries below a triangle that faces up, or above one that faces down.
void update_distances(const RayGrid& grid, bool up, const Triangle& v, const ProjectedPoint (&corner)[3],
                      std::span<double> distances) {
    const double low_u = std::min({corner[0].u, corner[1].u, corner[2].u});
    const double high_u = std::max({corner[0].u, corner[1].u, corner[2].u});
    const double low_v = std::min({corner[0].v, corner[1].v, corner[2].v});
    const double high_v = std::max({corner[0].v, corner[1].v, corner[2].v});
    const double low_h = std::min({corner[0].h, corner[1].h, corner[2].h});
    const double high_h = std::max({corner[0].h, corner[1].h, corner[2].h});
    const double sign = up ? 1 : -1;  // a triangle that faces up runs counter-clockwise in u and v
    grid.each_in(low_u, low_v, high_u, high_v, [&](const GridPoint& p) {
        // without branches: mispredicted ones cost more than the six comparisons
        const double low = up ? p.at.h : p.at.h - p.reach;
        const double high = up ? p.at.h + p.reach : p.at.h;
        const int is_beside = int{p.at.u < low_u} | int{p.at.u > high_u} | int{p.at.v < low_v} | int{p.at.v > high_v} |
                              int{high < low_h} | int{low > high_h};
        if (is_beside != 0) return;
        double weight[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            const bool is_forward = v[k] < v[next];
            weight[k] = sign * side(corner[k], corner[next], is_forward, p.at);
            if (weight[k] < 0 || (weight[k] == 0 && sign * side_if_shifted(corner[k], corner[next]) <= 0)) return;
        }
        const double sum = weight[0] + weight[1] + weight[2];
        if (sum <= 0) return;
        const double h = (weight[1] * corner[0].h + weight[2] * corner[1].h + weight[0] * corner[2].h) / sum;
        const double distance = sign * (h - p.at.h);
        if (distance >= 0 && distance <= p.reach) lower_shared(distances[p.query], distance);
    });
}

}  // namespace

std::vector<double> ray_distances(const TriangleMesh& mesh, Vec3 normal, std::span<const RayQuery> queries) {
    constexpr std::size_t at_once = 1 << 14;
    std::vector<double> least(queries.size(), infinite);
    if (queries.empty()) return least;
    const Projection projection(mesh, normal);
    const RayGrid grid_up(projection, queries, true);
    const RayGrid grid_down(projection, queries, false);
    auto points = huge<FlatPoint>(mesh.points.size());
    parallel_ranges(0, points.size(), at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t p = first; p < end; ++p) points[p] = projection.flat(projection.exact(mesh.points[p]));
    });
    parallel_ranges(0, mesh.triangles.size(), at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t) {
            const Triangle& v = mesh.triangles[t];
            const FlatBox box = flat_box(points[v[0]], points[v[1]], points[v[2]], projection.margin);
            const float about = flat_facing(points[v[0]], points[v[1]], points[v[2]]);
            const float error = 8 * projection.margin * (box.high.u - box.low.u + box.high.v - box.low.v);
            const bool may_go_up = about >= -error && grid_up.may_meet(box);
            const bool may_go_down = about <= error && grid_down.may_meet(box);
            if (!may_go_up && !may_go_down) continue;
            const ProjectedPoint corner[3] = {projection.corner(v[0]), projection.corner(v[1]),
                                              projection.corner(v[2])};
            // A ray along the normal leaves through a triangle that faces up, one against it through one that faces
            // down.
            const double facing = turn(corner[0], corner[1], corner[2]);
            if (facing > 0 && may_go_up) update_distances(grid_up, true, v, corner, least);
            if (facing < 0 && may_go_down) update_distances(grid_down, false, v, corner, least);
        }
    });
    return least;
}

}  // namespace qchopper
