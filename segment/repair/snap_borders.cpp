// Puts every border point into the nearest group that can take it, in the order of the points; a grid of cells as large
// as the tolerance finds the groups. O(triangles), and O(n log n) in the border points while cells hold few of them.

#include "segment/repair/snap_borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/manifold.h"
#include "segment/repair/weld.h"

namespace qchopper {
namespace {

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

SnapBorders weld_borders(TriangleMesh& mesh, double tolerance, SourceFaces* sources) {
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
