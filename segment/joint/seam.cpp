// Rays start a little above the old triangle beside the seam, and meet old triangles of all pieces, without the caps.

#include "segment/joint/seam.h"

#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <vector>

#include "segment/mesh/measure.h"
#include "segment/mesh/rays.h"

namespace qchopper {
namespace {

constexpr std::size_t direction_count = 64;

// Evenly spread over the sphere: a spiral of the golden angle.
std::array<Vec3, direction_count> spread_directions() {
    std::array<Vec3, direction_count> directions;
    for (std::size_t i = 0; i < direction_count; ++i) {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / direction_count;
        const double angle = static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5.0));
        const double r = std::sqrt(1 - z * z);
        directions[i] = {r * std::cos(angle), r * std::sin(angle), z};
    }
    return directions;
}

TriangleMesh old_surface(std::span<const Piece> pieces) {
    TriangleMesh all;
    for (const Piece& piece : pieces) {
        const auto first = static_cast<std::uint32_t>(all.points.size());
        all.points.insert(all.points.end(), piece.mesh->points.begin(), piece.mesh->points.end());
        for (std::size_t t = 0; t < piece.mesh->triangles.size(); ++t) {
            const Triangle& c = piece.mesh->triangles[t];
            if (cap_of(*piece.mesh, t) == no_cap) all.triangles.push_back({c[0] + first, c[1] + first, c[2] + first});
        }
    }
    return all;
}

double open_share(const RayTree& tree, Vec3 point, Vec3 normal, double above,
                  const std::array<Vec3, direction_count>& directions) {
    int asked = 0;
    int open = 0;
    for (const Vec3& direction : directions) {
        if (dot(direction, normal) <= 0) continue;
        ++asked;
        open += tree.meets(point + above * normal, direction) ? 0 : 1;
    }
    return asked > 0 ? static_cast<double>(open) / asked : 0;
}

std::uint64_t edge_key(std::uint32_t from, std::uint32_t to) {
    return std::uint64_t{from} << 32 | to;
}

// Half-edges of the caps on one side of their cut.
std::unordered_map<std::uint64_t, bool> cap_edges(const Piece& piece) {
    std::unordered_map<std::uint64_t, bool> edges;
    for (std::size_t t = 0; t < piece.mesh->triangles.size(); ++t) {
        const std::int32_t cut = cap_of(*piece.mesh, t);
        if (cut == no_cap) continue;
        bool is_above = true;
        for (const HalfSpace& half_space : piece.half_spaces) {
            if (half_space.cut == cut) is_above = half_space.above;
        }
        if (is_above) continue;
        const Triangle& c = piece.mesh->triangles[t];
        for (std::size_t i = 0; i < 3; ++i) edges[edge_key(c[i], c[(i + 1) % 3])] = true;
    }
    return edges;
}

}  // namespace

SeamLength seam_length(std::span<const Piece> pieces, double step, const Context& context) {
    const TriangleMesh surface = old_surface(pieces);
    const RayTree tree(surface);
    const double above = 1e-4 * norm(bounds(surface).size());
    const std::array<Vec3, direction_count> directions = spread_directions();
    SeamLength seam;
    double since = step;  // since visibility was asked
    double share = 0;
    for (const Piece& piece : pieces) {
        context.check_cancelled();
        const TriangleMesh& mesh = *piece.mesh;
        const auto of_caps = cap_edges(piece);
        for (std::size_t t = 0; t < mesh.triangles.size() && !of_caps.empty(); ++t) {
            if (cap_of(mesh, t) != no_cap) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = mesh.triangles[t][i];
                const std::uint32_t b = mesh.triangles[t][(i + 1) % 3];
                if (!of_caps.contains(edge_key(b, a))) continue;
                const double length = norm(mesh.points[b] - mesh.points[a]);
                since += length;
                if (since >= step) {
                    since = 0;
                    const Vec3 middle = 0.5 * (mesh.points[a] + mesh.points[b]);
                    share = open_share(tree, middle, normalized(area_vector(mesh, t)), above, directions);
                }
                seam.mm += length;
                seam.visible_mm += share * length;
            }
        }
    }
    return seam;
}

}  // namespace qchopper
