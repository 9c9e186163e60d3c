// Cavities: a line from the vertex of each that is farthest along a direction perpendicular to the axis, in that
// direction. All lines of one direction in one pass over the triangles; the boxes of blocks of triangles
// (Shells::block) exclude most of them. O(triangles + blocks * log cavities), O(triangles * cavities) at worst.
// Not by solid_lines.h, which stands after it: the lines are no grid.

#include "segment/mesh/connectivity/solids.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/line_crossing.h"
#include "segment/mesh/plane_frame.h"
#include "segment/mesh/submesh.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr double touch_share = 1e-9;   // of the mesh: surfaces so close to each other touch
constexpr double empty_share = 1e-12;  // of the cube of a shell's size: two sheets that coincide, in material or not

// Lines along `along`, at constant height and side.
struct LineFrame {
    Vec3 side;
    Vec3 along;
};

// Directions perpendicular to the axis, by number: more than one, for cavities that touch another surface at their
// farthest vertex.
constexpr int directions = 6;
LineFrame line_frame(Vec3 axis, int number) {
    const PlaneFrame across = frame_across(normalized(axis));
    if (number == 0) return {across.v, across.u};
    const double c = std::cos(number * 1.1);
    const double s = std::sin(number * 1.1);
    return {c * across.v - s * across.u, c * across.u + s * across.v};
}

// The line from one cavity to what encloses it.
struct Query {
    LineCoordinates start;
    CavityLink link;
    double nearest = std::numeric_limits<double>::infinity();       // of all surface
    double nearest_exit = std::numeric_limits<double>::infinity();  // of surface through which the line leaves material
    bool is_touched = false;  // another surface at the vertex itself: the result is not certain
};

// From the farthest vertex of each selected shell, in the order of their heights.
std::vector<Query> queries(const TriangleMesh& mesh, const Shells& shells, const LineFrame& frame, Vec3 axis,
                           const std::vector<bool>& is_selected) {
    std::vector<std::uint32_t> farthest(shells.count(), none);
    std::vector<double> best(shells.count(), -std::numeric_limits<double>::infinity());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::uint32_t shell = shells.shell_of[t];
        if (!is_selected[shell]) continue;
        for (const std::uint32_t v : mesh.triangles[t]) {
            const double along = dot(frame.along, mesh.points[v]);
            if (along <= best[shell]) continue;
            best[shell] = along;
            farthest[shell] = v;
        }
    }
    std::vector<Query> result;
    for (std::uint32_t shell = 0; shell < shells.count(); ++shell) {
        const std::uint32_t v = farthest[shell];
        if (v == none) continue;
        result.push_back({{dot(axis, mesh.points[v]), dot(frame.side, mesh.points[v]), best[shell]}, {shell, v, none}});
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Query& a, const Query& b) { return a.start.height < b.start.height; });
    return result;
}

// Half the extent of a box along a direction, with a margin for rounding.
double reach(const Box& box, Vec3 d) {
    const Vec3 half = 0.5 * box.size();
    const Vec3 far{std::max(std::abs(box.min.x), std::abs(box.max.x)),
                   std::max(std::abs(box.min.y), std::abs(box.max.y)),
                   std::max(std::abs(box.min.z), std::abs(box.max.z))};
    return std::abs(d.x) * (half.x + 1e-12 * far.x) + std::abs(d.y) * (half.y + 1e-12 * far.y) +
           std::abs(d.z) * (half.z + 1e-12 * far.z);
}

// The queries at whose heights a box lies.
std::span<Query> queries_at(std::vector<Query>& all, const Box& box, Vec3 axis) {
    const double middle = dot(axis, box.centre());
    const double half = reach(box, axis);
    const auto begin = std::lower_bound(all.begin(), all.end(), middle - half,
                                        [](const Query& s, double h) { return s.start.height < h; });
    const auto end =
        std::upper_bound(begin, all.end(), middle + half, [](double h, const Query& s) { return h < s.start.height; });
    return {begin, end};
}

// Whether the line of this query may meet something nearer in the box.
bool may_meet(const Query& query, const Box& box, const LineFrame& frame, double touch) {
    const Vec3 centre = box.centre();
    const double along = dot(frame.along, centre);
    const double half = reach(box, frame.along);
    return std::abs(dot(frame.side, centre) - query.start.side) <= reach(box, frame.side) &&
           along + half >= query.start.along - touch && along - half <= query.nearest + touch;
}

void try_triangle(Query& query, const TriangleMesh& mesh, const LineFrame& frame, Vec3 axis, std::size_t triangle,
                  double touch) {
    const Triangle& v = mesh.triangles[triangle];
    const double h[3] = {dot(axis, mesh.points[v[0]]), dot(axis, mesh.points[v[1]]), dot(axis, mesh.points[v[2]])};
    const int above = (h[0] >= query.start.height) + (h[1] >= query.start.height) + (h[2] >= query.start.height);
    if (above == 0 || above == 3) return;
    std::array<LineCoordinates, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = mesh.points[v[k]];
        corner[k] = {h[k], dot(frame.side, p), dot(frame.along, p)};
    }
    const std::optional<double> at = line_crossing(corner, query.start.height, query.start.side);
    if (!at) return;
    if (std::abs(*at - query.start.along) <= touch) query.is_touched = true;
    if (*at <= query.start.along) return;
    query.nearest = std::min(query.nearest, *at);
    if (*at >= query.nearest_exit || dot(area_vector(mesh, triangle), frame.along) <= 0) return;
    query.nearest_exit = *at;
    query.link.triangle = static_cast<std::uint32_t>(triangle);
}

// Where the lines along one direction first leave material. One pass over the triangles.
std::vector<Query> query_along(const TriangleMesh& mesh, const Shells& shells, const LineFrame& frame, Vec3 axis,
                               const std::vector<bool>& is_selected, double touch) {
    std::vector<Query> all = queries(mesh, shells, frame, axis, is_selected);
    for (std::size_t b = 0; b < shells.block.size(); ++b) {
        const std::size_t last = std::min(mesh.triangles.size(), (b + 1) * triangles_per_block);
        for (Query& query : queries_at(all, shells.block[b], axis)) {
            if (!may_meet(query, shells.block[b], frame, touch)) continue;
            for (std::size_t t = b * triangles_per_block; t < last; ++t) {
                if (shells.shell_of[t] != query.link.cavity) try_triangle(query, mesh, frame, axis, t, touch);
            }
        }
    }
    return all;
}

}  // namespace

std::vector<CavityLink> cavity_links(const TriangleMesh& mesh, const Shells& shells, Vec3 axis) {
    assert(shells.shell_of.size() == mesh.triangles.size() && norm(axis) > 0);
    std::vector<CavityLink> result;
    if (shells.count() < 2) return result;
    std::vector<bool> is_selected(shells.count());
    Box all = shells.box.front();
    for (std::size_t shell = 0; shell < shells.count(); ++shell) {
        is_selected[shell] = shells.volume[shell] <= empty_share * std::pow(norm(shells.box[shell].size()), 3);
        extend(all, shells.box[shell].min);
        extend(all, shells.box[shell].max);
    }
    const double touch = touch_share * norm(all.size());
    const auto is_any_left = [&] {
        return std::find(is_selected.begin(), is_selected.end(), true) != is_selected.end();
    };
    std::vector<CavityLink> doubtful;
    for (int number = 0; number < directions && is_any_left(); ++number) {
        const LineFrame frame = line_frame(axis, number);
        for (const Query& s : query_along(mesh, shells, frame, axis, is_selected, touch)) {
            // The line must leave material where it first meets surface; else the shell is inside out, not a cavity.
            if (s.link.triangle == none || s.nearest_exit > s.nearest + touch) continue;
            if (s.is_touched) {
                if (number == 0) doubtful.push_back(s.link);
                continue;
            }
            assert(shells.shell_of[s.link.triangle] != s.link.cavity);
            result.push_back(s.link);
            is_selected[s.link.cavity] = false;
        }
    }
    for (const CavityLink& link : doubtful) {
        if (is_selected[link.cavity]) result.push_back(link);
    }
    return result;
}

Solids solids(const Shells& shells, std::span<const std::array<std::uint32_t, 2>> pairs) {
    Solids result;
    result.solid_of_shell.assign(shells.count(), none);
    DisjointSets sets(shells.count());
    for (const auto& [a, b] : pairs) {
        assert(a < shells.count() && b < shells.count());
        sets.unite(a, b);
    }
    for (std::uint32_t shell = 0; shell < shells.count(); ++shell) {
        std::uint32_t& solid = result.solid_of_shell[sets.root(shell)];
        if (solid == none) solid = static_cast<std::uint32_t>(result.count++);
        result.solid_of_shell[shell] = solid;
    }
    return result;
}

Solids solids(const TriangleMesh& mesh, const Shells& shells, Vec3 axis) {
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (const CavityLink& link : cavity_links(mesh, shells, axis)) {
        pairs.push_back({link.cavity, shells.shell_of[link.triangle]});
    }
    return solids(shells, pairs);
}

std::vector<std::uint32_t> solid_of_triangle(const Shells& shells, const Solids& solids) {
    std::vector<std::uint32_t> solid_of;
    solid_of.reserve(shells.shell_of.size());
    for (const std::uint32_t shell : shells.shell_of) solid_of.push_back(solids.solid_of_shell[shell]);
    return solid_of;
}

std::vector<TriangleMesh> split_solids(const TriangleMesh& mesh, Vec3 axis) {
    const Shells all_shells = shells(mesh);
    return split_solids(mesh, all_shells, solids(mesh, all_shells, axis));
}

std::vector<TriangleMesh> split_solids(const TriangleMesh& mesh, const Shells& shells, const Solids& solids) {
    if (solids.count == 1) return {mesh};
    std::vector<TriangleMesh> parts = submeshes(mesh, solid_of_triangle(shells, solids), solids.count);
    assert(std::none_of(parts.begin(), parts.end(), [](const TriangleMesh& p) { return p.triangles.empty(); }));
    return parts;
}

}  // namespace qchopper
