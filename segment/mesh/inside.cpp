#include "segment/mesh/inside.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

// Where a line along an axis meets the surface: +1 where it comes in, -1 where it goes out.
struct Crossing {
    double at = 0;
    int turn = 0;
};

// The stretch of a line between two crossings, inside the solid.
struct Stretch {
    double low = 0;
    double high = 0;
    double length() const { return high - low; }
    double middle() const { return low + (high - low) / 2; }
};

// A mesh seen along one axis: (u, v) across, w along.
struct View {
    const TriangleMesh& mesh;
    int w;
    int u = (w + 1) % 3;
    int v = (w + 2) % 3;

    // Does the edge pass on the greater-u side of (at_u, at_v)? Asked lower end first, so both triangles agree.
    bool edge_counts(std::uint32_t a, std::uint32_t b, double at_u, double at_v) const {
        if (a > b) std::swap(a, b);
        const Vec3 p = mesh.points[a];
        const Vec3 q = mesh.points[b];
        if ((p[v] > at_v) == (q[v] > at_v)) return false;
        return at_u < (q[u] - p[u]) * ((at_v - p[v]) / (q[v] - p[v])) + p[u];
    }

    bool is_over(const Triangle& t, double at_u, double at_v) const {
        return (edge_counts(t[0], t[1], at_u, at_v) != edge_counts(t[1], t[2], at_u, at_v)) !=
               edge_counts(t[2], t[0], at_u, at_v);
    }

    std::optional<Crossing> crossing(const Triangle& t, double at_u, double at_v) const {
        if (!is_over(t, at_u, at_v)) return std::nullopt;
        const Vec3 a = mesh.points[t[0]];
        const Vec3 n = cross(mesh.points[t[1]] - a, mesh.points[t[2]] - a);
        if (n[w] == 0) return std::nullopt;  // seen edge-on: the line runs in its plane
        const double at = a[w] - (n[u] * (at_u - a[u]) + n[v] * (at_v - a[v])) / n[w];
        return Crossing{at, n[w] > 0 ? -1 : 1};
    }
};

std::vector<Stretch> stretches(std::vector<Crossing> crossings) {
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.at < b.at; });
    std::vector<Stretch> inside;
    int depth = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
        depth += crossings[i].turn;
        if (depth > 0) inside.push_back({crossings[i].at, crossings[i + 1].at});
    }
    return inside;
}

std::vector<Stretch> along(const View& view, Vec3 through) {
    std::vector<Crossing> crossings;
    for (const Triangle& t : view.mesh.triangles) {
        if (const auto c = view.crossing(t, through[view.u], through[view.v])) crossings.push_back(*c);
    }
    return stretches(std::move(crossings));
}

// The middle of the longest stretch of a grid of lines along z. The lines stand off the usual round coordinates.
std::optional<Vec3> longest_middle(const TriangleMesh& mesh, int lines) {
    const Box box = bounds(mesh);
    const View view{mesh, 2};
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
    for (const Triangle& t : mesh.triangles) {
        const auto [u_low, u_high] = std::minmax({mesh.points[t[0]].x, mesh.points[t[1]].x, mesh.points[t[2]].x});
        const auto [v_low, v_high] = std::minmax({mesh.points[t[0]].y, mesh.points[t[1]].y, mesh.points[t[2]].y});
        for (int i = first_line(0, u_low); i < lines && place(0, i) <= u_high; ++i) {
            for (int j = first_line(1, v_low); j < lines && place(1, j) <= v_high; ++j) {
                const auto c = view.crossing(t, place(0, i), place(1, j));
                if (c) crossings[line_at(i, j)].push_back(*c);
            }
        }
    }
    std::optional<Vec3> best;
    double longest = 0;
    for (int i = 0; i < lines; ++i) {
        for (int j = 0; j < lines; ++j) {
            for (const Stretch& s : stretches(std::move(crossings[line_at(i, j)]))) {
                if (s.length() <= longest) continue;
                longest = s.length();
                best = Vec3{place(0, i), place(1, j), s.middle()};
            }
        }
    }
    return best;
}

}  // namespace

bool contains(const TriangleMesh& mesh, Vec3 point) {
    int depth = 0;
    const View view{mesh, 2};
    for (const Triangle& t : mesh.triangles) {
        const auto c = view.crossing(t, point.x, point.y);
        if (c && c->at < point.z) depth += c->turn;
    }
    return depth > 0;
}

std::optional<Vec3> deep_point(const TriangleMesh& mesh) {
    assert(is_consistent(mesh));
    std::optional<Vec3> point;
    for (int lines = 16; !point && lines <= 256; lines *= 4) point = longest_middle(mesh, lines);
    if (!point) return point;
    for (const int axis : {0, 1, 2, 0, 1, 2}) {  // to the middle of the stretch it lies in, axis by axis
        for (const Stretch& s : along(View{mesh, axis}, *point)) {
            if ((*point)[axis] < s.low || (*point)[axis] > s.high) continue;
            (*point)[axis] = s.middle();
            break;
        }
    }
    return point;
}

}  // namespace qchopper
