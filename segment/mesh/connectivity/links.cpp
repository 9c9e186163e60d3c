// Counting sort of the corners by point. At nearly every point the triangles form one ring, which a search among the
// few of them proves; the other points are examined by sorting their neighbours. O(triangles + points) where few
// triangles meet at a point.

#include "segment/mesh/connectivity/links.h"

#include <algorithm>
#include <array>

#include "base/huge_pages.h"
#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/connectivity/manifold.h"

namespace qchopper {
namespace {

// Corners by point: those of point v lie from first[v] to first[v + 1], ascending.
struct CornersByPoint {
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> corner;
};

CornersByPoint corners_by_point(const TriangleMesh& mesh) {
    CornersByPoint result;
    result.first.assign(mesh.points.size() + 2, 0);
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t point : t) ++result.first[point + 2];
    }
    for (std::size_t v = 2; v < result.first.size(); ++v) result.first[v] += result.first[v - 1];
    result.corner = huge<std::uint32_t>(3 * mesh.triangles.size());
    std::uint32_t corner = 0;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t point : t) result.corner[result.first[point + 1]++] = corner++;
    }
    return result;
}

// The edge opposite to a corner: its triangle runs from the point to `next`, on to `last` and back.
struct OppositeEdge {
    std::uint32_t next;
    std::uint32_t last;
};

OppositeEdge opposite_edge(const TriangleMesh& mesh, std::uint32_t corner) {
    const Triangle& t = mesh.triangles[corner / 3];
    const std::uint32_t k = corner % 3;
    return {t[k == 2 ? 0 : k + 1], t[k == 0 ? 2 : k - 1]};
}

constexpr std::size_t max_in_ring = 32;

// Whether the triangles around a point form one ring: the `last` of each is the `next` of the following one. Then every
// edge from the point has two triangles of opposite direction: a `next` that occurs twice would be found only once.
bool is_one_ring(const TriangleMesh& mesh, const std::uint32_t* corner, std::size_t count) {
    if (count < 3 || count > max_in_ring) return false;
    std::array<std::uint32_t, max_in_ring> next;
    std::array<std::uint32_t, max_in_ring> last;
    for (std::size_t i = 0; i < count; ++i) {
        const OppositeEdge edge = opposite_edge(mesh, corner[i]);
        next[i] = edge.next;
        last[i] = edge.last;
    }
    std::size_t at = 0;
    for (std::size_t steps = 1; steps < count; ++steps) {
        const std::uint32_t wanted = last[at];
        std::size_t to = 0;
        while (to < count && next[to] != wanted) ++to;
        if (to == count || to == 0) return false;
        at = to;
    }
    return last[at] == next[0];
}

// One triangle at an edge from the point that is examined.
struct Neighbour {
    std::uint32_t point;  // the other end
    bool is_next;         // the triangle runs from the point to the other end
    std::uint32_t place;  // of its corner among those of the point
    bool operator<(const Neighbour& b) const { return point != b.point ? point < b.point : place < b.place; }
};

// Examines the points whose triangles are not one ring.
class IrregularPoints {
 public:
    IrregularPoints(const TriangleMesh& mesh, const CornersByPoint& corners, Links& links)
        : mesh_(mesh), corners_(corners), links_(links), is_examined_(mesh.points.size()) {}

    void examine(std::uint32_t point) {
        is_examined_[point] = true;
        examined_.push_back(point);
        const std::uint32_t* const corner = &corners_.corner[corners_.first[point]];
        const std::uint32_t count = corners_.first[point + 1] - corners_.first[point];
        neighbours_.clear();
        for (std::uint32_t i = 0; i < count; ++i) {
            const OppositeEdge edge = opposite_edge(mesh_, corner[i]);
            neighbours_.push_back({edge.next, true, i});
            neighbours_.push_back({edge.last, false, i});
        }
        std::sort(neighbours_.begin(), neighbours_.end());
        DisjointSets fans(count);
        bool is_non_manifold = false;
        for (auto group = neighbours_.begin(); group != neighbours_.end();) {
            auto end = group;
            while (end != neighbours_.end() && end->point == group->point) ++end;
            const auto size = end - group;
            if (size == 2 && group->is_next != (group + 1)->is_next) {
                fans.unite(group->place, (group + 1)->place);
            } else {
                is_non_manifold |= size > 1;
                if (point < group->point) count_fault(size, corner[group->place] / 3);
                for (auto it = group; it != end; ++it) {
                    if (it->is_next) (size == 1 ? links_.open : links_.non_manifold).push_back(corner[it->place]);
                }
            }
            group = end;
        }
        if (!is_non_manifold) add_extra_fans(fans, corner, count);
    }

    // Triangles with the same corners have them at points whose triangles are not one ring: only those are compared.
    std::size_t count_repeated() const {
        std::vector<Triangle> sorted;
        for (const std::uint32_t point : examined_) {
            for (std::uint32_t i = corners_.first[point]; i < corners_.first[point + 1]; ++i) {
                Triangle t = mesh_.triangles[corners_.corner[i] / 3];
                std::sort(t.begin(), t.end());
                if (t[0] == point && is_examined_[t[1]] && is_examined_[t[2]]) sorted.push_back(t);
            }
        }
        std::sort(sorted.begin(), sorted.end());
        return static_cast<std::size_t>(sorted.end() - std::unique(sorted.begin(), sorted.end()));
    }

 private:
    // Called at the smaller end point of an edge.
    void count_fault(std::ptrdiff_t triangles, std::uint32_t first_triangle) {
        EdgeFaults& faults = links_.faults;
        if (faults.is_closed()) faults.first_triangle = first_triangle;
        ++(triangles == 1 ? faults.open : triangles == 2 ? faults.inconsistent : faults.non_manifold);
    }

    void add_extra_fans(DisjointSets& fans, const std::uint32_t* corner, std::uint32_t count) {
        fan_and_place_.clear();
        for (std::uint32_t i = 0; i < count; ++i) fan_and_place_.push_back({fans.root(i), i});
        std::sort(fan_and_place_.begin(), fan_and_place_.end());
        for (std::size_t i = 0; i < count; ++i) {
            const auto [fan, place] = fan_and_place_[i];
            if (fan == 0) continue;
            links_.extra_fans.values.push_back(corner[place]);
            if (i + 1 == count || fan_and_place_[i + 1][0] != fan) links_.extra_fans.end_list();
        }
    }

    const TriangleMesh& mesh_;
    const CornersByPoint& corners_;
    Links& links_;
    std::vector<Neighbour> neighbours_;                        // of the point that is examined
    std::vector<std::array<std::uint32_t, 2>> fan_and_place_;  // of its corners
    std::vector<bool> is_examined_;
    std::vector<std::uint32_t> examined_;
};

}  // namespace

Links links(const TriangleMesh& mesh) {
    Links result;
    const CornersByPoint corners = corners_by_point(mesh);
    IrregularPoints irregular(mesh, corners, result);
    for (std::uint32_t point = 0; point < mesh.points.size(); ++point) {
        const std::uint32_t begin = corners.first[point];
        const std::uint32_t count = corners.first[point + 1] - begin;
        if (count > 0 && !is_one_ring(mesh, &corners.corner[begin], count)) irregular.examine(point);
    }
    std::sort(result.open.begin(), result.open.end());
    std::sort(result.non_manifold.begin(), result.non_manifold.end());
    result.repeated = irregular.count_repeated();
    return result;
}

void split_fans(TriangleMesh& mesh, const IndexLists& extra_fans) {
    for (const std::span<const std::uint32_t> fan : extra_fans) {
        const auto copy = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(Vec3(mesh.points[start_of(mesh, fan[0])]));
        for (const std::uint32_t corner : fan) mesh.triangles[corner / 3][corner % 3] = copy;
    }
}

}  // namespace qchopper
