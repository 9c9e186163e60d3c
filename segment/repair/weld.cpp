// A hash table of the points (point_table.h), then one pass over the triangles and one over the points. O(points +
// triangles). Memory: 5 bytes per point, and 12 to 24 bytes in the table per different point.

#include "segment/repair/weld.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

#include "base/huge_pages.h"
#include "segment/mesh/point_table.h"

namespace qchopper {
namespace {

// Per point, the first point with the same coordinates.
std::vector<std::uint32_t> first_equal(const std::vector<Vec3>& points) {
    constexpr std::size_t batch = 16;  // slots are prefetched for so many points before they are used
    std::array<std::uint64_t, batch> hash{};
    // The share of repeated points, from which the size of the table follows, is measured on the first part: in an STL
    // file six triangles repeat a point, in a PLY file there may be no repetition.
    const std::size_t sample = points.size() / 16;
    PointTable table(sample);
    std::vector<std::uint32_t> first;
    reserve_huge(first, points.size());
    first.resize(points.size());
    for (std::size_t begin = 0; begin < points.size(); begin += batch) {
        const std::size_t end = std::min(points.size(), begin + batch);
        if (begin <= sample && sample < end) {
            table.widen(points, std::min(points.size(), 17 * table.size() + points.size() / 64));
        }
        for (std::size_t v = begin; v < end; ++v) {
            hash[v - begin] = PointTable::hash_of(points[v]);
            table.prefetch(hash[v - begin]);
        }
        for (std::size_t v = begin; v < end; ++v) {
            first[v] = table.find_or_note(points, points[v], hash[v - begin], static_cast<std::uint32_t>(v));
        }
    }
    return first;
}

// Replaces corners by the first of equal points, drops the triangles that this collapses and sets is_used of the points
// of the others. Returns the number of dropped triangles.
std::size_t drop_collapsed(TriangleMesh& mesh, const std::vector<std::uint32_t>& first,
                           std::vector<std::uint8_t>& is_used, SourceFaces* sources) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& old = mesh.triangles[t];
        const Triangle triangle{first[old[0]], first[old[1]], first[old[2]]};
        if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
        for (const std::uint32_t corner : triangle) is_used[corner] = 1;
        mesh.triangles[kept] = triangle;
        if (!mesh.cap_of.empty()) mesh.cap_of[kept] = mesh.cap_of[t];
        if (sources != nullptr) sources->of[kept] = sources->of[t];
        ++kept;
    }
    const std::size_t collapsed = mesh.triangles.size() - kept;
    mesh.triangles.resize(kept);
    if (!mesh.cap_of.empty()) mesh.cap_of.resize(kept);
    if (sources != nullptr) sources->of.resize(kept);
    return collapsed;
}

// Drops the points that are not used. `place`, one per point, is memory that is overwritten.
void drop_unused(TriangleMesh& mesh, const std::vector<std::uint8_t>& is_used, std::vector<std::uint32_t>& place) {
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        if (is_used[v] == 0) continue;
        mesh.points[kept] = mesh.points[v];
        place[v] = kept++;
    }
    if (kept == mesh.points.size()) return;
    mesh.points.resize(kept);
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& corner : t) corner = place[corner];
    }
}

}  // namespace

WeldCounts weld(TriangleMesh& mesh, SourceFaces* sources) {
    assert(sources == nullptr || sources->of.size() == mesh.triangles.size());
    for (Vec3& p : mesh.points) p = positive_zeros(p);
    WeldCounts counts;
    std::vector<std::uint32_t> first = first_equal(mesh.points);
    for (std::size_t v = 0; v < first.size(); ++v) counts.welded += first[v] != v;
    const std::size_t different = mesh.points.size() - counts.welded;
    std::vector<std::uint8_t> is_used(mesh.points.size());
    counts.collapsed = drop_collapsed(mesh, first, is_used, sources);
    drop_unused(mesh, is_used, first);
    counts.unreferenced = different - mesh.points.size();
    return counts;
}

}  // namespace qchopper
