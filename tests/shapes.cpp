#include "tests/shapes.h"

#include <cmath>
#include <map>
#include <numbers>

namespace qchopper::shapes {
namespace {

using std::numbers::pi;

// Collects triangles by corner coordinates; equal coordinates become one vertex.
struct Builder {
    TriangleMesh mesh;
    std::map<std::array<double, 3>, std::uint32_t> index;
    std::uint32_t vertex(Vec3 p) {
        const auto [it, is_new] = index.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(mesh.points.size()));
        if (is_new) mesh.points.push_back(p);
        return it->second;
    }
    void triangle(Vec3 a, Vec3 b, Vec3 c) { mesh.triangles.push_back({vertex(a), vertex(b), vertex(c)}); }
    void quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }
};

double at(double low, double high, int i, int n) {
    return i == n ? high : low + (high - low) * i / n;
}

}  // namespace

TriangleMesh box(Vec3 min, Vec3 max, int n) {
    Builder b;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const auto corner = [&](double at_axis, int di, int dj) {
                    Vec3 p;
                    p[axis] = at_axis;
                    p[u] = at(min[u], max[u], i + di, n);
                    p[v] = at(min[v], max[v], j + dj, n);
                    return p;
                };
                b.quad(corner(max[axis], 0, 0), corner(max[axis], 1, 0), corner(max[axis], 1, 1),
                       corner(max[axis], 0, 1));
                b.quad(corner(min[axis], 0, 0), corner(min[axis], 0, 1), corner(min[axis], 1, 1),
                       corner(min[axis], 1, 0));
            }
        }
    }
    return b.mesh;
}

TriangleMesh ball(Vec3 centre, double radius, int rings) {
    Builder b;
    const int slices = 2 * rings;
    const auto point = [&](int i, int j) -> Vec3 {
        if (i == 0) return centre + Vec3{0, 0, radius};
        if (i == rings) return centre - Vec3{0, 0, radius};
        const double theta = pi * i / rings;
        const double phi = 2 * pi * (j % slices) / slices;
        return centre +
               radius * Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    };
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < slices; ++j) {
            if (i > 0) b.triangle(point(i, j), point(i + 1, j), point(i, j + 1));
            if (i + 1 < rings) b.triangle(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
        }
    }
    return b.mesh;
}

TriangleMesh torus(Vec3 centre, double ring_radius, double tube_radius, int n) {
    Builder b;
    const auto point = [&](int i, int j) {
        const double u = 2 * pi * (i % n) / n;
        const double v = 2 * pi * (j % n) / n;
        const double r = ring_radius + tube_radius * std::cos(v);
        return centre + Vec3{r * std::cos(u), r * std::sin(u), tube_radius * std::sin(v)};
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) b.quad(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
    }
    return b.mesh;
}

TriangleMesh stairs() {
    // Side outline in x, z; extruded along y. Triangulated by hand as three columns.
    Builder b;
    const double y0 = 0;
    const double y1 = 30;
    const double tops[3] = {10, 20, 30};
    for (int s = 0; s < 3; ++s) {
        const double x0 = 10.0 * s;
        const double x1 = 10.0 * (s + 1);
        for (int level = 0; level <= s; ++level) {
            const double z0 = 10.0 * level;
            const double z1 = 10.0 * (level + 1);
            b.quad({x0, y0, z0}, {x1, y0, z0}, {x1, y0, z1}, {x0, y0, z1});
            b.quad({x0, y1, z0}, {x0, y1, z1}, {x1, y1, z1}, {x1, y1, z0});
            if (level == s) b.quad({x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1}, {x0, y1, z0});  // riser
            if (s == 2) b.quad({x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, {x1, y0, z1});      // back
        }
        b.quad({x0, y0, tops[s]}, {x1, y0, tops[s]}, {x1, y1, tops[s]}, {x0, y1, tops[s]});
        b.quad({x0, y0, 0}, {x0, y1, 0}, {x1, y1, 0}, {x1, y0, 0});
    }
    return b.mesh;
}

TriangleMesh pyramid(Vec3 base_min, double side, double tall) {
    Builder b;
    const Vec3 p0 = base_min;
    const Vec3 p1 = base_min + Vec3{side, 0, 0};
    const Vec3 p2 = base_min + Vec3{side, side, 0};
    const Vec3 p3 = base_min + Vec3{0, side, 0};
    const Vec3 tip = base_min + Vec3{side / 2, side / 2, tall};
    b.quad(p0, p3, p2, p1);
    b.triangle(p0, p1, tip);
    b.triangle(p1, p2, tip);
    b.triangle(p2, p3, tip);
    b.triangle(p3, p0, tip);
    return b.mesh;
}

TriangleMesh turned_inside_out(TriangleMesh mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

TriangleMesh moved(TriangleMesh mesh, Vec3 by) {
    for (Vec3& p : mesh.points) p = p + by;
    return mesh;
}

TriangleMesh rotated(TriangleMesh mesh, Vec3 axis, double angle_rad) {
    const Vec3 k = normalized(axis);
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    for (Vec3& p : mesh.points) p = c * p + s * cross(k, p) + (dot(k, p) * (1 - c)) * k;
    return mesh;
}

TriangleMesh joined(const std::vector<TriangleMesh>& meshes) {
    TriangleMesh all;
    for (const TriangleMesh& mesh : meshes) {
        const auto first = static_cast<std::uint32_t>(all.points.size());
        all.points.insert(all.points.end(), mesh.points.begin(), mesh.points.end());
        for (const Triangle& t : mesh.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return all;
}

TriangleMesh nested() {
    return joined({box({0, 0, 0}, {100, 100, 100}, 4), turned_inside_out(box({20, 20, 20}, {80, 80, 80}, 3)),
                   ball({50, 50, 50}, 20, 12), turned_inside_out(ball({52, 49, 51}, 8, 8))});
}

TriangleMesh linked_tori() {
    const TriangleMesh second = moved(rotated(torus({0, 0, 0}, 50, 12, 20), {1, 0, 0}, pi / 2), {50, 0, 0});
    return joined({torus({0, 0, 0}, 50, 15, 24), turned_inside_out(torus({0, 0, 0}, 50, 6, 16)), second});
}

std::vector<Named> all_closed() {
    return {{"box", box({-10, -20, -30}, {10, 20, 30}), 1},
            {"grid box", box({0, 0, 0}, {40, 40, 40}, 8), 1},
            {"ball", ball({5, -3, 2}, 25), 1},
            {"torus", torus({0, 0, 0}, 40, 12), 1},
            {"stairs", stairs(), 1},
            {"pyramid", pyramid({0, 0, 0}, 20, 50), 1},
            {"nested", nested(), 2},
            {"linked tori", linked_tori(), 2},
            {"far away ball", ball({5e5, -3e5, 2e5}, 25), 1},
            {"two balls", joined({ball({0, 0, 0}, 10), ball({0, 0, 30}, 12)}), 2}};
}

}  // namespace qchopper::shapes
