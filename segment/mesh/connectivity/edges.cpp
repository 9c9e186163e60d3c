// Counting sort of the half-edges by their smaller end point, then a sort of the few of each point by the larger one.
// O(triangles + points) while each point has few edges; 8 bytes per half-edge for the sort.

#include "segment/mesh/connectivity/edges.h"

#include <algorithm>
#include <cassert>

#include "base/huge_pages.h"

namespace qchopper {
namespace {

// The sort key of a half-edge among those with the same smaller end point: the larger end point, the number of the
// half-edge, and in the last bit whether it runs towards the smaller one.
std::uint64_t sort_key(std::uint32_t from, std::uint32_t to, std::uint32_t half_edge) {
    return std::uint64_t{std::max(from, to)} << 32 | std::uint64_t{half_edge} << 1 | (from > to ? 1U : 0U);
}
std::uint32_t far_end(std::uint64_t key) {
    return static_cast<std::uint32_t>(key >> 32);
}
std::uint32_t half_edge(std::uint64_t key) {
    return static_cast<std::uint32_t>(key) >> 1;
}
bool run_opposite(std::uint64_t a, std::uint64_t b) {
    return ((a ^ b) & 1) != 0;
}

// Insertion sort: most points have two to four half-edges, for which it is much faster than std::sort.
void sort_few(std::uint64_t* begin, std::uint64_t* end) {
    if (end - begin > 24) {
        std::sort(begin, end);
        return;
    }
    for (std::uint64_t* i = begin; i < end; ++i) {
        const std::uint64_t moved = *i;
        std::uint64_t* hole = i;
        for (; hole > begin && moved < hole[-1]; --hole) *hole = hole[-1];
        *hole = moved;
    }
}

// The keys of all half-edges by their smaller end point; those of point v lie from first[v] to first[v + 1].
std::vector<std::uint64_t> by_smaller_end(const TriangleMesh& mesh, std::vector<std::uint32_t>& first) {
    first.assign(mesh.points.size() + 2, 0);
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) ++first[std::min(t[k], t[(k + 1) % 3]) + std::size_t{2}];
    }
    for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
    auto sorted = huge<std::uint64_t>(3 * mesh.triangles.size());
    std::uint32_t id = 0;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k, ++id) {
            const std::uint32_t from = t[k];
            const std::uint32_t to = t[(k + 1) % 3];
            sorted[first[std::min(from, to) + std::size_t{1}]++] = sort_key(from, to, id);
        }
    }
    return sorted;
}

}  // namespace

Edges edges(const TriangleMesh& mesh) {
    assert(mesh.triangles.size() < (std::size_t{1} << 31) / 3);
    assert(is_consistent(mesh));
    std::vector<std::uint32_t> first;
    std::vector<std::uint64_t> sorted = by_smaller_end(mesh, first);
    Edges result;
    result.twin = huge(sorted.size(), no_twin);
    EdgeFaults& faults = result.faults;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        std::uint64_t* const end = sorted.data() + first[v + 1];
        sort_few(sorted.data() + first[v], end);
        for (const std::uint64_t* group = sorted.data() + first[v]; group != end;) {
            const std::uint64_t* next = group;
            while (next != end && far_end(*next) == far_end(*group)) ++next;
            const auto size = next - group;
            if (size == 2 && run_opposite(group[0], group[1]) && far_end(*group) != v) {
                assert(result.twin[half_edge(group[0])] == no_twin && result.twin[half_edge(group[1])] == no_twin);
                result.twin[half_edge(group[0])] = half_edge(group[1]);
                result.twin[half_edge(group[1])] = half_edge(group[0]);
            } else {
                if (faults.is_closed()) faults.first_triangle = half_edge(*group) / 3;
                ++(size == 1 ? faults.open : size == 2 ? faults.inconsistent : faults.non_manifold);
            }
            group = next;
        }
    }
    assert((faults.open + faults.inconsistent + faults.non_manifold == 0) ==
           (std::find(result.twin.begin(), result.twin.end(), no_twin) == result.twin.end()));
    return result;
}

}  // namespace qchopper
