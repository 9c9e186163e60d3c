// Each cavity link of the whole mesh whose ends are both in a half joins two of its shells. The links are computed only
// if a half has more than one shell.

#include "segment/cut/half_solids.h"

#include <algorithm>

namespace qchopper {
namespace {

// One number per point of a mesh: its shell; 0 for points without a triangle.
std::vector<std::uint32_t> shell_of_points(const TriangleMesh& mesh, const Shells& shells) {
    std::vector<std::uint32_t> shell(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) shell[v] = shells.shell_of[t];
    }
    return shell;
}

HalfSolids solids_of_half(const TriangleMesh& mesh, Vec3 normal, Shells shells, const Half& half, bool above,
                          const std::vector<CavityLink>& links) {
    std::vector<std::array<std::uint32_t, 2>> pairs;
    if (shells.count() > 1 && !links.empty()) {
        const std::vector<std::uint32_t> shell = shell_of_points(half.mesh, shells);
        for (const CavityLink& link : links) {
            const std::uint32_t a = half.number[link.vertex];
            const std::uint32_t b = half.number[far_corner(mesh, link, normal, above)];
            if (a != no_parent && b != no_parent) pairs.push_back({shell[a], shell[b]});
        }
    }
    Solids solids = qchopper::solids(shells, pairs);
    return {std::move(shells), std::move(solids)};
}

}  // namespace

std::uint32_t far_corner(const TriangleMesh& mesh, const CavityLink& link, Vec3 normal, bool above) {
    const Triangle& v = mesh.triangles[link.triangle];
    return *std::max_element(v.begin(), v.end(), [&](std::uint32_t a, std::uint32_t b) {
        const double difference = height(normal, mesh.points[a]) - height(normal, mesh.points[b]);
        return above ? difference < 0 : difference > 0;
    });
}

SolidsOfHalves solids_of_halves(const TriangleMesh& mesh, const Plane& plane, const CutHalves& halves) {
    Shells above = shells(halves.above.mesh);
    Shells below = shells(halves.below.mesh);
    std::vector<CavityLink> all;
    if (above.count() > 1 || below.count() > 1) all = cavity_links(mesh, shells(mesh), plane.normal);
    return {solids_of_half(mesh, plane.normal, std::move(above), halves.above, true, all),
            solids_of_half(mesh, plane.normal, std::move(below), halves.below, false, all)};
}

}  // namespace qchopper
