#include "segment/mesh/links.h"

#include <algorithm>
#include <array>

#include "base/huge_pages.h"
#include "segment/mesh/disjoint_sets.h"
#include "segment/mesh/manifold.h"

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
    reserve_huge(result.corner, 3 * mesh.triangles.size());
    result.corner.resize(3 * mesh.triangles.size());
    std::uint32_t corner = 0;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t point : t) result.corner[result.first[point + 1]++] = corner++;
    }
    return result;
}

// The edge across from a corner: its triangle leads from the point to `next`, over to `last` and back.
struct Across {
    std::uint32_t next;
    std::uint32_t last;
};

Across across(const TriangleMesh& mesh, std::uint32_t corner) {
    const Triangle& t = mesh.triangles[corner / 3];
    const std::uint32_t k = corner % 3;
    return {t[k == 2 ? 0 : k + 1], t[k == 0 ? 2 : k - 1]};
}

constexpr std::size_t most_for_walk = 32;

// Whether the triangles around a point close to one ring, each passing the turn to the next. Then every edge from here
// has two triangles that run it opposite ways: a repeated `next` would never be found a second time.
bool is_one_ring(const TriangleMesh& mesh, const std::uint32_t* corner, std::size_t count) {
    if (count < 3 || count > most_for_walk) return false;
    std::array<std::uint32_t, most_for_walk> next;
    std::array<std::uint32_t, most_for_walk> last;
    for (std::size_t i = 0; i < count; ++i) {
        const Across edge = across(mesh, corner[i]);
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

// One triangle at an edge from the point in hand.
struct Neighbour {
    std::uint32_t point;  // the other end
    bool is_next;         // the triangle runs from here to there
    std::uint32_t place;  // of its corner among those of the point
    bool operator<(const Neighbour& b) const { return point != b.point ? point < b.point : place < b.place; }
};

// The points whose triangles are not one ring are looked at closely.
class Closely {
 public:
    Closely(const TriangleMesh& mesh, const CornersByPoint& corners, Links& links)
        : mesh_(mesh), corners_(corners), links_(links), is_looked_at_(mesh.points.size()) {}

    void look_at(std::uint32_t point) {
        is_looked_at_[point] = true;
        looked_at_.push_back(point);
        const std::uint32_t* const corner = &corners_.corner[corners_.first[point]];
        const std::uint32_t count = corners_.first[point + 1] - corners_.first[point];
        neighbours_.clear();
        for (std::uint32_t i = 0; i < count; ++i) {
            const Across edge = across(mesh_, corner[i]);
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
                if (point < group->point) tell(size, corner[group->place] / 3);
                for (auto it = group; it != end; ++it) {
                    if (it->is_next) (size == 1 ? links_.open : links_.non_manifold).push_back(corner[it->place]);
                }
            }
            group = end;
        }
        if (!is_non_manifold) tell_fans(fans, corner, count);
    }

    // Equal triangles have all their corners at points whose triangles are no ring of three or more.
    std::size_t count_repeated() const {
        std::vector<Triangle> sorted;
        for (const std::uint32_t point : looked_at_) {
            for (std::uint32_t i = corners_.first[point]; i < corners_.first[point + 1]; ++i) {
                Triangle t = mesh_.triangles[corners_.corner[i] / 3];
                std::sort(t.begin(), t.end());
                if (t[0] == point && is_looked_at_[t[1]] && is_looked_at_[t[2]]) sorted.push_back(t);
            }
        }
        std::sort(sorted.begin(), sorted.end());
        return static_cast<std::size_t>(sorted.end() - std::unique(sorted.begin(), sorted.end()));
    }

 private:
    // At the smaller end of an edge.
    void tell(std::ptrdiff_t triangles, std::uint32_t first_triangle) {
        EdgeFaults& faults = links_.faults;
        if (faults.is_closed()) faults.first_triangle = first_triangle;
        ++(triangles == 1 ? faults.open : triangles == 2 ? faults.inconsistent : faults.non_manifold);
    }

    void tell_fans(DisjointSets& fans, const std::uint32_t* corner, std::uint32_t count) {
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
    std::vector<Neighbour> neighbours_;                        // of the point in hand
    std::vector<std::array<std::uint32_t, 2>> fan_and_place_;  // of its corners
    std::vector<bool> is_looked_at_;
    std::vector<std::uint32_t> looked_at_;
};

}  // namespace

Links links(const TriangleMesh& mesh) {
    Links result;
    const CornersByPoint corners = corners_by_point(mesh);
    Closely closely(mesh, corners, result);
    for (std::uint32_t point = 0; point < mesh.points.size(); ++point) {
        const std::uint32_t begin = corners.first[point];
        const std::uint32_t count = corners.first[point + 1] - begin;
        if (count > 0 && !is_one_ring(mesh, &corners.corner[begin], count)) closely.look_at(point);
    }
    std::sort(result.open.begin(), result.open.end());
    std::sort(result.non_manifold.begin(), result.non_manifold.end());
    result.repeated = closely.count_repeated();
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
