// Pairs the faces at every edge by wedges of material and gives every fan of faces a point of its own. O(n log n) in
// the triangles, apart from edges of very many faces.
//
// Proof that the result is a closed manifold: at an edge of many faces any pairing of those that run along it one way
// with those that run the other way makes every fan around a point a cycle, so the surface is closed. One point for
// each fan does not suffice where two pairs of one edge lie in the same fans at both ends of it: the edge then has four
// faces. Exchanging the partners of two such pairs splits both fans, each into two with one of the pairs. Fans are only
// ever split, so one pass over all edges removes all such cases. A fan of two faces would be two opposite faces with
// the same corners, and those have been dropped.

#include "segment/repair/balance.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "segment/mesh/connectivity/edge_groups.h"
#include "segment/mesh/connectivity/manifold.h"
#include "segment/mesh/submesh.h"
#include "segment/repair/faces.h"
#include "segment/repair/wedges.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr double same_angle = 1e-9;  // about an edge: faces nearer than this count as coincident

bool runs_up(const TriangleMesh& mesh, std::uint32_t h) {
    return start_of(mesh, h) < end_of(mesh, h);
}

bool is_balanced(const TriangleMesh& mesh, const IndexLists& groups) {
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::span<const std::uint32_t> group = groups[g];
        const auto up = std::count_if(group.begin(), group.end(), [&](std::uint32_t h) { return runs_up(mesh, h); });
        if (2 * static_cast<std::size_t>(up) != group.size()) return false;
    }
    return true;
}

class Pairing {
 public:
    explicit Pairing(TriangleMesh& mesh)
        : mesh_(mesh), groups_(edge_groups(mesh)), partner_(3 * mesh.triangles.size(), none) {}

    ShellCounts run() {
        ShellCounts counts;
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            if (groups_[g].size() > 2) ++counts.edges_split;
            pair_wedges(groups_[g]);
        }
        number_fans();
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            if (groups_[g].size() > 2) split_pairs_of_one_edge(groups_[g]);
        }
        counts.copies = give_every_fan_a_point();
        return counts;
    }

 private:
    // The next corner in the fan around a point. A corner has the number of the half-edge that starts there.
    std::uint32_t next_in_fan(std::uint32_t corner) const { return partner_[previous_in_triangle(corner)]; }

    void pair(std::uint32_t a, std::uint32_t b) {
        partner_[a] = b;
        partner_[b] = a;
    }

    void pair_wedges(std::span<const std::uint32_t> group) {
        if (group.size() == 2) return pair(group[0], group[1]);
        for_each_wedge(
            ring_of(group), [&](std::uint32_t h) { return runs_up(mesh_, h); },
            [&](std::uint32_t down, std::uint32_t up) { pair(down, up); });
    }

    // The half-edges by angle. Of coincident faces those that end a wedge come first, so that solids which touch there
    // stay separate, from the last to the first, so that two equal shells stay two: brackets match inside out.
    std::vector<std::uint32_t> ring_of(std::span<const std::uint32_t> group) const {
        const std::vector<AtAngle> ring = around_edge(mesh_, group);
        std::vector<std::uint32_t> result;
        std::vector<std::uint32_t> opening;
        for (std::size_t i = 0, end = 0; i < ring.size(); i = end) {
            for (end = i + 1; end < ring.size() && ring[end].angle - ring[end - 1].angle <= same_angle;) ++end;
            opening.clear();
            const std::size_t first = result.size();
            for (std::size_t k = i; k < end; ++k) {
                (runs_up(mesh_, ring[k].half_edge) ? result : opening).push_back(ring[k].half_edge);
            }
            std::sort(result.begin() + static_cast<std::ptrdiff_t>(first), result.end(), std::greater<>());
            std::sort(opening.begin(), opening.end());
            result.insert(result.end(), opening.begin(), opening.end());
        }
        return result;
    }

    void number_fans() {
        fan_.assign(partner_.size(), none);
        for (std::uint32_t corner = 0; corner < partner_.size(); ++corner) {
            if (fan_[corner] == none) number_fan(corner, fans_++);
        }
    }

    void number_fan(std::uint32_t corner, std::uint32_t number) {
        for (; fan_[corner] != number; corner = next_in_fan(corner)) fan_[corner] = number;
    }

    // After a fan was split into those of corners a and b: the smaller gets a new number, so that the total cost stays
    // O(n log n) however often fans are split.
    void number_split(std::uint32_t a, std::uint32_t b) {
        std::uint32_t at = next_in_fan(a);
        for (std::uint32_t other = next_in_fan(b); at != a && other != b; at = next_in_fan(at)) {
            other = next_in_fan(other);
        }
        number_fan(at == a ? a : b, fans_++);
    }

    void split_pairs_of_one_edge(std::span<const std::uint32_t> group) {
        std::vector<std::uint32_t> up;
        for (const std::uint32_t h : group) {
            if (runs_up(mesh_, h)) up.push_back(h);
        }
        const auto ends = [&](std::uint32_t h) { return std::pair(fan_[h], fan_[partner_[h]]); };
        for (bool is_any = true; is_any;) {
            is_any = false;
            std::sort(up.begin(), up.end(),
                      [&](std::uint32_t a, std::uint32_t b) { return ends(a) != ends(b) ? ends(a) < ends(b) : a < b; });
            for (std::size_t i = 0; i + 1 < up.size(); ++i) {
                if (ends(up[i]) != ends(up[i + 1])) continue;
                exchange(up[i], up[i + 1]);
                is_any = true;
            }
        }
    }

    void exchange(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t c = partner_[a];
        const std::uint32_t d = partner_[b];
        pair(a, d);
        pair(b, c);
        number_split(a, b);
        number_split(c, d);
    }

    // The first fan keeps the point, every other one gets a copy.
    std::size_t give_every_fan_a_point() {
        const std::size_t before = mesh_.points.size();
        std::vector<std::uint32_t> point_of(fans_, none);
        std::vector<bool> is_taken(before);
        for (std::uint32_t h = 0; h < partner_.size(); ++h) {
            std::uint32_t& corner = mesh_.triangles[h / 3][h % 3];
            std::uint32_t& point = point_of[fan_[h]];
            if (point == none && is_taken[corner]) {
                point = static_cast<std::uint32_t>(mesh_.points.size());
                mesh_.points.push_back(Vec3(mesh_.points[corner]));
            } else if (point == none) {
                point = corner;
                is_taken[corner] = true;
            }
            corner = point;
        }
        return mesh_.points.size() - before;
    }

    TriangleMesh& mesh_;
    IndexLists groups_;
    std::vector<std::uint32_t> partner_;  // per half-edge the one on the other side of its edge
    std::vector<std::uint32_t> fan_;      // per corner
    std::uint32_t fans_ = 0;
};

}  // namespace

bool is_balanced(const TriangleMesh& mesh, const Edges& found) {
    if (found.faults.is_closed()) return true;
    return found.faults.open + found.faults.inconsistent == 0 && is_balanced(mesh, edge_groups(mesh));
}

std::optional<ShellCounts> close_balanced(TriangleMesh& mesh, SourceFaces* sources) {
    const std::vector<bool> is_kept = without_opposite_faces(mesh);
    const std::size_t before = mesh.triangles.size();
    const auto kept = static_cast<std::size_t>(std::count(is_kept.begin(), is_kept.end(), true));
    if (kept == 0) return std::nullopt;
    if (kept < before) keep_triangles(mesh, is_kept, sources);
    ShellCounts counts = Pairing(mesh).run();
    counts.cancelled = before - kept;
    return counts;
}

}  // namespace qchopper
