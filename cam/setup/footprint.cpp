// The rectangle: one side of it lies on an edge of the convex hull (Freeman and Shapira, 1975), so turning once around
// the hull with four contact points is enough.

#include "cam/setup/footprint.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

FootPoint minus(FootPoint a, FootPoint b) {
    return {a[0] - b[0], a[1] - b[1]};
}
double dot2(FootPoint a, FootPoint b) {
    return a[0] * b[0] + a[1] * b[1];
}
double cross2(FootPoint a, FootPoint b) {
    return a[0] * b[1] - a[1] * b[0];
}

// One turn around the hull below or above; points must be sorted.
template <class Iterator>
void add_chain(std::vector<FootPoint>& hull, Iterator first, Iterator last) {
    const std::size_t start = hull.size();
    for (; first != last; ++first) {
        while (hull.size() >= start + 2 &&
               cross2(minus(hull.back(), hull[hull.size() - 2]), minus(*first, hull.back())) <= 0) {
            hull.pop_back();
        }
        hull.push_back(*first);
    }
    hull.pop_back();  // it begins the other chain
}

// Moves a contact point on while the next corner reaches further. Never more than once around.
std::size_t advance(const std::vector<FootPoint>& hull, std::size_t from, FootPoint direction) {
    std::size_t at = from;
    for (std::size_t steps = 0; steps < hull.size(); ++steps) {
        const std::size_t next = (at + 1) % hull.size();
        if (dot2(minus(hull[next], hull[at]), direction) < 0) break;
        at = next;
    }
    return at;
}

Rectangle spanned(FootPoint along, double length, double width) {
    if (length >= width) return {along, length, width};
    return {{-along[1], along[0]}, width, length};
}

Rectangle turn_around(const std::vector<FootPoint>& hull) {
    assert(hull.size() >= 3);
    Rectangle best;
    double least = std::numeric_limits<double>::infinity();
    std::size_t right = 0;
    std::size_t top = 0;
    std::size_t left = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const FootPoint edge = minus(hull[(i + 1) % hull.size()], hull[i]);
        const double size = std::hypot(edge[0], edge[1]);
        const FootPoint u{edge[0] / size, edge[1] / size};
        const FootPoint v{-u[1], u[0]};
        if (i == 0) right = 1;
        right = advance(hull, right, u);
        top = advance(hull, i == 0 ? right : top, v);
        left = advance(hull, i == 0 ? top : left, {-u[0], -u[1]});
        const double length = dot2(minus(hull[right], hull[left]), u);
        const double width = dot2(minus(hull[top], hull[i]), v);
        if (length * width >= least) continue;
        least = length * width;
        best = spanned(u, length, width);
    }
    return best;
}

}  // namespace

std::vector<FootPoint> convex_hull(std::vector<FootPoint> points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<FootPoint> hull;
    add_chain(hull, points.begin(), points.end());
    add_chain(hull, points.rbegin(), points.rend());
    return hull;
}

Rectangle smallest_rectangle(std::vector<FootPoint> points) {
    const std::vector<FootPoint> hull = convex_hull(std::move(points));
    if (hull.size() >= 3) return turn_around(hull);
    if (hull.size() < 2) return {};
    const FootPoint edge = minus(hull[1], hull[0]);
    const double length = std::hypot(edge[0], edge[1]);
    return {{edge[0] / length, edge[1] / length}, length, 0};
}

std::array<Vec3, 2> frame_under(Vec3 up) {
    assert(norm(up) > 0);
    // The axis that is least along `up` is the safest to build on.
    const double x = std::abs(up.x);
    const double y = std::abs(up.y);
    const double z = std::abs(up.z);
    const Vec3 aside = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    const Vec3 first = normalized(aside - dot(aside, up) * up);
    return {first, cross(up, first)};
}

namespace {

// Cells of a footprint's box that lie in some triangle.
class Grid {
 public:
    Grid(FootPoint min, FootPoint max) : min_(min) {
        constexpr double cells = 1 << 18;
        constexpr double most = 1 << 12;
        const FootPoint size = minus(max, min);
        const double side = std::sqrt(size[0] * size[1] / cells);
        for (int k = 0; k < 2; ++k) {
            count_[k] = static_cast<std::size_t>(std::clamp(std::ceil(size[k] / side), 1.0, most));
            cell_[k] = size[k] / static_cast<double>(count_[k]);
        }
        covered_.assign(count_[0] * count_[1], 0);
    }

    void add(std::array<FootPoint, 3> corner) {
        for (FootPoint& p : corner) p = {(p[0] - min_[0]) / cell_[0], (p[1] - min_[1]) / cell_[1]};
        const auto [low, high] = std::minmax({corner[0][1], corner[1][1], corner[2][1]});
        const std::size_t last = up_to(high, 1);
        for (std::size_t row = up_to(low, 1); row < last; ++row) add_row(corner, row);
    }

    double area() const {
        return static_cast<double>(std::count(covered_.begin(), covered_.end(), 1)) * cell_[0] * cell_[1];
    }

 private:
    // First cell whose middle is not before `at`.
    std::size_t up_to(double at, int axis) const {
        return static_cast<std::size_t>(std::clamp(std::ceil(at - 0.5), 0.0, static_cast<double>(count_[axis])));
    }

    void add_row(const std::array<FootPoint, 3>& corner, std::size_t row) {
        const double y = static_cast<double>(row) + 0.5;
        double from = std::numeric_limits<double>::infinity();
        double to = -from;
        for (int k = 0; k < 3; ++k) {
            const FootPoint a = corner[k];
            const FootPoint b = corner[(k + 1) % 3];
            if ((a[1] <= y) == (b[1] <= y)) continue;
            const double x = a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]);
            from = std::min(from, x);
            to = std::max(to, x);
        }
        if (from > to) return;
        const auto begin = covered_.begin() + static_cast<std::ptrdiff_t>(row * count_[0]);
        std::fill(begin + static_cast<std::ptrdiff_t>(up_to(from, 0)),
                  begin + static_cast<std::ptrdiff_t>(up_to(to, 0)), char{1});
    }

    FootPoint min_;
    std::array<double, 2> cell_{};
    std::array<std::size_t, 2> count_{};
    std::vector<char> covered_;
};

}  // namespace

double projected_area_mm2(const TriangleMesh& mesh, Vec3 up) {
    const auto [e1, e2] = frame_under(up);
    std::vector<FootPoint> flat;
    flat.reserve(mesh.points.size());
    FootPoint min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    FootPoint max{-min[0], -min[1]};
    for (const Vec3& p : mesh.points) {
        flat.push_back({dot(e1, p), dot(e2, p)});
        for (int k = 0; k < 2; ++k) {
            min[k] = std::min(min[k], flat.back()[k]);
            max[k] = std::max(max[k], flat.back()[k]);
        }
    }
    if (!(max[0] > min[0]) || !(max[1] > min[1])) return 0;
    Grid grid(min, max);
    for (const Triangle& t : mesh.triangles) grid.add({flat[t[0]], flat[t[1]], flat[t[2]]});
    return grid.area();
}

}  // namespace qchopper
