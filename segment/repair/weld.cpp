// Equal points: a hash table of the points (point_table.h), then one pass over the triangles and one over the points.
// O(points + triangles). Memory: 5 bytes per point, and 12 to 24 bytes in the table per different point. Border points:
// every one is put into the nearest group that can take it, in the order of the points; a grid of cells as large as the
// tolerance finds the groups. O(triangles), and O(n log n) in the border points while cells hold few of them.

#include "segment/repair/weld.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "base/huge_pages.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/manifold.h"
#include "segment/mesh/point_table.h"

namespace qchopper {
namespace {

// Per point, the first point with the same coordinates.
std::vector<std::uint32_t> first_equal(const std::vector<Vec3>& points) {
    constexpr std::size_t batch = 16;  // slots are prefetched for so many points before they are used
    std::array<std::uint64_t, batch> hash{};
    // The share of repeated points, from which the size of the table follows, is measured on the first part: in an STL
    // file six triangles repeat a point, in a PLY file there may be no repetition.
    const std::size_t sample = points.size() / 16;
    PointTable table(sample);
    std::vector<std::uint32_t> first;
    reserve_huge(first, points.size());
    first.resize(points.size());
    for (std::size_t begin = 0; begin < points.size(); begin += batch) {
        const std::size_t end = std::min(points.size(), begin + batch);
        if (begin <= sample && sample < end) {
            table.widen(points, std::min(points.size(), 17 * table.size() + points.size() / 64));
        }
        for (std::size_t v = begin; v < end; ++v) {
            hash[v - begin] = PointTable::hash_of(points[v]);
            table.prefetch(hash[v - begin]);
        }
        for (std::size_t v = begin; v < end; ++v) {
            first[v] = table.find_or_note(points, points[v], hash[v - begin], static_cast<std::uint32_t>(v));
        }
    }
    return first;
}

// Replaces corners by the first of equal points, drops the triangles that this collapses and sets is_used of the points
// of the others. Returns the number of dropped triangles.
std::size_t drop_collapsed(TriangleMesh& mesh, const std::vector<std::uint32_t>& first,
                           std::vector<std::uint8_t>& is_used, SourceFaces* sources) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& old = mesh.triangles[t];
        const Triangle triangle{first[old[0]], first[old[1]], first[old[2]]};
        if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
        for (const std::uint32_t corner : triangle) is_used[corner] = 1;
        mesh.triangles[kept] = triangle;
        if (!mesh.cap_of.empty()) mesh.cap_of[kept] = mesh.cap_of[t];
        if (sources != nullptr) sources->of[kept] = sources->of[t];
        ++kept;
    }
    const std::size_t collapsed = mesh.triangles.size() - kept;
    mesh.triangles.resize(kept);
    if (!mesh.cap_of.empty()) mesh.cap_of.resize(kept);
    if (sources != nullptr) sources->of.resize(kept);
    return collapsed;
}

// Drops the points that are not used. `place`, one per point, is memory that is overwritten.
void drop_unused(TriangleMesh& mesh, const std::vector<std::uint8_t>& is_used, std::vector<std::uint32_t>& place) {
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        if (is_used[v] == 0) continue;
        mesh.points[kept] = mesh.points[v];
        place[v] = kept++;
    }
    if (kept == mesh.points.size()) return;
    mesh.points.resize(kept);
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& corner : t) corner = place[corner];
    }
}

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

using GridCell = std::array<std::int64_t, 3>;

class PointGroups {
 public:
    PointGroups(const TriangleMesh& mesh, double tolerance)
        : mesh_(mesh), tolerance_(tolerance), neighbours_(mesh.points.size()) {
        const Edges found = edges(mesh);
        std::vector<bool> is_border(mesh.points.size());
        for (const std::uint32_t h : unpaired(mesh, found).open) {
            is_border[start_of(mesh, h)] = true;
            is_border[end_of(mesh, h)] = true;
        }
        for (std::uint32_t h = 0; h < 3 * mesh.triangles.size(); ++h) {
            const std::uint32_t a = start_of(mesh, h);
            const std::uint32_t b = end_of(mesh, h);
            if (!is_border[a] || !is_border[b]) continue;
            neighbours_[a].push_back(b);
            neighbours_[b].push_back(a);
        }
        for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
            if (is_border[v]) place(v);
        }
    }

    // Per group its points; the first is kept.
    std::vector<std::vector<std::uint32_t>> members;

 private:
    GridCell cell_of(Vec3 p) const {
        const auto at = [&](double x) { return static_cast<std::int64_t>(std::floor(x / tolerance_)); };
        return {at(p.x), at(p.y), at(p.z)};
    }

    bool can_take(const std::vector<std::uint32_t>& group, std::uint32_t v) const {
        return std::all_of(group.begin(), group.end(), [&](std::uint32_t m) {
            return norm(mesh_.points[m] - mesh_.points[v]) <= tolerance_ &&
                   std::find(neighbours_[v].begin(), neighbours_[v].end(), m) == neighbours_[v].end();
        });
    }

    // Adds the point to the nearest group that can take it, or makes a group of it.
    void place(std::uint32_t v) {
        const GridCell home = cell_of(mesh_.points[v]);
        std::uint32_t best = none;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::int64_t i = 0; i < 27; ++i) {
            const auto cell = firsts_.find({home[0] + i % 3 - 1, home[1] + i / 3 % 3 - 1, home[2] + i / 9 - 1});
            if (cell == firsts_.end()) continue;
            for (const std::uint32_t c : cell->second) {
                const double far = norm(mesh_.points[members[c].front()] - mesh_.points[v]);
                if (far > nearest || (far == nearest && c > best) || !can_take(members[c], v)) continue;
                nearest = far;
                best = c;
            }
        }
        if (best != none) {
            members[best].push_back(v);
            return;
        }
        firsts_[home].push_back(static_cast<std::uint32_t>(members.size()));
        members.push_back({v});
    }

    const TriangleMesh& mesh_;
    double tolerance_;
    std::vector<std::vector<std::uint32_t>> neighbours_;
    std::map<GridCell, std::vector<std::uint32_t>> firsts_;  // groups whose first point lies in the cell
};

}  // namespace

WeldCounts weld(TriangleMesh& mesh, SourceFaces* sources) {
    assert(sources == nullptr || sources->of.size() == mesh.triangles.size());
    for (Vec3& p : mesh.points) p = positive_zeros(p);
    WeldCounts counts;
    std::vector<std::uint32_t> first = first_equal(mesh.points);
    for (std::size_t v = 0; v < first.size(); ++v) counts.welded += first[v] != v;
    const std::size_t different = mesh.points.size() - counts.welded;
    std::vector<std::uint8_t> is_used(mesh.points.size());
    counts.collapsed = drop_collapsed(mesh, first, is_used, sources);
    drop_unused(mesh, is_used, first);
    counts.unreferenced = different - mesh.points.size();
    return counts;
}

SnapBorders snap_borders(TriangleMesh& mesh, double tolerance, SourceFaces* sources) {
    SnapBorders result;
    if (!(tolerance > 0) || edges(mesh).faults.open == 0) return result;
    std::vector<Vec3> moved = mesh.points;
    for (const std::vector<std::uint32_t>& group : PointGroups(mesh, tolerance).members) {
        const Vec3 first = mesh.points[group.front()];
        for (const std::uint32_t v : group) {
            result.farthest = std::max(result.farthest, norm(mesh.points[v] - first));
            moved[v] = first;
        }
    }
    mesh.points = std::move(moved);
    result.welded = weld(mesh, sources).welded;
    return result;
}

}  // namespace qchopper
