// Disjoint sets of points, then one pass over the triangles for volumes and boxes. O(triangles + points).

#include "segment/mesh/connectivity/shells.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "segment/mesh/connectivity/disjoint_sets.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

}  // namespace

Shells shells(const TriangleMesh& mesh) {
    assert(is_consistent(mesh));
    DisjointSets sets(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        sets.unite(t[0], t[1]);
        sets.unite(t[0], t[2]);
    }
    // a parent is never larger than its child, so one pass in ascending order makes every parent the root
    for (std::uint32_t& parent : sets.parent) parent = sets.parent[parent];
    Shells result;
    result.shell_of.resize(mesh.triangles.size());
    std::vector<std::uint32_t> number(mesh.points.size(), none);
    std::vector<Vec3> origin;
    for (std::size_t begin = 0; begin < mesh.triangles.size(); begin += triangles_per_block) {
        const std::size_t end = std::min(mesh.triangles.size(), begin + triangles_per_block);
        const Vec3 start = mesh.points[mesh.triangles[begin][0]];
        Box block{start, start};
        Box run;  // of consecutive triangles of one shell
        std::uint32_t shell_of_run = none;
        const auto end_run = [&] {
            if (shell_of_run == none) return;
            for (const Vec3& p : {run.min, run.max}) {
                extend(result.box[shell_of_run], p);
                extend(block, p);
            }
        };
        for (std::size_t t = begin; t < end; ++t) {
            const Triangle& triangle = mesh.triangles[t];
            std::uint32_t& shell = number[sets.parent[triangle[0]]];
            const Vec3 a = mesh.points[triangle[0]];
            if (shell == none) {
                shell = static_cast<std::uint32_t>(origin.size());
                origin.push_back(a);
                result.volume.push_back(0);
                result.box.push_back({a, a});
            }
            result.shell_of[t] = shell;
            if (shell != shell_of_run) {
                end_run();
                shell_of_run = shell;
                run = {a, a};
            }
            const Vec3 o = origin[shell];
            const Vec3 b = mesh.points[triangle[1]];
            const Vec3 c = mesh.points[triangle[2]];
            result.volume[shell] += dot(a - o, cross(b - o, c - o)) / 6;
            for (const Vec3& p : {a, b, c}) extend(run, p);
        }
        end_run();
        result.block.push_back(block);
    }
    assert(result.box.size() == result.count());
    assert(result.block.size() == (mesh.triangles.size() + triangles_per_block - 1) / triangles_per_block);
    return result;
}

}  // namespace qchopper
