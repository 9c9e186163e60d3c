#include "segment/repair/weld.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace qchopper {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

std::uint64_t mixed(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9U;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebU;
    return x ^ x >> 31;
}

std::uint64_t hash_of(Vec3 p) {
    std::uint64_t h = mixed(std::bit_cast<std::uint64_t>(p.x));
    h = mixed(h + std::bit_cast<std::uint64_t>(p.y));
    return mixed(h + std::bit_cast<std::uint64_t>(p.z));
}

// Per point, the first point with the same coordinates. Open addressing at half load.
std::vector<std::uint32_t> first_equal(const std::vector<Vec3>& points) {
    const std::size_t slots = std::bit_ceil(2 * points.size() + 2);
    std::vector<std::uint32_t> slot(slots, nobody);
    std::vector<std::uint32_t> first(points.size());
    for (std::uint32_t v = 0; v < points.size(); ++v) {
        std::size_t at = hash_of(points[v]) & (slots - 1);
        while (slot[at] != nobody && points[slot[at]] != points[v]) at = (at + 1) & (slots - 1);
        if (slot[at] == nobody) slot[at] = v;
        first[v] = slot[at];
    }
    return first;
}

// Names the first of equal points everywhere and drops the triangles that this collapses.
std::size_t drop_collapsed(TriangleMesh& mesh, const std::vector<std::uint32_t>& first) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& old = mesh.triangles[t];
        const Triangle triangle{first[old[0]], first[old[1]], first[old[2]]};
        if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
        mesh.triangles[kept] = triangle;
        if (!mesh.cap_of.empty()) mesh.cap_of[kept] = mesh.cap_of[t];
        ++kept;
    }
    const std::size_t collapsed = mesh.triangles.size() - kept;
    mesh.triangles.resize(kept);
    if (!mesh.cap_of.empty()) mesh.cap_of.resize(kept);
    return collapsed;
}

// Closes the gaps that points without a triangle leave.
void drop_unreferenced(TriangleMesh& mesh) {
    std::vector<std::uint32_t> place(mesh.points.size(), nobody);
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) place[corner] = 0;
    }
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        if (place[v] == nobody) continue;
        mesh.points[kept] = mesh.points[v];
        place[v] = kept++;
    }
    mesh.points.resize(kept);
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& corner : t) corner = place[corner];
    }
}

}  // namespace

WeldCounts weld(TriangleMesh& mesh) {
    for (Vec3& p : mesh.points) p = p + Vec3{};  // -0.0 + 0.0 is 0.0; every other number stays
    WeldCounts counts;
    const std::vector<std::uint32_t> first = first_equal(mesh.points);
    for (std::size_t v = 0; v < first.size(); ++v) counts.welded += first[v] != v;
    const std::size_t different = mesh.points.size() - counts.welded;
    counts.collapsed = drop_collapsed(mesh, first);
    drop_unreferenced(mesh);
    counts.unreferenced = different - mesh.points.size();
    return counts;
}

}  // namespace qchopper
