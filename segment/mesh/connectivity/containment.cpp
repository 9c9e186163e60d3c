// Ray casting along the axes: crossings are counted with their orientation (is_inside), or with their parity per shell
// (shells_around). interior_point takes the middle of the longest segment inside along the lines of a grid, and then of
// the segments along the axes through it. shells_around follows one ray per shell upwards, and passes over blocks of
// triangles whose box is above none of them; O(triangles * rays) at worst.
//
// Single lines along the axes, before segment/raster in the order of folders: solid lines ask the same line_crossing.h.

#include "segment/mesh/connectivity/containment.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "segment/mesh/line_crossing.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

// Where a line along an axis crosses the surface.
struct Crossing {
    double at = 0;
    int depth_change = 0;  // 1 where the line enters the solid, -1 where it leaves it
};

// The part of a line between two crossings, inside the solid.
struct Segment {
    double low = 0;
    double high = 0;
    double length() const { return high - low; }
    double middle() const { return low + (high - low) / 2; }
};

// Lines along the coordinate axis w; u and v are the other axes.
struct AxisLines {
    int w;
    int u = (w + 1) % 3;
    int v = (w + 2) % 3;

    // Negated across, so that a line through the lower border of a face crosses it and one through the upper does not.
    LineCoordinates coordinates(Vec3 p) const { return {-p[v], -p[u], p[w]}; }

    bool is_crossed(const std::array<Vec3, 3>& corner, Vec3 through) const {
        const LineCoordinates line = coordinates(through);
        return line_crossing({coordinates(corner[0]), coordinates(corner[1]), coordinates(corner[2])}, line.height,
                             line.side)
            .has_value();
    }

    // The position is that in the triangle's plane. Nothing if the plane is parallel to the line.
    std::optional<Crossing> crossing(const std::array<Vec3, 3>& corner, Vec3 through) const {
        if (!is_crossed(corner, through)) return std::nullopt;
        const auto& [a, b, c] = corner;
        const Vec3 n = cross(b - a, c - a);
        if (n[w] == 0) return std::nullopt;
        const double at = a[w] - (n[u] * (through[u] - a[u]) + n[v] * (through[v] - a[v])) / n[w];
        return Crossing{at, n[w] > 0 ? -1 : 1};
    }
};

std::vector<Segment> segments(std::vector<Crossing> crossings) {
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.at < b.at; });
    std::vector<Segment> inside;
    int depth = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
        depth += crossings[i].depth_change;
        if (depth > 0) inside.push_back({crossings[i].at, crossings[i + 1].at});
    }
    return inside;
}

// The segments inside the solid of the line along an axis through a point, in their order.
std::vector<Segment> segments_along(const TriangleMesh& mesh, int axis, Vec3 through) {
    std::vector<Crossing> crossings;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (const auto c = AxisLines{axis}.crossing(corners_of(mesh, t), through)) crossings.push_back(*c);
    }
    return segments(std::move(crossings));
}

// The middle of the longest segment inside on a grid of lines along z. The offset keeps lines off round coordinates.
std::optional<Vec3> longest_middle(const TriangleMesh& mesh, int lines) {
    const Box box = bounds(mesh);
    const auto place = [&](int axis, double i) {
        return box.min[axis] + box.size()[axis] * (i + 0.5 + 0.0137 * (axis + 1)) / lines;
    };
    const auto first_line = [&](int axis, double at) {
        const double size = box.size()[axis];
        return size > 0 ? std::clamp(static_cast<int>((at - box.min[axis]) / size * lines) - 2, 0, lines) : 0;
    };
    const auto line_at = [lines](int i, int j) {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(lines) + static_cast<std::size_t>(j);
    };
    std::vector<std::vector<Crossing>> crossings(line_at(lines, 0));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::array<Vec3, 3> corner = corners_of(mesh, t);
        const auto [u_low, u_high] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
        const auto [v_low, v_high] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
        for (int i = first_line(0, u_low); i < lines && place(0, i) <= u_high; ++i) {
            for (int j = first_line(1, v_low); j < lines && place(1, j) <= v_high; ++j) {
                const auto c = AxisLines{2}.crossing(corner, {place(0, i), place(1, j), 0});
                if (c) crossings[line_at(i, j)].push_back(*c);
            }
        }
    }
    std::optional<Vec3> best;
    double longest = 0;
    for (int i = 0; i < lines; ++i) {
        for (int j = 0; j < lines; ++j) {
            for (const Segment& s : segments(std::move(crossings[line_at(i, j)]))) {
                if (s.length() <= longest) continue;
                longest = s.length();
                best = Vec3{place(0, i), place(1, j), s.middle()};
            }
        }
    }
    return best;
}

// Where the ray of one shell starts; all rays run upwards along z.
struct Start {
    Vec3 point;
    std::uint32_t shell = 0;
};

// The middle of the largest triangle of each selected shell: not a vertex or an edge, where shells may touch. Sorted by
// x.
std::vector<Start> ray_starts(const TriangleMesh& mesh, const Shells& shells, const std::vector<bool>& is_selected) {
    std::vector<double> largest(shells.count(), -1);
    std::vector<Start> starts(shells.count());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::uint32_t shell = shells.shell_of[t];
        if (!is_selected.empty() && !is_selected[shell]) continue;
        const double area = norm(area_vector(mesh, t));
        if (!(area > largest[shell])) continue;
        largest[shell] = area;
        const auto& [a, b, c] = corners_of(mesh, t);
        starts[shell] = {(1.0 / 3) * (a + b + c), shell};
    }
    std::erase_if(starts, [&](const Start& start) { return largest[start.shell] < 0; });
    std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) {
        return a.point.x != b.point.x ? a.point.x < b.point.x : a.shell < b.shell;
    });
    return starts;
}

bool ray_meets(Vec3 start, const std::array<Vec3, 3>& corner) {
    if (!AxisLines{2}.is_crossed(corner, start)) return false;
    const Vec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
    return dot(normal, start - corner[0]) * normal.z < 0;  // the triangle is above
}

void toggle(std::vector<std::uint32_t>& set, std::uint32_t shell) {
    const auto at = std::lower_bound(set.begin(), set.end(), shell);
    if (at != set.end() && *at == shell) {
        set.erase(at);
    } else {
        set.insert(at, shell);
    }
}

bool is_left_of(const Start& start, double x) {
    return start.point.x < x;
}

// Writes into `below` the starts that may lie below a triangle in this box.
void find_below(const std::vector<Start>& starts, const Box& box, std::vector<Start>& below) {
    below.clear();
    auto start = std::lower_bound(starts.begin(), starts.end(), box.min.x, is_left_of);
    for (; start != starts.end() && start->point.x <= box.max.x; ++start) {
        const Vec3 p = start->point;
        if (p.y >= box.min.y && p.y <= box.max.y && p.z <= box.max.z) below.push_back(*start);
    }
}

// One list per shell: the shells that its ray meets an odd number of times, ascending.
std::vector<std::vector<std::uint32_t>> met_by_rays(const TriangleMesh& mesh, const Shells& shells,
                                                    const std::vector<Start>& starts) {
    std::vector<std::vector<std::uint32_t>> met(shells.count());
    std::vector<Start> below;  // the current block
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (t % triangles_per_block == 0) {
            find_below(starts, shells.block[t / triangles_per_block], below);
            if (below.empty()) {
                t += triangles_per_block - 1;
                continue;
            }
        }
        const std::uint32_t shell = shells.shell_of[t];
        const std::array<Vec3, 3> corner = corners_of(mesh, t);
        const auto [min_x, max_x] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
        auto start = std::lower_bound(below.begin(), below.end(), min_x, is_left_of);
        for (; start != below.end() && start->point.x <= max_x; ++start) {
            if (start->shell != shell && ray_meets(start->point, corner)) toggle(met[start->shell], shell);
        }
    }
    return met;
}

}  // namespace

bool is_inside(const TriangleMesh& mesh, Vec3 point) {
    int depth = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto c = AxisLines{2}.crossing(corners_of(mesh, t), point);
        if (c && c->at < point.z) depth += c->depth_change;
    }
    return depth > 0;
}

std::optional<Vec3> interior_point(const TriangleMesh& mesh) {
    assert(is_consistent(mesh));
    std::optional<Vec3> point;
    for (int lines = 16; !point && lines <= 256; lines *= 4) point = longest_middle(mesh, lines);
    if (!point) return point;
    for (const int axis : {0, 1, 2, 0, 1, 2}) {  // to the middle of the segment that it lies in, axis by axis
        for (const Segment& s : segments_along(mesh, axis, *point)) {
            if ((*point)[axis] < s.low || (*point)[axis] > s.high) continue;
            (*point)[axis] = s.middle();
            break;
        }
    }
    return point;
}

IndexLists shells_around(const TriangleMesh& mesh, const Shells& shells, const std::vector<bool>& is_selected) {
    assert(shells.shell_of.size() == mesh.triangles.size() &&
           (is_selected.empty() || is_selected.size() == shells.count()));
    std::vector<Start> starts;
    if (shells.count() > 1) starts = ray_starts(mesh, shells, is_selected);
    IndexLists around;
    for (const std::vector<std::uint32_t>& met : met_by_rays(mesh, shells, starts)) {
        around.values.insert(around.values.end(), met.begin(), met.end());
        around.end_list();
    }
    return around;
}

}  // namespace qchopper
