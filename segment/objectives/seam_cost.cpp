// Rays of each asked point in turn; then passes over the triangles until the values have reached all points.

#include "segment/objectives/seam_cost.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "segment/access/accessibility.h"
#include "segment/access/tool_directions.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/normals.h"
#include "segment/mesh/oriented_box.h"
#include "segment/mesh/rays.h"

namespace qchopper {
namespace {

constexpr std::size_t points_at_once = 16;
constexpr double above_surface = 1e-6;  // of the diagonal: where rays start
constexpr float not_known = -1;

// Gives the points that are not known the value of a neighbour that is, pass by pass.
void spread(const TriangleMesh& mesh, std::vector<float>& cost) {
    std::vector<std::uint32_t> open(mesh.triangles.size());  // triangles with a point that is not known
    for (std::uint32_t t = 0; t < open.size(); ++t) open[t] = t;
    for (std::size_t before = open.size() + 1; open.size() < before;) {
        before = open.size();
        const std::vector<float> known = cost;
        std::vector<std::uint32_t> rest;
        bool has_changed = false;
        for (const std::uint32_t t : open) {
            const Triangle& v = mesh.triangles[t];
            for (std::size_t k = 0; k < 3; ++k) {
                if (cost[v[k]] != not_known) continue;
                const float a = known[v[(k + 1) % 3]];
                cost[v[k]] = a != not_known ? a : known[v[(k + 2) % 3]];
                has_changed = has_changed || cost[v[k]] != not_known;
            }
            if (cost[v[0]] == not_known || cost[v[1]] == not_known || cost[v[2]] == not_known) rest.push_back(t);
        }
        open = std::move(rest);
        if (has_changed && !open.empty()) before = open.size() + 1;
    }
    std::replace(cost.begin(), cost.end(), not_known, 1.0F);
}

// The shares of the weights of the corners of a triangle at a point in it.
std::array<double, 3> weights_in(const std::array<Vec3, 3>& corner, Vec3 point) {
    const Vec3 area = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double square = dot(area, area);
    std::array<double, 3> weight{1, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        if (corner[k] == point || !(square > 0)) continue;
        const Vec3 opposite = cross(corner[(k + 1) % 3] - point, corner[(k + 2) % 3] - point);
        weight[k] = std::clamp(dot(opposite, area) / square, 0.0, 1.0);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        if (corner[k] == point) return {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
    }
    const double sum = weight[0] + weight[1] + weight[2];
    for (double& w : weight) w /= sum > 0 ? sum : 1;
    return weight;
}

}  // namespace

void find_seam_costs(std::span<Piece> uncut, const Context& context, std::size_t asked) {
    assert(asked > 0);
    std::vector<const TriangleMesh*> meshes;
    std::vector<Vec3> points;
    for (const Piece& piece : uncut) {
        meshes.push_back(piece.mesh.get());
        points.insert(points.end(), piece.mesh->points.begin(), piece.mesh->points.end());
    }
    if (points.empty()) return;
    const PreciseRays rays(meshes);
    const OrientedBox box = oriented_box(points);
    const std::vector<Vec3> directions = tool_directions(box.axis);
    const double start = above_surface * norm(box.size());
    const std::size_t step = (points.size() + asked - 1) / asked;
    for (std::size_t m = 0; m < uncut.size(); ++m) {
        const TriangleMesh& mesh = *meshes[m];
        const std::vector<Vec3> normals = vertex_normals(mesh);
        std::vector<float> cost(mesh.points.size(), not_known);
        const std::size_t count = (mesh.points.size() + step - 1) / step;
        parallel_ranges(0, count, points_at_once, [&](std::size_t first, std::size_t end) {
            context.check_cancelled();
            for (std::size_t i = first; i < end; ++i) {
                const std::size_t v = i * step;
                int above = 0;
                int open = 0;
                for (const Vec3 d : directions) {
                    if (dot(normals[v], d) < min_facing) continue;
                    ++above;
                    open += rays.first_hit(m, mesh.points[v] + start * normals[v], d) ? 0 : 1;
                }
                cost[v] = above > 0 ? static_cast<float>(open) / static_cast<float>(above) : 1;
            }
        });
        spread(mesh, cost);
        uncut[m].seam_cost = std::make_shared<const std::vector<float>>(std::move(cost));
    }
}

void pass_on_seam_costs(const Piece& parted, CutPieces& made) {
    if (!parted.seam_cost) return;
    const std::vector<float>& of_parted = *parted.seam_cost;
    for (std::size_t i = 0; i < made.pieces.size(); ++i) {
        const TriangleMesh& mesh = *made.pieces[i].mesh;
        std::vector<float> cost(mesh.points.size(), not_known);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const std::uint32_t parent = made.parent[i][t];
            if (parent == no_parent) continue;
            const Triangle& from = parted.mesh->triangles[parent];
            const std::array<Vec3, 3> corner = corners_of(*parted.mesh, parent);
            for (const std::uint32_t v : mesh.triangles[t]) {
                if (cost[v] != not_known) continue;
                const std::array<double, 3> weight = weights_in(corner, mesh.points[v]);
                double sum = 0;
                for (std::size_t k = 0; k < 3; ++k) sum += weight[k] * static_cast<double>(of_parted[from[k]]);
                cost[v] = static_cast<float>(sum);
            }
        }
        std::replace(cost.begin(), cost.end(), not_known, 1.0F);
        made.pieces[i].seam_cost = std::make_shared<const std::vector<float>>(std::move(cost));
    }
}

}  // namespace qchopper
