// Sorts the triangles by their corners and compares neighbours in that order. Opposite pairs are united to doubled
// components along edges; a component that is attached to other faces keeps one side only where that leaves fewer edges
// with an odd number of faces. O(n log n) in the triangles, O(n) where no face can repeat.

#include "segment/repair/faces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/connectivity/edge_groups.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/manifold.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/submesh.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr double flat_share = 1e-6;  // of the diagonal: a doubled component thinner than that encloses nothing

// A triangle with its corners in ascending order, and its orientation.
struct SortedTriangle {
    Triangle sorted;
    std::uint32_t triangle;
    bool is_turned;
    bool operator<(const SortedTriangle& b) const {
        return sorted != b.sorted ? sorted < b.sorted : triangle < b.triangle;
    }
};

SortedTriangle sorted_triangle(const TriangleMesh& mesh, std::uint32_t triangle) {
    Triangle t = mesh.triangles[triangle];
    bool is_turned = false;
    const auto order = [&](std::size_t i, std::size_t j) {
        if (t[i] <= t[j]) return;
        std::swap(t[i], t[j]);
        is_turned = !is_turned;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return {t, triangle, is_turned};
}

std::vector<SortedTriangle> sorted_by_corners(const TriangleMesh& mesh) {
    std::vector<SortedTriangle> all;
    all.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) all.push_back(sorted_triangle(mesh, t));
    std::sort(all.begin(), all.end());
    return all;
}

// Whether faces may repeat: without non-manifold edges only two faces that are neighbours at all three edges can.
bool may_repeat(const TriangleMesh& mesh, const Edges& found) {
    if (found.faults.non_manifold + found.faults.inconsistent > 0) return true;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::uint32_t twin = found.twin[3 * t];
        if (twin == no_twin || found.twin[3 * t + 1] == no_twin) continue;
        if (twin / 3 == found.twin[3 * t + 1] / 3) return true;
    }
    return false;
}

// The connected sets of faces that have an opposite face, united along shared edges.
class DoubledComponents {
 public:
    DoubledComponents(const TriangleMesh& mesh, const std::vector<std::uint32_t>& opposite)
        : mesh_(mesh), opposite_(opposite), component_(mesh.triangles.size()), balance_(mesh.triangles.size()) {
        const IndexLists groups = edge_groups(mesh);
        for (std::size_t g = 0; g < groups.size(); ++g) join(groups[g]);
        for (std::size_t g = 0; g < groups.size(); ++g) count_open(groups[g]);
        find_flat();
    }

    // Whether one side of the component that this face belongs to must stay.
    bool is_needed(std::uint32_t triangle) {
        const Balance& b = balance_[component_.root(triangle)];
        if (b.is_attached) return b.open_with < b.open_without;
        return !b.is_flat;
    }

 private:
    struct Balance {
        std::size_t open_with = 0;     // edges with an odd number of faces when one side stays
        std::size_t open_without = 0;  // and when both go
        bool is_attached = false;
        bool is_flat = true;
        std::uint32_t largest = none;
        double area = -1;
    };

    void join(std::span<const std::uint32_t> group) {
        std::uint32_t first = none;
        for (const std::uint32_t h : group) {
            if (opposite_[h / 3] == none) continue;
            if (first == none) first = h / 3;
            component_.unite(first, h / 3);
        }
    }

    void count_open(std::span<const std::uint32_t> group) {
        std::size_t faces = 0;
        std::uint32_t one = none;
        for (const std::uint32_t h : group) {
            if (opposite_[h / 3] == none) continue;
            ++faces;
            one = h / 3;
        }
        if (one == none) return;
        Balance& b = balance_[component_.root(one)];
        const std::size_t others = group.size() - faces;
        b.is_attached = b.is_attached || others > 0;
        b.open_without += others % 2;
        b.open_with += (others + faces / 2) % 2;
    }

    // A component is flat if it lies in the plane of its largest face.
    void find_flat() {
        const double thin = flat_share * norm(bounds(mesh_).size());
        const auto for_each_face = [&](const auto& action) {
            for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
                if (opposite_[t] != none) action(t, balance_[component_.root(t)]);
            }
        };
        for_each_face([&](std::uint32_t t, Balance& b) {
            const double area = norm(area_vector(mesh_, t));
            if (area > b.area) {
                b.area = area;
                b.largest = t;
            }
        });
        for_each_face([&](std::uint32_t t, Balance& b) {
            const Vec3 normal = normalized(area_vector(mesh_, b.largest));
            const Vec3 origin = mesh_.points[mesh_.triangles[b.largest][0]];
            for (const std::uint32_t corner : mesh_.triangles[t]) {
                if (std::abs(dot(normal, mesh_.points[corner] - origin)) > thin) b.is_flat = false;
            }
        });
    }

    const TriangleMesh& mesh_;
    const std::vector<std::uint32_t>& opposite_;  // per triangle the opposite one, or none
    DisjointSets component_;
    std::vector<Balance> balance_;
};

}  // namespace

std::vector<bool> without_opposite_faces(const TriangleMesh& mesh) {
    const std::vector<SortedTriangle> all = sorted_by_corners(mesh);
    std::vector<bool> is_kept(mesh.triangles.size(), true);
    for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
        std::size_t count[2] = {};
        for (end = i; end < all.size() && all[end].sorted == all[i].sorted; ++end) ++count[all[end].is_turned ? 1 : 0];
        const std::size_t pairs = std::min(count[0], count[1]);
        std::size_t left[2] = {count[0] - pairs, count[1] - pairs};
        for (std::size_t k = i; k < end; ++k) {
            std::size_t& may_stay = left[all[k].is_turned ? 1 : 0];
            is_kept[all[k].triangle] = may_stay > 0;
            may_stay -= may_stay > 0;
        }
    }
    return is_kept;
}

RepeatedFaces drop_repeated_faces(TriangleMesh& mesh, const Edges& found, SourceFaces* sources) {
    RepeatedFaces counts;
    if (!may_repeat(mesh, found)) return counts;
    const std::vector<SortedTriangle> all = sorted_by_corners(mesh);
    std::vector<bool> is_kept(mesh.triangles.size(), true);
    for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
        bool has[2] = {};
        for (end = i; end < all.size() && all[end].sorted == all[i].sorted; ++end) {
            bool& is_there = has[all[end].is_turned ? 1 : 0];
            if (is_there) is_kept[all[end].triangle] = false;
            counts.repeated += is_there;
            is_there = true;
        }
    }
    std::vector<std::uint32_t> place(mesh.triangles.size());  // after the repeated ones are gone
    for (std::uint32_t t = 0, kept = 0; t < place.size(); ++t) place[t] = is_kept[t] ? kept++ : none;
    keep_triangles(mesh, is_kept, sources);

    std::vector<std::uint32_t> opposite(mesh.triangles.size(), none);
    bool is_any = false;
    for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
        std::uint32_t side[2] = {none, none};
        for (end = i; end < all.size() && all[end].sorted == all[i].sorted; ++end) {
            if (place[all[end].triangle] != none) side[all[end].is_turned ? 1 : 0] = place[all[end].triangle];
        }
        if (side[0] == none || side[1] == none) continue;
        opposite[side[0]] = side[1];
        opposite[side[1]] = side[0];
        is_any = true;
    }
    if (!is_any) return counts;
    DoubledComponents doubled(mesh, opposite);
    is_kept.assign(mesh.triangles.size(), true);
    for (std::uint32_t t = 0; t < opposite.size(); ++t) {
        if (opposite[t] == none) continue;
        const bool is_needed = doubled.is_needed(t);
        is_kept[t] = is_needed && t < opposite[t];
        counts.repeated += is_needed && !is_kept[t];
        counts.of_doubled_components += !is_needed;
    }
    keep_triangles(mesh, is_kept, sources);
    return counts;
}

}  // namespace qchopper
