#include "segment/mesh/shells.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "segment/mesh/disjoint_sets.h"
#include "segment/mesh/plane_frame.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr double touch_share = 1e-9;   // of the mesh: surfaces as near as this touch
constexpr double empty_share = 1e-12;  // of the cube of a shell's size: two sheets that coincide, in material or not

void grow(Box& box, Vec3 p) {
    box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
    box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
}

// A frame whose lines run along `along` at constant height and side. The rule ">= is above" makes every closed surface
// cross a line an even number of times, also through vertices.
struct LineFrame {
    Vec3 side;
    Vec3 along;
};

// One direction square to the axis, or another: a cavity whose farthest vertex touches another surface is asked again.
constexpr int directions = 6;
LineFrame line_frame(Vec3 axis, int number) {
    const PlaneFrame across = frame_across(normalized(axis));
    if (number == 0) return {across.v, across.u};
    const double c = std::cos(number * 1.1);
    const double s = std::sin(number * 1.1);
    return {c * across.v - s * across.u, c * across.u + s * across.v};
}

struct Coordinates {
    double h;
    double s;
    double t;
};

// The point at which an edge passes height h, always computed from its upper end: one edge, one point.
Coordinates at_height(const Coordinates& a, const Coordinates& b, double h) {
    const Coordinates& upper = a.h >= h ? a : b;
    const Coordinates& lower = a.h >= h ? b : a;
    const double f = (upper.h - h) / (upper.h - lower.h);
    return {h, upper.s + f * (lower.s - upper.s), upper.t + f * (lower.t - upper.t)};
}

std::optional<double> crossing(const Coordinates (&corner)[3], double h, double s) {
    Coordinates ends[2] = {};
    int count = 0;
    for (int k = 0; k < 3; ++k) {
        const Coordinates& a = corner[k];
        const Coordinates& b = corner[(k + 1) % 3];
        if ((a.h >= h) != (b.h >= h)) ends[count++] = at_height(a, b, h);
    }
    if (count != 2 || (ends[0].s >= s) == (ends[1].s >= s)) return std::nullopt;
    const Coordinates& right = ends[0].s >= s ? ends[0] : ends[1];
    const Coordinates& left = ends[0].s >= s ? ends[1] : ends[0];
    return right.t + (right.s - s) / (right.s - left.s) * (left.t - right.t);
}

// The line that looks for what is around one cavity.
struct Search {
    Coordinates start;
    Tether tether;
    double nearest = std::numeric_limits<double>::infinity();       // of all surface
    double nearest_exit = std::numeric_limits<double>::infinity();  // of surface through which the line leaves material
    bool is_touched = false;  // another surface at the vertex itself: what is around it there is not certain
};

// From the farthest vertex of each cavity that is asked for, in the order of their heights.
std::vector<Search> searches(const TriangleMesh& mesh, const Shells& shells, const LineFrame& frame, Vec3 axis,
                             const std::vector<bool>& is_asked) {
    std::vector<std::uint32_t> farthest(shells.count(), none);
    std::vector<double> best(shells.count(), -std::numeric_limits<double>::infinity());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::uint32_t shell = shells.shell_of[t];
        if (!is_asked[shell]) continue;
        for (const std::uint32_t v : mesh.triangles[t]) {
            const double along = dot(frame.along, mesh.points[v]);
            if (along <= best[shell]) continue;
            best[shell] = along;
            farthest[shell] = v;
        }
    }
    std::vector<Search> result;
    for (std::uint32_t shell = 0; shell < shells.count(); ++shell) {
        const std::uint32_t v = farthest[shell];
        if (v == none) continue;
        result.push_back({{dot(axis, mesh.points[v]), dot(frame.side, mesh.points[v]), best[shell]}, {shell, v, none}});
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Search& a, const Search& b) { return a.start.h < b.start.h; });
    return result;
}

// Half the extent of a box along a direction, with room for rounding.
double reach(const Box& box, Vec3 d) {
    const Vec3 half = 0.5 * box.size();
    const Vec3 far{std::max(std::abs(box.min.x), std::abs(box.max.x)),
                   std::max(std::abs(box.min.y), std::abs(box.max.y)),
                   std::max(std::abs(box.min.z), std::abs(box.max.z))};
    return std::abs(d.x) * (half.x + 1e-12 * far.x) + std::abs(d.y) * (half.y + 1e-12 * far.y) +
           std::abs(d.z) * (half.z + 1e-12 * far.z);
}

using SearchRange = std::pair<std::vector<Search>::iterator, std::vector<Search>::iterator>;

// The searches at whose heights a box lies.
SearchRange searches_at(std::vector<Search>& all, const Box& box, Vec3 axis) {
    const double middle = dot(axis, box.centre());
    const double half = reach(box, axis);
    const auto begin = std::lower_bound(all.begin(), all.end(), middle - half,
                                        [](const Search& s, double h) { return s.start.h < h; });
    const auto end =
        std::upper_bound(begin, all.end(), middle + half, [](double h, const Search& s) { return h < s.start.h; });
    return {begin, end};
}

// Could the line of this search still find something nearer in the box?
bool may_meet(const Search& search, const Box& box, const LineFrame& frame, double touch) {
    const Vec3 centre = box.centre();
    const double along = dot(frame.along, centre);
    const double half = reach(box, frame.along);
    return std::abs(dot(frame.side, centre) - search.start.s) <= reach(box, frame.side) &&
           along + half >= search.start.t - touch && along - half <= search.nearest + touch;
}

void try_triangle(Search& search, const TriangleMesh& mesh, const LineFrame& frame, Vec3 axis, std::size_t triangle,
                  double touch) {
    const Triangle& v = mesh.triangles[triangle];
    const double h[3] = {dot(axis, mesh.points[v[0]]), dot(axis, mesh.points[v[1]]), dot(axis, mesh.points[v[2]])};
    const int above = (h[0] >= search.start.h) + (h[1] >= search.start.h) + (h[2] >= search.start.h);
    if (above == 0 || above == 3) return;
    Coordinates corner[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = mesh.points[v[k]];
        corner[k] = {h[k], dot(frame.side, p), dot(frame.along, p)};
    }
    const std::optional<double> at = crossing(corner, search.start.h, search.start.s);
    if (!at) return;
    if (std::abs(*at - search.start.t) <= touch) search.is_touched = true;
    if (*at <= search.start.t) return;
    search.nearest = std::min(search.nearest, *at);
    if (*at >= search.nearest_exit || dot(area_vector(mesh, triangle), frame.along) <= 0) return;
    search.nearest_exit = *at;
    search.tether.triangle = static_cast<std::uint32_t>(triangle);
}

// Where the lines along one direction first leave material. One pass over the triangles.
std::vector<Search> look_along(const TriangleMesh& mesh, const Shells& shells, const LineFrame& frame, Vec3 axis,
                               const std::vector<bool>& is_asked, double touch) {
    std::vector<Search> all = searches(mesh, shells, frame, axis, is_asked);
    for (std::size_t b = 0; b < shells.block.size(); ++b) {
        const std::size_t last = std::min(mesh.triangles.size(), (b + 1) * triangles_per_block);
        const auto [begin, end] = searches_at(all, shells.block[b], axis);
        for (auto it = begin; it != end; ++it) {
            if (!may_meet(*it, shells.block[b], frame, touch)) continue;
            for (std::size_t t = b * triangles_per_block; t < last; ++t) {
                if (shells.shell_of[t] != it->tether.cavity) try_triangle(*it, mesh, frame, axis, t, touch);
            }
        }
    }
    return all;
}

}  // namespace

Shells shells(const TriangleMesh& mesh) {
    assert(is_consistent(mesh));
    DisjointSets sets(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        sets.unite(t[0], t[1]);
        sets.unite(t[0], t[2]);
    }
    // a parent is never larger, so one pass makes it the root
    for (std::uint32_t& parent : sets.parent) parent = sets.parent[parent];
    Shells result;
    result.shell_of.resize(mesh.triangles.size());
    std::vector<std::uint32_t> number(mesh.points.size(), none);
    std::vector<Vec3> origin;
    for (std::size_t begin = 0; begin < mesh.triangles.size(); begin += triangles_per_block) {
        const std::size_t end = std::min(mesh.triangles.size(), begin + triangles_per_block);
        const Vec3 start = mesh.points[mesh.triangles[begin][0]];
        Box block{start, start};
        Box run;  // of the triangles of one shell that follow each other
        std::uint32_t shell_of_run = none;
        const auto end_run = [&] {
            if (shell_of_run == none) return;
            for (const Vec3& p : {run.min, run.max}) {
                grow(result.box[shell_of_run], p);
                grow(block, p);
            }
        };
        for (std::size_t t = begin; t < end; ++t) {
            const Triangle& triangle = mesh.triangles[t];
            std::uint32_t& shell = number[sets.parent[triangle[0]]];
            const Vec3 a = mesh.points[triangle[0]];
            if (shell == none) {
                shell = static_cast<std::uint32_t>(origin.size());
                origin.push_back(a);
                result.volume.push_back(0);
                result.box.push_back({a, a});
            }
            result.shell_of[t] = shell;
            if (shell != shell_of_run) {
                end_run();
                shell_of_run = shell;
                run = {a, a};
            }
            const Vec3 o = origin[shell];
            const Vec3 b = mesh.points[triangle[1]];
            const Vec3 c = mesh.points[triangle[2]];
            result.volume[shell] += dot(a - o, cross(b - o, c - o)) / 6;
            for (const Vec3& p : {a, b, c}) grow(run, p);
        }
        end_run();
        result.block.push_back(block);
    }
    assert(result.box.size() == result.count());
    assert(result.block.size() == (mesh.triangles.size() + triangles_per_block - 1) / triangles_per_block);
    return result;
}

std::vector<Tether> tethers(const TriangleMesh& mesh, const Shells& shells, Vec3 axis) {
    assert(shells.shell_of.size() == mesh.triangles.size() && norm(axis) > 0);
    std::vector<Tether> result;
    if (shells.count() < 2) return result;
    std::vector<bool> is_asked(shells.count());
    Box all = shells.box.front();
    for (std::size_t shell = 0; shell < shells.count(); ++shell) {
        is_asked[shell] = shells.volume[shell] <= empty_share * std::pow(norm(shells.box[shell].size()), 3);
        grow(all, shells.box[shell].min);
        grow(all, shells.box[shell].max);
    }
    if (std::find(is_asked.begin(), is_asked.end(), true) == is_asked.end()) return result;
    const double touch = touch_share * norm(all.size());
    std::vector<Tether> doubtful;
    for (int number = 0; number < directions; ++number) {
        const LineFrame frame = line_frame(axis, number);
        for (const Search& s : look_along(mesh, shells, frame, axis, is_asked, touch)) {
            // The line must leave material where it first meets surface; else the shell is inside out, not a cavity.
            if (s.tether.triangle == none || s.nearest_exit > s.nearest + touch) continue;
            if (s.is_touched) {
                if (number == 0) doubtful.push_back(s.tether);
                continue;
            }
            assert(shells.shell_of[s.tether.triangle] != s.tether.cavity);
            result.push_back(s.tether);
            is_asked[s.tether.cavity] = false;
        }
        if (std::find(is_asked.begin(), is_asked.end(), true) == is_asked.end()) break;
    }
    for (const Tether& tether : doubtful) {
        if (is_asked[tether.cavity]) result.push_back(tether);
    }
    return result;
}

Solids solids(const Shells& shells, std::span<const std::array<std::uint32_t, 2>> ties) {
    Solids result;
    result.solid_of_shell.assign(shells.count(), none);
    DisjointSets sets(shells.count());
    for (const auto& [a, b] : ties) {
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
    std::vector<std::array<std::uint32_t, 2>> ties;
    std::vector<bool> is_tied(shells.count());
    for (const Tether& tether : tethers(mesh, shells, axis)) {
        ties.push_back({tether.cavity, shells.shell_of[tether.triangle]});
        is_tied[tether.cavity] = true;
    }
    Solids result = solids(shells, ties);
    for (std::size_t shell = 0; shell < shells.count(); ++shell) {
        if (shells.volume[shell] < 0 && !is_tied[shell]) ++result.loose_cavities;
    }
    assert(result.count <= shells.count());
    return result;
}

TriangleMesh extract(const TriangleMesh& mesh, const std::vector<std::uint32_t>& group_of, std::uint32_t group) {
    assert(group_of.size() == mesh.triangles.size());
    TriangleMesh part;
    std::vector<std::uint32_t> number(mesh.points.size(), none);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (group_of[t] != group) continue;
        Triangle triangle = mesh.triangles[t];
        for (std::uint32_t& v : triangle) {
            if (number[v] == none) {
                number[v] = static_cast<std::uint32_t>(part.points.size());
                part.points.push_back(mesh.points[v]);
            }
            v = number[v];
        }
        part.triangles.push_back(triangle);
        if (!mesh.cap_of.empty()) part.cap_of.push_back(mesh.cap_of[t]);
    }
    return part;
}

std::vector<TriangleMesh> split_solids(const TriangleMesh& mesh, Vec3 axis) {
    const Shells all_shells = shells(mesh);
    return split_solids(mesh, all_shells, solids(mesh, all_shells, axis));
}

std::vector<TriangleMesh> split_solids(const TriangleMesh& mesh, const Shells& all_shells, const Solids& all_solids) {
    if (all_solids.count == 1) return {mesh};
    // One pass for all solids: a scan can have hundreds.
    std::vector<TriangleMesh> parts(all_solids.count);
    std::vector<std::uint32_t> number(mesh.points.size(), none);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        TriangleMesh& part = parts[all_solids.solid_of_shell[all_shells.shell_of[t]]];
        Triangle triangle = mesh.triangles[t];
        for (std::uint32_t& v : triangle) {
            if (number[v] == none) {
                number[v] = static_cast<std::uint32_t>(part.points.size());
                part.points.push_back(mesh.points[v]);
            }
            v = number[v];
        }
        part.triangles.push_back(triangle);
        if (!mesh.cap_of.empty()) part.cap_of.push_back(mesh.cap_of[t]);
    }
    assert(std::all_of(parts.begin(), parts.end(), is_consistent));
    assert(std::none_of(parts.begin(), parts.end(), [](const TriangleMesh& p) { return p.triangles.empty(); }));
    return parts;
}

}  // namespace qchopper
