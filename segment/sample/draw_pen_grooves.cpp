// A line is the intersection of the surface with a plane or a ball, traced from triangle to triangle. Start triangles
// and directions are spread by the golden ratio. The points near the line sink by a smooth profile across it.
// O(triangles), and for each line the triangles and points near it.

#include "segment/sample/draw_pen_grooves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/normals.h"
#include "segment/mesh/plane_frame.h"

namespace qchopper {
namespace {

double mean_edge(const TriangleMesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) sum += norm(mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]]);
    }
    return sum / static_cast<double>(std::max<std::size_t>(3 * mesh.triangles.size(), 1));
}

// A surface in space whose intersection with the mesh is the line: a plane, or a ball for a bent line.
struct Guide {
    Vec3 middle;
    Vec3 normal;        // of the plane
    double radius = 0;  // of the ball; 0: a plane
    bool is_above(Vec3 p) const {
        const Vec3 d = p - middle;
        return radius > 0 ? dot(d, d) >= radius * radius : dot(d, normal) >= 0;
    }
    double value(Vec3 p) const {
        const Vec3 d = p - middle;
        return radius > 0 ? norm(d) - radius : dot(d, normal);
    }
};

Guide guide_through(const TriangleMesh& mesh, std::size_t triangle, int number, double length) {
    const Triangle& t = mesh.triangles[triangle];
    const Vec3 middle = (1.0 / 3) * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]);
    const PlaneFrame frame = frame_across(normalized(area_vector(mesh, triangle)));
    const double angle = 2 * std::numbers::pi * std::fmod(number * std::numbers::phi, 1.0);
    const Vec3 side = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
    if (number % 2 == 0) return {middle, side, 0};
    const double radius = 0.6 * length;
    return {middle + radius * side, side, radius};
}

struct TracedLine {
    std::vector<Vec3> line;
    std::vector<std::size_t> triangles;
    double length = 0;
};

// From triangle to triangle across the edges that the guide crosses, until the line is long enough. It ends early at a
// hole, or where it meets itself.
TracedLine trace(const TriangleMesh& mesh, const Edges& edges, std::size_t start, const Guide& guide, double length) {
    TracedLine traced;
    std::set<std::size_t> visited;
    std::uint32_t entry = no_twin;
    for (std::size_t t = start; traced.length < length && visited.insert(t).second;) {
        traced.triangles.push_back(t);
        std::uint32_t exit = no_twin;
        for (std::uint32_t h = static_cast<std::uint32_t>(3 * t); h < 3 * t + 3 && exit == no_twin; ++h) {
            const Vec3 a = mesh.points[mesh.triangles[t][h % 3]];
            const Vec3 b = mesh.points[mesh.triangles[t][(h % 3 + 1) % 3]];
            if (h == entry || guide.is_above(a) == guide.is_above(b)) continue;
            const double at = guide.value(a) / (guide.value(a) - guide.value(b));
            const Vec3 p = a + at * (b - a);
            if (!traced.line.empty()) traced.length += norm(p - traced.line.back());
            traced.line.push_back(p);
            exit = h;
        }
        if (exit == no_twin || edges.twin[exit] == no_twin) break;
        entry = edges.twin[exit];
        t = entry / 3;
    }
    return traced;
}

// Whether the surface along the line is smooth, without a crest or a crease.
bool is_smooth(const TriangleMesh& mesh, const std::vector<Vec3>& normals, const Edges& edges,
               const TracedLine& traced) {
    constexpr double min_cosine = 0.9;
    const auto is_near = [&](std::size_t t, Vec3 normal) {
        for (const std::uint32_t corner : mesh.triangles[t]) {
            if (dot(normals[corner], normal) < min_cosine) return false;
        }
        return true;
    };
    for (const std::size_t t : traced.triangles) {
        const Vec3 normal = normalized(area_vector(mesh, t));
        for (std::size_t h = 3 * t; h < 3 * t + 3; ++h) {
            if (edges.twin[h] == no_twin || !is_near(edges.twin[h] / 3, normal)) return false;
            const std::uint32_t beside = edges.twin[h] / 3;
            for (std::size_t k = 3 * std::size_t{beside}; k < 3 * std::size_t{beside} + 3; ++k) {
                if (edges.twin[k] == no_twin || !is_near(edges.twin[k] / 3, normal)) return false;
            }
        }
    }
    return true;
}

double distance_to_line(const std::vector<Vec3>& line, Vec3 p) {
    double best = INFINITY;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec3 along = line[i + 1] - line[i];
        const double length = dot(along, along);
        const double at = length > 0 ? std::clamp(dot(p - line[i], along) / length, 0.0, 1.0) : 0;
        best = std::min(best, norm(p - line[i] - at * along));
    }
    return best;
}

// Sets the depths of the points within half a width of the line that are connected with it on the surface.
void deepen(const TriangleMesh& mesh, const std::vector<std::vector<std::uint32_t>>& triangles_at,
            const TracedLine& traced, double width, double depth, std::vector<double>& depths) {
    std::set<std::uint32_t> reached;
    std::vector<std::uint32_t> to_do;
    const auto add_corners = [&](std::size_t t) {
        for (const std::uint32_t corner : mesh.triangles[t]) {
            if (reached.insert(corner).second) to_do.push_back(corner);
        }
    };
    for (const std::size_t t : traced.triangles) add_corners(t);
    while (!to_do.empty()) {
        const std::uint32_t i = to_do.back();
        to_do.pop_back();
        const double share = distance_to_line(traced.line, mesh.points[i]) / (0.5 * width);
        if (share >= 1) continue;
        const double profile = (1 - share * share) * (1 - share * share);
        depths[i] = std::max(depths[i], depth * profile);
        for (const std::uint32_t t : triangles_at[i]) add_corners(t);
    }
}

}  // namespace

DrawnPenGrooves draw_pen_grooves(TriangleMesh& mesh, const DrawOptions& options) {
    DrawnPenGrooves drawn;
    drawn.width = options.width > 0 ? options.width : std::max(4.0, 3.5 * mean_edge(mesh));
    drawn.depth = options.depth > 0 ? options.depth : drawn.width / 10;
    const double length = 14 * drawn.width;
    const Edges found = edges(mesh);
    std::vector<std::vector<std::uint32_t>> triangles_at(mesh.points.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t corner : mesh.triangles[t]) triangles_at[corner].push_back(t);
    }
    std::vector<double> depths(mesh.points.size(), 0);
    const std::size_t count = mesh.triangles.size();
    const std::vector<Vec3> normals = vertex_normals(mesh);
    constexpr int max_tries = 300;
    for (int groove = 0; groove < options.pen_grooves && count > 0; ++groove) {
        for (int attempt = 0; attempt < max_tries; ++attempt) {
            const double place = std::fmod((groove + 0.5) / options.pen_grooves + attempt * std::numbers::phi, 1.0);
            const auto start = std::min(count - 1, static_cast<std::size_t>(place * static_cast<double>(count)));
            const Guide guide = guide_through(mesh, start, groove + 2 * attempt, length);
            const TracedLine traced = trace(mesh, found, start, guide, length);
            if (traced.length < length || !is_smooth(mesh, normals, found, traced)) continue;
            deepen(mesh, triangles_at, traced, drawn.width, drawn.depth, depths);
            drawn.lines.push_back(traced.line);
            break;
        }
    }
    for (std::size_t i = 0; i < depths.size(); ++i) {
        if (depths[i] == 0) continue;
        mesh.points[i] = mesh.points[i] - depths[i] * normals[i];
        ++drawn.points_moved;
    }
    return drawn;
}

}  // namespace qchopper
