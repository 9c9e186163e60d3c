#include "segment/repair/nesting.h"

#include <algorithm>
#include <cstddef>

namespace qchopper {
namespace {

// Where the ray of one shell starts; all rays go up along z.
struct Start {
    Vec3 point;
    std::uint32_t shell = 0;
};

// The middle of each shell's largest triangle: never a point where two shells touch. Sorted by x.
std::vector<Start> ray_starts(const TriangleMesh& mesh, const Shells& shells) {
    std::vector<double> largest(shells.count(), -1);
    std::vector<Start> starts(shells.count());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::uint32_t shell = shells.shell_of[t];
        const double area = norm(area_vector(mesh, t));
        if (!(area > largest[shell])) continue;
        largest[shell] = area;
        const Triangle& corner = mesh.triangles[t];
        const Vec3 sum = mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]];
        starts[shell] = {(1.0 / 3) * sum, shell};
    }
    std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) {
        return a.point.x != b.point.x ? a.point.x < b.point.x : a.shell < b.shell;
    });
    return starts;
}

// Seen along z, whether a step to the right from p crosses the edge. Both triangles at an edge get the same answer,
// because it does not depend on the direction of the edge.
bool crosses(Vec3 p, Vec3 a, Vec3 b) {
    if ((a.y > p.y) == (b.y > p.y)) return false;
    if (a.y > b.y) std::swap(a, b);
    return (b.x - a.x) * (p.y - a.y) - (p.x - a.x) * (b.y - a.y) > 0;
}

bool meets(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    if ((crosses(p, a, b) + crosses(p, b, c) + crosses(p, c, a)) % 2 == 0) return false;
    const Vec3 normal = cross(b - a, c - a);
    return dot(normal, p - a) * normal.z < 0;  // the triangle is above
}

void toggle(std::vector<std::uint32_t>& set, std::uint32_t shell) {
    const auto at = std::lower_bound(set.begin(), set.end(), shell);
    if (at != set.end() && *at == shell) {
        set.erase(at);
    } else {
        set.insert(at, shell);
    }
}

}  // namespace

std::vector<std::vector<std::uint32_t>> shells_around(const TriangleMesh& mesh, const Shells& shells) {
    std::vector<std::vector<std::uint32_t>> around(shells.count());
    if (shells.count() < 2) return around;
    const std::vector<Start> starts = ray_starts(mesh, shells);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::array<Vec3, 3> corner{mesh.points[mesh.triangles[t][0]], mesh.points[mesh.triangles[t][1]],
                                         mesh.points[mesh.triangles[t][2]]};
        const double min_x = std::min({corner[0].x, corner[1].x, corner[2].x});
        const double max_x = std::max({corner[0].x, corner[1].x, corner[2].x});
        auto start = std::lower_bound(starts.begin(), starts.end(), min_x,
                                      [](const Start& s, double x) { return s.point.x < x; });
        for (; start != starts.end() && start->point.x <= max_x; ++start) {
            const std::uint32_t shell = shells.shell_of[t];
            if (start->shell == shell || !meets(start->point, corner[0], corner[1], corner[2])) continue;
            toggle(around[start->shell], shell);
        }
    }
    return around;
}

}  // namespace qchopper
