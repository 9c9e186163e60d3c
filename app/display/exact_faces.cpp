// Corners on the grid are compared by a hash table of points, then triangles in a sorted list: O(n log n). For the rest
// a tree over the skin, O(log n) for each on average, on several threads: caps have long triangles, whose boxes would
// be entered by most searches.

#include "app/display/exact_faces.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "segment/mesh/point_table.h"
#include "segment/mesh/triangle_tree.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

Triangle from_least_corner(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

// Per point of the piece the point of `shown` on the same point of the grid, or another number that is larger.
std::vector<std::uint32_t> points_on_grid(const DisplayMesh& shown, const TriangleMesh& piece) {
    std::vector<Vec3> known;
    PointTable table(shown.points.size() + piece.points.size());
    const auto number_of = [&](const DisplayPoint& point) {
        const Vec3 p{double(point[0]), double(point[1]), double(point[2])};
        const auto next = static_cast<std::uint32_t>(known.size());
        const std::uint32_t number = table.find_or_note(known, p, PointTable::hash_of(p), next);
        if (number == next) known.push_back(p);
        return number;
    };
    for (const DisplayPoint& point : shown.points) number_of(point);
    std::vector<std::uint32_t> numbers;
    numbers.reserve(piece.points.size());
    for (const Vec3& p : piece.points) numbers.push_back(number_of(nearest_point(shown.grid, p)));
    return numbers;
}

// Per face the first triangle with the same corners and of the same cap, or none.
std::vector<std::uint32_t> same_triangles(const DisplayMesh& shown, const TriangleMesh& piece) {
    using Face = std::pair<std::int32_t, Triangle>;  // number of the cap, corners
    std::vector<std::pair<Face, std::uint32_t>> faces;
    for (const DisplayGroup& group : shown.groups) {
        for (std::uint32_t t = group.first; t < group.first + group.faces; ++t) {
            faces.push_back({{group.cut, from_least_corner(shown.triangles[t])}, t});
        }
    }
    std::sort(faces.begin(), faces.end());
    const std::vector<std::uint32_t> numbers = points_on_grid(shown, piece);
    std::vector<std::uint32_t> result(shown.triangles.size(), none);
    for (std::uint32_t t = 0; t < piece.triangles.size(); ++t) {
        const Triangle& corner = piece.triangles[t];
        const Triangle corners{numbers[corner[0]], numbers[corner[1]], numbers[corner[2]]};
        if (std::max({corners[0], corners[1], corners[2]}) >= shown.points.size()) continue;
        const Face face{cap_of(piece, t), from_least_corner(corners)};
        auto at = std::lower_bound(faces.begin(), faces.end(), std::pair{face, std::uint32_t{0}});
        for (; at != faces.end() && at->first == face; ++at) {
            if (result[at->second] == none) result[at->second] = t;
        }
    }
    return result;
}

// What is searched: the skin, or all where there is none.
class ExactSurface {
 public:
    explicit ExactSurface(const TriangleMesh& piece) : surface_(skin_of(piece, number_)), tree_(surface_) {}

    std::uint32_t nearest(const std::array<Vec3, 3>& face, double step) const {
        constexpr int max_boxes = 4;  // each twice as wide as the one before
        const Vec3 middle = 1.0 / 3 * (face[0] + face[1] + face[2]);
        const Vec3 normal = cross(face[1] - face[0], face[2] - face[0]);
        const TriangleTree::Nearest any = tree_.nearest(surface_, middle);
        if (is_turned_alike(any.triangle, normal)) return number_[any.triangle];
        double reach = any.distance + step;
        for (int i = 0; i < max_boxes; ++i, reach *= 2) {
            const auto [distance, triangle] = nearest_alike(middle, reach, normal);
            if (distance <= reach) return number_[triangle];
        }
        return number_[any.triangle];
    }

 private:
    static TriangleMesh skin_of(const TriangleMesh& piece, std::vector<std::uint32_t>& number) {
        TriangleMesh skin{piece.points, {}, {}};
        for (std::uint32_t t = 0; t < piece.triangles.size(); ++t) {
            if (cap_of(piece, t) != no_cap) continue;
            skin.triangles.push_back(piece.triangles[t]);
            number.push_back(t);
        }
        if (!number.empty()) return skin;
        for (std::uint32_t t = 0; t < piece.triangles.size(); ++t) number.push_back(t);
        return piece;
    }

    bool is_turned_alike(std::uint32_t triangle, Vec3 normal) const {
        const Vec3 own = area_vector(surface_, triangle);
        return dot(own, normal) >= 0.5 * norm(own) * norm(normal);
    }

    // Distance and triangle, of equal distances the one of the least number; farther than `reach` if there is none.
    std::pair<double, std::uint32_t> nearest_alike(Vec3 p, double reach, Vec3 normal) const {
        const Vec3 half{reach, reach, reach};
        std::pair<double, std::uint32_t> best{std::numeric_limits<double>::infinity(), none};
        tree_.for_each_near(tree_.box_of({p - half, p, p + half}), [&](std::uint32_t triangle) {
            if (!is_turned_alike(triangle, normal)) return;
            const double distance = norm(closest_on_triangle(p, corners_of(surface_, triangle)) - p);
            best = std::min(best, {distance, triangle});
        });
        return best;
    }

    std::vector<std::uint32_t> number_;  // in the piece, of each triangle of the surface
    TriangleMesh surface_;
    TriangleTree tree_;
};

}  // namespace

std::vector<std::uint32_t> exact_faces(const DisplayMesh& shown, const TriangleMesh& piece, const Context& context) {
    assert(is_valid(shown) && is_consistent(piece) && (shown.triangles.empty() || !piece.triangles.empty()));
    std::vector<std::uint32_t> result = same_triangles(shown, piece);
    if (std::find(result.begin(), result.end(), none) == result.end()) return result;
    context.check_cancelled();
    const ExactSurface surface(piece);
    constexpr std::size_t grain = 64;
    parallel_ranges(0, result.size(), grain, [&](std::size_t first, std::size_t end) {
        context.check_cancelled();
        for (std::size_t t = first; t < end; ++t) {
            if (result[t] != none) continue;
            const Triangle& corner = shown.triangles[t];
            const auto at = [&](std::size_t k) { return place(shown.grid, shown.points[corner[k]]); };
            result[t] = surface.nearest({at(0), at(1), at(2)}, shown.grid.step);
        }
    });
    return result;
}

}  // namespace qchopper
