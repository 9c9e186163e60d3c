// The rays are parallel, so no ray tree is needed: the queries are sorted into a grid across the normal, and each
// triangle visits the cells that its rectangle covers. Edge functions after J. Pineda, "A parallel algorithm for
// polygon rasterization" (1988); a query on an edge belongs to one triangle by a symbolic shift, after H. Edelsbrunner
// and E. Mücke, "Simulation of simplicity" (1990). The crossing of line_crossing.h would round to other last bits, and
// divides twice per triangle and query before it rejects. O(points + triangles + queries in the cells covered).

#include "segment/mesh/parallel_rays.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/huge_pages.h"
#include "base/parallel.h"
#include "segment/mesh/plane.h"
#include "segment/mesh/plane_frame.h"
#include "segment/mesh/polygon.h"

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double cells_per_point = 2;
constexpr std::size_t shares = 8;  // of the triangles, each with distances of its own: their least does not depend on
                                   // the number of threads

// A point in coordinates across the normal (u, v), and its height along it.
struct ProjectedPoint {
    double u;
    double v;
    double h;
};

ProjectedPoint projected(Vec3 normal, const PlaneFrame& frame, Vec3 p) {
    return {dot(frame.u, p), dot(frame.v, p), height(normal, p)};
}

struct GridPoint {
    ProjectedPoint at;
    std::uint32_t query;
};

// The queries of one direction, sorted by cell; about two cells per query.
class RayGrid {
 public:
    RayGrid(Vec3 normal, const PlaneFrame& frame, std::span<const RayQuery> queries, bool up) {
        std::vector<GridPoint> points;
        for (std::uint32_t q = 0; q < queries.size(); ++q) {
            if (queries[q].up == up) points.push_back({projected(normal, frame, queries[q].from), q});
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
    }

    bool is_empty() const { return points_.empty(); }

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
    static std::ptrdiff_t whole(double x) {  // clamped, so that it fits an integer however far away
        return static_cast<std::ptrdiff_t>(std::floor(std::clamp(x, -4.0, 16384.0)));
    }
    std::ptrdiff_t column(double u) const { return whole((u - low_.x) * per_u_); }
    std::ptrdiff_t row(double v) const { return whole((v - low_.y) * per_v_); }
    std::size_t cell_of(const ProjectedPoint& p) const {
        return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(row(p.v), 0, rows_ - 1) * columns_ +
                                        std::clamp<std::ptrdiff_t>(column(p.u), 0, columns_ - 1));
    }

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
void update_distances(const RayGrid& grid, bool up, const Triangle& v, const ProjectedPoint (&corner)[3], double most,
                      std::span<double> distances) {
    const double low_u = std::min({corner[0].u, corner[1].u, corner[2].u});
    const double high_u = std::max({corner[0].u, corner[1].u, corner[2].u});
    const double low_v = std::min({corner[0].v, corner[1].v, corner[2].v});
    const double high_v = std::max({corner[0].v, corner[1].v, corner[2].v});
    const double low_h = std::min({corner[0].h, corner[1].h, corner[2].h}) - (up ? most : 0);
    const double high_h = std::max({corner[0].h, corner[1].h, corner[2].h}) + (up ? 0 : most);
    const double sign = up ? 1 : -1;  // a triangle that faces up runs counter-clockwise in u and v
    grid.each_in(low_u, low_v, high_u, high_v, [&](const GridPoint& p) {
        if (p.at.u < low_u || p.at.u > high_u || p.at.v < low_v || p.at.v > high_v) return;
        if (p.at.h < low_h || p.at.h > high_h) return;
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
        double& least = distances[p.query];
        if (distance >= 0 && distance <= most && distance < least) least = distance;
    });
}

}  // namespace

std::vector<double> ray_distances(const TriangleMesh& mesh, Vec3 normal, std::span<const RayQuery> queries,
                                  double most) {
    assert(most >= 0);
    std::vector<double> least(queries.size(), infinite);
    if (queries.empty()) return least;
    const PlaneFrame frame = frame_across(normal);
    const RayGrid grid_up(normal, frame, queries, true);
    const RayGrid grid_down(normal, frame, queries, false);
    auto points = huge<ProjectedPoint>(mesh.points.size());
    parallel_for(0, shares, [&](std::size_t s) {
        const std::size_t end = points.size() * (s + 1) / shares;
        for (std::size_t p = points.size() * s / shares; p < end; ++p)
            points[p] = projected(normal, frame, mesh.points[p]);
    });
    std::vector<std::vector<double>> distances(shares);
    parallel_for(0, shares, [&](std::size_t s) {
        distances[s].assign(queries.size(), infinite);
        const std::size_t end = mesh.triangles.size() * (s + 1) / shares;
        for (std::size_t t = mesh.triangles.size() * s / shares; t < end; ++t) {
            const Triangle& v = mesh.triangles[t];
            const ProjectedPoint corner[3] = {points[v[0]], points[v[1]], points[v[2]]};
            // A ray along the normal leaves through a triangle that faces up, one against it through one that faces
            // down.
            const double facing = turn(corner[0], corner[1], corner[2]);
            if (facing > 0 && !grid_up.is_empty()) update_distances(grid_up, true, v, corner, most, distances[s]);
            if (facing < 0 && !grid_down.is_empty()) update_distances(grid_down, false, v, corner, most, distances[s]);
        }
    });
    for (const std::vector<double>& share : distances) {
        for (std::size_t q = 0; q < least.size(); ++q) least[q] = std::min(least[q], share[q]);
    }
    return least;
}

}  // namespace qchopper
