#include "segment/mesh/nesting.h"

#include <algorithm>
#include <cstddef>

namespace qchopper {
namespace {

// Where the ray of one shell starts; all rays go up along z.
struct Start {
    Vec3 point;
    std::uint32_t shell = 0;
};

// The middle of the largest triangle of each shell that is asked about: never a point where two shells touch. Sorted by
// x.
std::vector<Start> ray_starts(const TriangleMesh& mesh, const Shells& shells, const std::vector<bool>& asked) {
    std::vector<double> largest(shells.count(), -1);
    std::vector<Start> starts(shells.count());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::uint32_t shell = shells.shell_of[t];
        if (!asked[shell]) continue;
        const double area = norm(area_vector(mesh, t));
        if (!(area > largest[shell])) continue;
        largest[shell] = area;
        const Triangle& corner = mesh.triangles[t];
        const Vec3 sum = mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]];
        starts[shell] = {(1.0 / 3) * sum, shell};
    }
    std::erase_if(starts, [&](const Start& start) { return largest[start.shell] < 0; });
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

// Those that a triangle in this box may lie above, into `below`.
void find_below(const std::vector<Start>& starts, const Box& box, std::vector<Start>& below) {
    below.clear();
    auto start = std::lower_bound(starts.begin(), starts.end(), box.min.x,
                                  [](const Start& s, double x) { return s.point.x < x; });
    for (; start != starts.end() && start->point.x <= box.max.x; ++start) {
        const Vec3 p = start->point;
        if (p.y >= box.min.y && p.y <= box.max.y && p.z <= box.max.z) below.push_back(*start);
    }
}

}  // namespace

std::vector<std::vector<std::uint32_t>> shells_around(const TriangleMesh& mesh, const Shells& shells,
                                                      const std::vector<bool>& asked) {
    std::vector<std::vector<std::uint32_t>> around(shells.count());
    if (shells.count() < 2) return around;
    const std::vector<Start> starts =
        ray_starts(mesh, shells, asked.empty() ? std::vector<bool>(shells.count(), true) : asked);
    std::vector<Start> below;  // of the block in hand
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (t % triangles_per_block == 0) {
            find_below(starts, shells.block[t / triangles_per_block], below);
            if (below.empty()) {
                t += triangles_per_block - 1;
                continue;
            }
        }
        const std::uint32_t shell = shells.shell_of[t];
        const Triangle& v = mesh.triangles[t];
        const std::array<Vec3, 3> corner{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]};
        const auto [min_x, max_x] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
        auto start =
            std::lower_bound(below.begin(), below.end(), min_x, [](const Start& s, double x) { return s.point.x < x; });
        for (; start != below.end() && start->point.x <= max_x; ++start) {
            if (start->shell == shell || !meets(start->point, corner[0], corner[1], corner[2])) continue;
            toggle(around[start->shell], shell);
        }
    }
    return around;
}

}  // namespace qchopper
