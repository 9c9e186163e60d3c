// Boxes and bodies of revolution as triangles, for the pictures of a job.

#include "cam/job/sheet/solid_shapes.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace qchopper {
namespace {

void add_box(TriangleMesh& mesh, const Box& box) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (std::uint32_t i = 0; i < 8; ++i) {
        mesh.points.push_back({(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                               (i & 4) != 0 ? box.max.z : box.min.z});
    }
    constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& s : sides) {
        mesh.triangles.push_back({first + s[0], first + s[1], first + s[2]});
        mesh.triangles.push_back({first + s[0], first + s[2], first + s[3]});
    }
}

}  // namespace

std::array<Box, 12> edges_of(const Box& box) {
    std::array<Box, 12> edges;
    edges.fill(box);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const int axis = static_cast<int>(i / 4);
        for (const auto& [across, is_at_max] :
             {std::pair((axis + 1) % 3, (i & 2) != 0), std::pair((axis + 2) % 3, (i & 1) != 0)}) {
            edges[i].min[across] = edges[i].max[across] = is_at_max ? box.max[across] : box.min[across];
        }
    }
    return edges;
}

void add_bar(TriangleMesh& mesh, const Box& edge, double half_width) {
    const Vec3 half{half_width, half_width, half_width};
    add_box(mesh, {edge.min - half, edge.max + half});
}

TriangleMesh turned_profile(Vec3 origin, Vec3 axis, const Profile& profile, std::uint32_t sides) {
    const Vec3 aside = std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = normalized(cross(axis, aside));
    const Vec3 v = cross(axis, u);
    TriangleMesh mesh;
    for (const auto& [along, radius] : profile) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            mesh.points.push_back(origin + along * axis + radius * (std::cos(angle) * u + std::sin(angle) * v));
        }
    }
    for (std::uint32_t ring = 0; ring + 1 < profile.size(); ++ring) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t a = ring * sides + i;
            const std::uint32_t b = ring * sides + (i + 1) % sides;
            mesh.triangles.push_back({a, b, b + sides});
            mesh.triangles.push_back({a, b + sides, a + sides});
        }
    }
    return mesh;
}

TriangleMesh ball_mesh(Vec3 middle, double radius) {
    Profile profile;
    constexpr int rings = 8;
    for (int i = 0; i <= rings; ++i) {
        const double angle = std::numbers::pi * i / rings;
        profile.emplace_back(-radius * std::cos(angle), radius * std::sin(angle));
    }
    return turned_profile(middle, {0, 0, 1}, profile);
}

TriangleMesh box_mesh(const PlacedBox& box) {
    TriangleMesh mesh;
    add_box(mesh, {-box.half, box.half});
    for (Vec3& p : mesh.points) p = apply(box.box_in_frame, p);
    return mesh;
}

TriangleMesh capsule_mesh(const Capsule& capsule) {
    constexpr int rings = 6;  // of each end
    const Vec3 along = capsule.to - capsule.from;
    const double length = norm(along);
    Profile profile;
    for (int i = 0; i <= rings; ++i) {
        const double angle = 0.5 * std::numbers::pi * i / rings;
        profile.emplace_back(-capsule.radius * std::cos(angle), capsule.radius * std::sin(angle));
    }
    for (int i = 0; i <= rings; ++i) {
        const double angle = 0.5 * std::numbers::pi * i / rings;
        profile.emplace_back(length + capsule.radius * std::sin(angle), capsule.radius * std::cos(angle));
    }
    return turned_profile(capsule.from, length > 0 ? (1 / length) * along : Vec3{0, 0, 1}, profile, 24);
}

TriangleMesh cylinder_mesh(const Cylinder& cylinder) {
    const Vec3 along = cylinder.to - cylinder.from;
    const double length = norm(along);
    const Profile profile{{0, 0}, {0, cylinder.radius}, {length, cylinder.radius}, {length, 0}};
    return turned_profile(cylinder.from, length > 0 ? (1 / length) * along : Vec3{0, 0, 1}, profile, 32);
}

}  // namespace qchopper
