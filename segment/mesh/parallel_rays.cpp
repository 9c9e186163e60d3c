#include "segment/mesh/parallel_rays.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/huge_pages.h"
#include "base/parallel.h"
#include "segment/mesh/plane.h"
#include "segment/mesh/plane_frame.h"

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double cells_per_point = 2;
constexpr std::size_t shares = 8;  // of the triangles, each with ways of its own: the least of them does not depend on
                                   // how many threads there are

// A point seen along the normal: across it (u, v), and its height.
struct Seen {
    double u;
    double v;
    double h;
};

Seen seen_along(Vec3 normal, const PlaneFrame& frame, Vec3 p) {
    return {dot(frame.u, p), dot(frame.v, p), height(normal, p)};
}

struct GridPoint {
    Seen at;
    std::uint32_t query;
};

// The queries of one direction, sorted by cell. Few to a cell: a scan's triangles are small beside it.
class Grid {
 public:
    Grid(Vec3 normal, const PlaneFrame& frame, std::span<const RayQuery> queries, bool up) {
        std::vector<GridPoint> points;
        for (std::uint32_t q = 0; q < queries.size(); ++q) {
            if (queries[q].up == up) points.push_back({seen_along(normal, frame, queries[q].from), q});
        }
        if (points.empty()) return;
        double high_u = -infinite;
        double high_v = -infinite;
        low_u_ = low_v_ = infinite;
        for (const GridPoint& p : points) {
            low_u_ = std::min(low_u_, p.at.u);
            low_v_ = std::min(low_v_, p.at.v);
            high_u = std::max(high_u, p.at.u);
            high_v = std::max(high_v, p.at.v);
        }
        const double wide = std::max(high_u - low_u_, 1e-9);
        const double tall = std::max(high_v - low_v_, 1e-9);
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

    // Every point in the cells that a rectangle touches.
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
    static std::ptrdiff_t whole(double x) {  // far away is far away, however far
        return static_cast<std::ptrdiff_t>(std::floor(std::clamp(x, -4.0, 16384.0)));
    }
    std::ptrdiff_t column(double u) const { return whole((u - low_u_) * per_u_); }
    std::ptrdiff_t row(double v) const { return whole((v - low_v_) * per_v_); }
    std::size_t cell_of(const Seen& p) const {
        return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(row(p.v), 0, rows_ - 1) * columns_ +
                                        std::clamp<std::ptrdiff_t>(column(p.u), 0, columns_ - 1));
    }

    double low_u_ = 0;
    double low_v_ = 0;
    double per_u_ = 0;
    double per_v_ = 0;
    std::ptrdiff_t columns_ = 0;
    std::ptrdiff_t rows_ = 0;
    std::vector<std::size_t> first_;
    std::vector<GridPoint> points_;
};

double turn(const Seen& a, const Seen& b, const Seen& p) {
    return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
}

// On which side of a directed edge a point lies; computed from the smaller end point, so that two triangles at an edge
// get opposite numbers to the last bit.
double side(const Seen& a, const Seen& b, bool is_forward, const Seen& p) {
    return is_forward ? turn(a, b, p) : -turn(b, a, p);
}

// The same for a point on the line: as if it lay a little to the right and much less above. So a point on an edge or a
// vertex belongs to exactly one of the triangles around it.
double side_beside(const Seen& a, const Seen& b) {
    return a.v != b.v ? a.v - b.v : b.u - a.u;
}

// One triangle over the grid: points under or over it that lie nearer than before.
void pass_over(const Grid& grid, bool up, const Triangle& v, const Seen (&corner)[3], double most,
               std::span<double> ways) {
    const double low_u = std::min({corner[0].u, corner[1].u, corner[2].u});
    const double high_u = std::max({corner[0].u, corner[1].u, corner[2].u});
    const double low_v = std::min({corner[0].v, corner[1].v, corner[2].v});
    const double high_v = std::max({corner[0].v, corner[1].v, corner[2].v});
    const double low_h = std::min({corner[0].h, corner[1].h, corner[2].h}) - (up ? most : 0);
    const double high_h = std::max({corner[0].h, corner[1].h, corner[2].h}) + (up ? 0 : most);
    const double sign = up ? 1 : -1;  // seen along the normal, what looks up runs counter-clockwise
    grid.each_in(low_u, low_v, high_u, high_v, [&](const GridPoint& p) {
        if (p.at.u < low_u || p.at.u > high_u || p.at.v < low_v || p.at.v > high_v) return;
        if (p.at.h < low_h || p.at.h > high_h) return;
        double weight[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            const bool is_forward = v[k] < v[next];
            weight[k] = sign * side(corner[k], corner[next], is_forward, p.at);
            if (weight[k] < 0 || (weight[k] == 0 && sign * side_beside(corner[k], corner[next]) <= 0)) return;
        }
        const double sum = weight[0] + weight[1] + weight[2];
        if (sum <= 0) return;
        const double h = (weight[1] * corner[0].h + weight[2] * corner[1].h + weight[0] * corner[2].h) / sum;
        const double way = sign * (h - p.at.h);
        if (way >= 0 && way <= most && way < ways[p.query]) ways[p.query] = way;
    });
}

}  // namespace

std::vector<double> ray_distances(const TriangleMesh& mesh, Vec3 normal, std::span<const RayQuery> queries,
                                  double most) {
    assert(most >= 0);
    std::vector<double> least(queries.size(), infinite);
    if (queries.empty()) return least;
    const PlaneFrame frame = frame_across(normal);
    const Grid grid_up(normal, frame, queries, true);
    const Grid grid_down(normal, frame, queries, false);
    auto seen = huge<Seen>(mesh.points.size());
    parallel_for(0, shares, [&](std::size_t s) {
        const std::size_t end = seen.size() * (s + 1) / shares;
        for (std::size_t p = seen.size() * s / shares; p < end; ++p)
            seen[p] = seen_along(normal, frame, mesh.points[p]);
    });
    std::vector<std::vector<double>> ways(shares);
    parallel_for(0, shares, [&](std::size_t s) {
        ways[s].assign(queries.size(), infinite);
        const std::size_t end = mesh.triangles.size() * (s + 1) / shares;
        for (std::size_t t = mesh.triangles.size() * s / shares; t < end; ++t) {
            const Triangle& v = mesh.triangles[t];
            const Seen corner[3] = {seen[v[0]], seen[v[1]], seen[v[2]]};
            // A way along the normal leaves through what looks up, one against it through what looks down.
            const double looks_up = turn(corner[0], corner[1], corner[2]);
            if (looks_up > 0 && !grid_up.is_empty()) pass_over(grid_up, true, v, corner, most, ways[s]);
            if (looks_up < 0 && !grid_down.is_empty()) pass_over(grid_down, false, v, corner, most, ways[s]);
        }
    });
    for (const std::vector<double>& share : ways) {
        for (std::size_t q = 0; q < least.size(); ++q) least[q] = std::min(least[q], share[q]);
    }
    return least;
}

}  // namespace qchopper
