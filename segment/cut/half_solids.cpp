#include "segment/cut/half_solids.h"

#include <algorithm>

namespace qchopper {
namespace {

// Per point of a mesh, a shell that it belongs to.
std::vector<std::uint32_t> shell_of_points(const TriangleMesh& mesh, const Shells& shells) {
    std::vector<std::uint32_t> shell(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) shell[v] = shells.shell_of[t];
    }
    return shell;
}

// A half's points are those of the mesh on its side, in their order; then those of the cap.
std::vector<std::uint32_t> number_in_half(const TriangleMesh& mesh, const Plane& plane, bool above) {
    std::vector<std::uint32_t> number(mesh.points.size(), no_parent);
    std::uint32_t count = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        if ((height(plane.normal, mesh.points[v]) >= plane.offset) == above) number[v] = count++;
    }
    return number;
}

HalfSolids solids_of_half(const TriangleMesh& mesh, const Plane& plane, Shells shells, const Half& half, bool above,
                          const std::vector<Tether>& tethers) {
    std::vector<std::array<std::uint32_t, 2>> ties;
    if (shells.count() > 1 && !tethers.empty()) {
        const std::vector<std::uint32_t> shell = shell_of_points(half.mesh, shells);
        const std::vector<std::uint32_t> number = number_in_half(mesh, plane, above);
        for (const Tether& tether : tethers) {
            const std::uint32_t a = number[tether.vertex];
            const std::uint32_t b = number[far_corner(mesh, tether, plane.normal, above)];
            if (a != no_parent && b != no_parent) ties.push_back({shell[a], shell[b]});
        }
    }
    Solids solids = qchopper::solids(shells, ties);
    return {std::move(shells), std::move(solids)};
}

}  // namespace

std::uint32_t far_corner(const TriangleMesh& mesh, const Tether& tether, Vec3 normal, bool above) {
    const Triangle& v = mesh.triangles[tether.triangle];
    return *std::max_element(v.begin(), v.end(), [&](std::uint32_t a, std::uint32_t b) {
        const double difference = height(normal, mesh.points[a]) - height(normal, mesh.points[b]);
        return above ? difference < 0 : difference > 0;
    });
}

SolidsOfHalves solids_of_halves(const TriangleMesh& mesh, const Plane& plane, const CutHalves& halves) {
    Shells above = shells(halves.above.mesh);
    Shells below = shells(halves.below.mesh);
    std::vector<Tether> all;
    if (above.count() > 1 || below.count() > 1) all = tethers(mesh, shells(mesh), plane.normal);
    return {solids_of_half(mesh, plane, std::move(above), halves.above, true, all),
            solids_of_half(mesh, plane, std::move(below), halves.below, false, all)};
}

}  // namespace qchopper
