// Cuts the surface at edges of many faces and stitches it again between faces that bound the same wedge of material, as
// in A. Gueziec, G. Taubin, F. Lazarus and B. Horn, "Cutting and stitching: converting sets of polygons to manifold
// surfaces" (2001). Before that the faces of each component are oriented alike (disjoint sets with orientation).
// O(n log n) in the triangles.

#include "segment/repair/split_non_manifold.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/connectivity/edge_groups.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/manifold.h"
#include "segment/repair/wedges.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr int max_rounds = 16;  // of separating edges that still have more than two faces; then faces stand alone

// Disjoint sets of triangles; of any two in one set it is known whether their orientations are opposite.
class TurnSets {
 public:
    explicit TurnSets(std::size_t size) : parent_(size), is_against_(size) {
        for (std::uint32_t t = 0; t < size; ++t) parent_[t] = t;
    }
    struct Root {
        std::uint32_t root;
        bool is_against;  // the member is oriented opposite to its root
    };
    Root find(std::uint32_t t) const {
        bool against = false;
        while (parent_[t] != t) {
            against ^= static_cast<bool>(is_against_[t]);
            t = parent_[t];
        }
        return {t, against};
    }
    // Returns false if that contradicts what is known.
    bool unite(std::uint32_t a, std::uint32_t b, bool is_against) {
        const Root x = find(a);
        const Root y = find(b);
        if (x.root == y.root) return (x.is_against ^ y.is_against) == is_against;
        const bool between = x.is_against ^ y.is_against ^ is_against;
        const bool x_is_larger = size_of(x.root) >= size_of(y.root);
        const std::uint32_t upper = x_is_larger ? x.root : y.root;
        const std::uint32_t lower = x_is_larger ? y.root : x.root;
        size_[upper] = size_of(upper) + size_of(lower);
        parent_[lower] = upper;
        is_against_[lower] = between;
        return true;
    }
    bool are_together(std::uint32_t a, std::uint32_t b) const { return find(a).root == find(b).root; }

 private:
    std::uint32_t& size_of(std::uint32_t root) {
        if (size_.empty()) size_.assign(parent_.size(), 1);
        return size_[root];
    }
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint8_t> is_against_;
    std::vector<std::uint32_t> size_;
};

class Separation {
 public:
    Separation(TriangleMesh& mesh, const SplitOptions& options)
        : mesh_(mesh),
          options_(options),
          groups_(edge_groups(mesh)),
          partner_(3 * mesh.triangles.size(), none),
          turns_(mesh.triangles.size()) {}

    SplitCounts run() {
        pair_neighbours();
        is_turned_ = smaller_parts();
        pair_wedges();
        if (options_.turn) is_turned_ = smaller_parts();
        turn();
        copy_points();
        return counts_;
    }

 private:
    std::uint32_t from(std::uint32_t h) const { return start_of(mesh_, h); }
    void pair(std::uint32_t a, std::uint32_t b) {
        partner_[a] = b;
        partner_[b] = a;
    }

    // Edges of two faces. Where their orientations are opposite one of them will be turned.
    void pair_neighbours() {
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            const std::span<const std::uint32_t> group = groups_[g];
            if (group.size() != 2) continue;
            const bool is_against = from(group[0]) == from(group[1]);
            const bool agrees = (options_.turn || !is_against) && turns_.unite(group[0] / 3, group[1] / 3, is_against);
            if (agrees) {
                pair(group[0], group[1]);
            } else {
                ++counts_.edges_cut;
            }
        }
    }

    // One flag per triangle: in every set the fewest faces are to be turned; of equal numbers those without the first
    // face.
    std::vector<bool> smaller_parts() const {
        std::vector<bool> result(mesh_.triangles.size());
        if (!options_.turn) return result;
        std::vector<std::int64_t> balance(mesh_.triangles.size());
        std::vector<std::uint32_t> first(mesh_.triangles.size(), none);
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto [root, is_against] = turns_.find(t);
            balance[root] += is_against ? 1 : -1;
            first[root] = std::min(first[root], t);
        }
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto [root, is_against] = turns_.find(t);
            const bool first_is_against = turns_.find(first[root]).is_against;
            const bool root_is_turned = balance[root] != 0 ? balance[root] > 0 : first_is_against;
            result[t] = is_against != root_is_turned;
        }
        return result;
    }

    // Whether the half-edge starts at the smaller end of its edge, after its face is turned as decided.
    bool runs_up(std::uint32_t h) const { return (from(h) < end_of(mesh_, h)) != is_turned_[h / 3]; }

    std::vector<std::uint32_t> around(std::span<const std::uint32_t> group) const {
        std::vector<std::uint32_t> result;
        for (const AtAngle& at : around_edge(mesh_, group)) result.push_back(at.half_edge);
        return result;
    }

    void pair_wedges() {
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            if (groups_[g].size() < 3) continue;
            ++counts_.edges_split;
            const std::vector<std::uint32_t> ring = around(groups_[g]);
            for_each_wedge(
                ring, [&](std::uint32_t h) { return runs_up(h); },
                [&](std::uint32_t down, std::uint32_t up) { pair_wedge(down, up); });
            if (options_.stitch) stitch(ring);
        }
    }

    void pair_wedge(std::uint32_t a, std::uint32_t b) {
        const bool is_against = from(a) == from(b);
        if (turns_.unite(a / 3, b / 3, is_against)) pair(a, b);
    }

    // Pairs each half-edge without a partner with the next such one of the ring, if their components are not joined
    // yet.
    void stitch(const std::vector<std::uint32_t>& ring) {
        std::uint32_t last = none;
        for (const std::uint32_t h : ring) {
            if (partner_[h] != none) continue;
            const bool is_against = last != none && from(last) == from(h);
            const bool is_free =
                last != none && !turns_.are_together(last / 3, h / 3) && (options_.turn || !is_against);
            if (is_free && turns_.unite(last / 3, h / 3, is_against)) {
                pair(last, h);
                ++counts_.stitched;
                last = none;
            } else {
                last = h;
            }
        }
    }

    // Swaps the last two corners of the faces to turn, which swaps their first and last half-edges.
    void turn() {
        const auto moved = [&](std::uint32_t h) { return is_turned_[h / 3] ? h - h % 3 + (2 - h % 3) : h; };
        std::vector<std::uint32_t> partner(partner_.size(), none);
        for (std::uint32_t h = 0; h < partner_.size(); ++h) {
            if (partner_[h] != none) partner[moved(h)] = moved(partner_[h]);
        }
        partner_ = std::move(partner);
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (!is_turned_[t]) continue;
            std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
            ++counts_.faces_reoriented;
        }
    }

    void copy_points() {
        TriangleMesh result = with_copies();
        for (int round = 0; !separate(result, round >= max_rounds); ++round) result = with_copies();
        counts_.copies = result.points.size() - mesh_.points.size();
        mesh_ = std::move(result);
    }

    // The mesh with a point for every fan.
    TriangleMesh with_copies() const {
        DisjointSets corners(partner_.size());
        for (std::uint32_t h = 0; h < partner_.size(); ++h) {
            if (partner_[h] != none) corners.unite(h, next_in_triangle(partner_[h]));
        }
        TriangleMesh result = mesh_;
        std::vector<std::uint32_t> point_of(partner_.size(), none);  // per root
        std::vector<bool> is_taken(mesh_.points.size());
        for (std::uint32_t h = 0; h < partner_.size(); ++h) {
            std::uint32_t& point = point_of[corners.root(h)];
            if (point == none) {
                point = from(h);
                if (is_taken[point]) {
                    result.points.push_back(mesh_.points[point]);
                    point = static_cast<std::uint32_t>(result.points.size() - 1);
                } else {
                    is_taken[point] = true;
                }
            }
            result.triangles[h / 3][h % 3] = point;
        }
        return result;
    }

    // Components that share both ends of an edge, but are not paired there, still make it an edge of many faces:
    // unpairs all faces at such edges, if `wholly` at their other edges too. Returns true if there are none.
    bool separate(const TriangleMesh& result, bool wholly) {
        const IndexLists groups = edge_groups(result);
        bool is_sound = true;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const std::span<const std::uint32_t> group = groups[g];
            if (group.size() == 1) continue;
            if (group.size() == 2 && from(group[0]) != from(group[1])) continue;
            is_sound = false;
            for (const std::uint32_t h : group) {
                for (std::uint32_t i = 0; i < 3; ++i) {
                    const std::uint32_t at = wholly ? h - h % 3 + i : h;
                    if (partner_[at] == none) continue;
                    partner_[partner_[at]] = none;
                    partner_[at] = none;
                }
            }
        }
        return is_sound;
    }

    TriangleMesh& mesh_;
    const SplitOptions& options_;
    IndexLists groups_;
    std::vector<std::uint32_t> partner_;  // per half-edge the one on the other side of its edge, or none
    TurnSets turns_;
    std::vector<bool> is_turned_;
    SplitCounts counts_;
};

}  // namespace

SplitCounts split_non_manifold(TriangleMesh& mesh, const SplitOptions& options) {
    const Edges found = edges(mesh);
    if (found.faults.non_manifold + found.faults.inconsistent == 0) {
        SplitCounts counts;
        counts.copies = split_non_manifold_vertices(mesh, found);
        return counts;
    }
    return Separation(mesh, options).run();
}

}  // namespace qchopper
