// One pass over the triangles; 4 bytes per point for the new numbers.

#include "segment/mesh/submesh.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace qchopper {

void keep_triangles(TriangleMesh& mesh, const std::vector<bool>& is_kept) {
    keep_marked(mesh.triangles, is_kept);
    if (!mesh.cap_of.empty()) keep_marked(mesh.cap_of, is_kept);
    if (!mesh.ignored.empty()) keep_marked(mesh.ignored, is_kept);
}

std::vector<TriangleMesh> submeshes(const TriangleMesh& mesh, std::span<const std::uint32_t> group_of,
                                    std::size_t count) {
    assert(group_of.size() == mesh.triangles.size());
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<TriangleMesh> parts(count);
    std::vector<std::uint32_t> number(mesh.points.size(), none);  // in the part that has the point
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        TriangleMesh& part = parts[group_of[t]];
        Triangle triangle = mesh.triangles[t];
        for (std::uint32_t& v : triangle) {
            if (number[v] == none) {
                number[v] = static_cast<std::uint32_t>(part.points.size());
                part.points.push_back(mesh.points[v]);
            }
            v = number[v];
        }
        part.triangles.push_back(triangle);
        if (!mesh.cap_of.empty()) part.cap_of.push_back(mesh.cap_of[t]);
        if (!mesh.ignored.empty()) part.ignored.push_back(mesh.ignored[t]);
    }
    assert(std::all_of(parts.begin(), parts.end(), is_consistent));
    return parts;
}

}  // namespace qchopper
