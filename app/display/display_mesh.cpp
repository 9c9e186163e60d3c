// The order is that of a depth-first traversal over the edges, the right neighbour before the left, as in J. Rossignac,
// "Edgebreaker: connectivity compression for triangle meshes" (1999): it goes round what it has been at, so that the
// corners of a triangle were used just before, and a corner that is new is near the last new one. O(points +
// triangles).

#include "app/display/display_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/manifold.h"
#include "segment/mesh/point_table.h"
#include "segment/simplify/vertex_clustering.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// The mesh in steps of the grid, the skin first, then caps by ascending cut.
TriangleMesh on_grid(const TriangleMesh& mesh, const DisplayGrid& grid) {
    TriangleMesh result;
    std::vector<std::uint32_t> number(mesh.points.size());
    PointTable table(mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const DisplayPoint point = nearest_point(grid, mesh.points[i]);
        const Vec3 p{double(point[0]), double(point[1]), double(point[2])};
        const auto next = static_cast<std::uint32_t>(result.points.size());
        number[i] = table.find_or_note(result.points, p, PointTable::hash_of(p), next);
        if (number[i] == next) result.points.push_back(p);
    }
    std::vector<std::uint32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return cap_of(mesh, a) < cap_of(mesh, b); });
    for (const std::uint32_t t : order) {
        const Triangle& corner = mesh.triangles[t];
        const Triangle corners{number[corner[0]], number[corner[1]], number[corner[2]]};
        if (has_equal_corners(corners)) continue;
        result.triangles.push_back(corners);
        result.cap_of.push_back(cap_of(mesh, t));
    }
    return result;
}

// Half-edges, each where a triangle begins: every triangle once, groups in their order.
std::vector<std::uint32_t> traversal(const TriangleMesh& mesh) {
    const std::vector<std::uint32_t> twin = edges(mesh).twin;
    std::vector<bool> is_done(mesh.triangles.size(), false);
    std::vector<std::uint32_t> result;
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!is_done[t]) waiting.push_back(3 * t);
        while (!waiting.empty()) {
            const std::uint32_t begin = waiting.back();
            waiting.pop_back();
            if (is_done[begin / 3]) continue;
            is_done[begin / 3] = true;
            result.push_back(begin);
            for (const std::uint32_t side : {previous_in_triangle(begin), next_in_triangle(begin)}) {
                const std::uint32_t other = twin[side];
                const bool is_open = other != no_twin && !is_done[other / 3];
                if (is_open && mesh.cap_of[other / 3] == mesh.cap_of[t]) waiting.push_back(other);
            }
        }
    }
    return result;
}

bool is_group_after(const DisplayGroup& group, const DisplayGroup* before) {
    const bool is_skin = group.surface == DisplaySurface::skin;
    if (is_skin != (group.cut == no_cap) || group.cut < no_cap || group.faces == 0) return false;
    if (before == nullptr) return group.first == 0;
    return group.first == std::uint64_t{before->first} + before->faces && group.cut > before->cut;
}

}  // namespace

DisplayGrid display_grid(const Box& box) {
    const Vec3 size = box.size();
    const double longest = std::max({size.x, size.y, size.z});
    if (!std::isfinite(size.x + size.y + size.z)) {
        throw InputError(InputFault::mesh, "the mesh is too large to be shown", "check its unit");
    }
    const double step = std::max(longest / max_display_coordinate, std::numeric_limits<double>::min());
    return {box.min, longest > 0 ? step : 1};
}

DisplayPoint nearest_point(const DisplayGrid& grid, Vec3 p) {
    const auto steps = [&](double from_origin) {
        return static_cast<std::uint16_t>(
            std::clamp(std::round(from_origin / grid.step), 0.0, double{max_display_coordinate}));
    };
    return {steps(p.x - grid.origin.x), steps(p.y - grid.origin.y), steps(p.z - grid.origin.z)};
}

Vec3 place(const DisplayGrid& grid, const DisplayPoint& point) {
    return grid.origin + grid.step * Vec3{double(point[0]), double(point[1]), double(point[2])};
}

bool is_valid(const DisplayMesh& mesh) {
    const Vec3 farthest = place(mesh.grid, {max_display_coordinate, max_display_coordinate, max_display_coordinate});
    const Vec3& origin = mesh.grid.origin;
    for (const double x : {farthest.x, farthest.y, farthest.z, origin.x, origin.y, origin.z}) {
        if (!std::isfinite(x)) return false;
    }
    if (!(mesh.grid.step > 0)) return false;
    for (const DisplayPoint& p : mesh.points) {
        if (*std::max_element(p.begin(), p.end()) > max_display_coordinate) return false;
    }
    std::uint32_t used = 0;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) {
            if (corner > used) return false;
            if (corner == used) ++used;
        }
        if (has_equal_corners(t)) return false;
    }
    if (used != mesh.points.size()) return false;
    const DisplayGroup* before = nullptr;
    for (const DisplayGroup& group : mesh.groups) {
        if (!is_group_after(group, before)) return false;
        before = &group;
    }
    return mesh.triangles.size() == (before == nullptr ? 0 : std::uint64_t{before->first} + before->faces);
}

DisplayMesh display_mesh(const TriangleMesh& mesh, const DisplayGrid& grid) {
    assert(is_consistent(mesh));
    const TriangleMesh surface = on_grid(mesh, grid);
    DisplayMesh result{grid, {}, {}, {}};
    std::vector<std::uint32_t> number(surface.points.size(), none);
    for (const std::uint32_t begin : traversal(surface)) {
        Triangle corners{};
        std::uint32_t half_edge = begin;
        for (std::uint32_t& corner : corners) {
            const std::uint32_t point = start_of(surface, half_edge);
            half_edge = next_in_triangle(half_edge);
            if (number[point] == none) {
                const Vec3& p = surface.points[point];
                number[point] = static_cast<std::uint32_t>(result.points.size());
                result.points.push_back({static_cast<std::uint16_t>(p.x), static_cast<std::uint16_t>(p.y),
                                         static_cast<std::uint16_t>(p.z)});
            }
            corner = number[point];
        }
        const std::int32_t cut = surface.cap_of[begin / 3];
        if (result.groups.empty() || result.groups.back().cut != cut) {
            const auto first = static_cast<std::uint32_t>(result.triangles.size());
            result.groups.push_back({cut == no_cap ? DisplaySurface::skin : DisplaySurface::cap, cut, first, 0});
        }
        ++result.groups.back().faces;
        result.triangles.push_back(corners);
    }
    return result;
}

}  // namespace qchopper
