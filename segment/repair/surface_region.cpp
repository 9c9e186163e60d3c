// Incidences by counting sort: O(points + triangles) of the mesh. Everything else depends on the size n of the region
// alone: loops() takes O(n log n), and the search for parts that the region cuts off ends in each after max(32, 2n)
// triangles.

#include "segment/repair/surface_region.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/connectivity/manifold.h"

namespace qchopper {

MeshIncidence::MeshIncidence(const TriangleMesh& whole) : mesh(whole), twin(edges(whole).twin) {
    first_at.assign(mesh.points.size() + 1, 0);
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) ++first_at[corner];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& first : first_at) {
        sum += first;
        first = sum;
    }
    at.resize(3 * mesh.triangles.size());
    for (std::size_t t = mesh.triangles.size(); t-- > 0;) {  // backwards, so that they come out ascending
        for (const std::uint32_t corner : mesh.triangles[t]) at[--first_at[corner]] = static_cast<std::uint32_t>(t);
    }
}

SurfaceRegion::SurfaceRegion(const MeshIncidence& incidence, const std::vector<std::uint32_t>& triangles)
    : incidence_(incidence) {
    for (const std::uint32_t t : triangles) add(t);
}

void SurfaceRegion::add(std::uint32_t triangle) {
    if (members_.insert(triangle).second) triangles_.push_back(triangle);
}

void SurfaceRegion::grow() {
    const std::size_t before = triangles_.size();
    for (std::size_t i = 0; i < before; ++i) {
        for (const std::uint32_t corner : incidence_.mesh.triangles[triangles_[i]]) {
            incidence_.for_each_at(corner, [&](std::uint32_t t) { add(t); });
        }
    }
}

void SurfaceRegion::tidy() {
    while (add_cut_off() || add_non_manifold()) {
    }
}

bool SurfaceRegion::is_border(std::uint32_t half_edge) const {
    const std::uint32_t twin = incidence_.twin[half_edge];
    return twin == no_twin || !has(twin / 3);
}

std::vector<std::uint32_t> SurfaceRegion::border() const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : triangles_) {
        for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
            if (is_border(h)) found.push_back(h);
        }
    }
    return found;
}

bool SurfaceRegion::add_cut_off() {
    // A part beyond the border with at most so many triangles is cut off.
    const std::size_t most = std::max<std::size_t>(32, 2 * triangles_.size());
    std::unordered_set<std::uint32_t> large;  // triangles of larger parts, as far as they were visited
    const std::size_t before = triangles_.size();
    for (const std::uint32_t h : border()) {
        if (incidence_.twin[h] == no_twin || has(incidence_.twin[h] / 3)) continue;
        std::vector<std::uint32_t> part{incidence_.twin[h] / 3};
        std::unordered_set<std::uint32_t> in_part{part[0]};
        bool is_large = large.contains(part[0]);
        for (std::size_t i = 0; i < part.size() && !is_large; ++i) {
            for (std::uint32_t k = 3 * part[i]; k < 3 * part[i] + 3; ++k) {
                const std::uint32_t twin = incidence_.twin[k];
                if (twin == no_twin || has(twin / 3) || !in_part.insert(twin / 3).second) continue;
                part.push_back(twin / 3);
                is_large |= large.contains(twin / 3);
            }
            is_large |= part.size() > most;
        }
        if (is_large) {
            large.insert(part.begin(), part.end());
        } else {
            for (const std::uint32_t t : part) add(t);
        }
    }
    return triangles_.size() > before;
}

bool SurfaceRegion::add_non_manifold() {
    std::unordered_map<std::uint32_t, int> times;
    bool has_added = false;
    for (const std::uint32_t h : border()) {
        const std::uint32_t point = start_of(incidence_.mesh, h);
        if (++times[point] != 2) continue;
        const std::size_t before = triangles_.size();
        incidence_.for_each_at(point, [&](std::uint32_t t) { add(t); });
        has_added |= triangles_.size() > before;
    }
    return has_added;
}

std::optional<std::vector<RegionLoop>> SurfaceRegion::loops() const {
    std::vector<std::uint32_t> ascending = triangles_;
    std::sort(ascending.begin(), ascending.end());
    const auto place = [&](std::uint32_t t) {
        return static_cast<std::uint32_t>(std::lower_bound(ascending.begin(), ascending.end(), t) - ascending.begin());
    };
    DisjointSets parts(ascending.size());
    std::map<std::uint32_t, std::uint32_t> from;  // the border half-edge that starts at a point
    for (const std::uint32_t t : ascending) {
        for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
            if (incidence_.twin[h] == no_twin) return std::nullopt;
            if (!is_border(h)) {
                parts.unite(place(t), place(incidence_.twin[h] / 3));
            } else if (!from.emplace(start_of(incidence_.mesh, h), h).second) {
                return std::nullopt;
            }
        }
    }
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < ascending.size(); ++i) count += parts.root(i) == i;
    std::vector<RegionLoop> found;
    std::unordered_set<std::uint32_t> has_loop;
    while (!from.empty()) {
        std::vector<std::uint32_t> loop;
        for (auto it = from.begin(); it != from.end(); it = from.find(end_of(incidence_.mesh, loop.back()))) {
            loop.push_back(it->second);
            from.erase(it);
        }
        if (end_of(incidence_.mesh, loop.back()) != start_of(incidence_.mesh, loop.front())) return std::nullopt;
        if (!has_loop.insert(parts.root(place(loop.front() / 3))).second) return std::nullopt;
        found.push_back({std::move(loop)});
    }
    if (found.size() != count) return std::nullopt;
    return found;
}

}  // namespace qchopper
