// M. Eck, T. DeRose, T. Duchamp, H. Hoppe, M. Lounsbery and W. Stuetzle, "Multiresolution analysis of arbitrary meshes"
// (1995): tiles grow from seeds over the least sum of lengths; seeds are added until every tile is a disc, two tiles
// share one border at most, and no point touches four.
//
// Ours: tiles are of triangles, and lengths run from centroid to centroid; the first seed is the triangle farthest from
// the centroid; all places where a condition is broken get a seed in one round, but one per tile. O(n) per round to ask
// the conditions, and for all seeds together some O(n log n) for n triangles: a new seed only changes its tile.

#include <algorithm>
#include <map>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "segment/regions/borders.h"
#include "segment/regions/engines/shortest_paths.h"
#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

constexpr int max_rounds = 400;

// The tiles at each point, each once. O(triangles log of the tiles at a point).
std::vector<std::set<std::uint32_t>> tiles_at_points(const FaceGraph& graph, const std::vector<std::uint32_t>& of) {
    std::vector<std::set<std::uint32_t>> at(graph.mesh->points.size());
    for (std::size_t f = 0; f < graph.size(); ++f) {
        for (const std::uint32_t p : graph.mesh->triangles[f]) at[p].insert(of[f]);
    }
    return at;
}

// Points - edges + triangles of each tile: 1 for a disc, and for no other connected surface.
std::vector<bool> are_discs(const FaceGraph& graph, const std::vector<std::uint32_t>& of, std::size_t count,
                            const std::vector<std::set<std::uint32_t>>& at) {
    std::vector<long> euler(count, 0);
    for (const std::set<std::uint32_t>& tiles : at) {
        for (const std::uint32_t t : tiles) ++euler[t];
    }
    for (std::size_t f = 0; f < graph.size(); ++f) euler[of[f]] += 1 - 3;
    for (const DualEdge& edge : graph.edges) {
        if (of[edge.face[0]] == of[edge.face[1]]) ++euler[of[edge.face[0]]];
    }
    std::vector<bool> is_disc;
    is_disc.reserve(euler.size());
    for (const long e : euler) is_disc.push_back(e == 1);
    return is_disc;
}

// Pairs of tiles of which the common border is in several parts, each by its shortest part.
std::vector<RegionBorder> split_borders(const FaceGraph& graph, const std::vector<std::uint32_t>& of) {
    std::vector<RegionBorder> split;
    const std::vector<RegionBorder> parts = region_borders(graph, of);
    for (std::size_t first = 0, end = 0; first < parts.size(); first = end) {
        std::size_t least = first;
        for (end = first; end < parts.size() && parts[end].region == parts[first].region; ++end) {
            if (parts[end].edges.size() < parts[least].edges.size()) least = end;
        }
        if (end - first > 1) split.push_back(parts[least]);
    }
    return split;
}

class Tiling {
 public:
    explicit Tiling(const FaceGraph& graph) : graph_(graph) {
        std::vector<double> cost;
        for (const DualEdge& edge : graph.edges) cost.push_back(edge.path);
        paths_ = weighted_faces(graph, cost);
        cost_.assign(graph.size(), std::numeric_limits<double>::infinity());
        of_.assign(graph.size(), no_source);
        add(farthest_face(graph, surface_centroid(graph)));
        for (std::uint32_t f = 0; f < graph.size(); ++f) {
            if (of_[f] == no_source) add(f);  // of a further connected part
        }
    }

    // False: no condition is broken.
    bool add_seeds() {
        const auto at = tiles_at_points(graph_, of_);
        const std::vector<bool> is_disc = are_discs(graph_, of_, seeds_.size(), at);
        std::map<std::uint32_t, std::uint32_t> new_seed;  // by its tile
        for (std::uint32_t f = 0; f < graph_.size(); ++f) {
            if (is_disc[of_[f]]) continue;
            const auto [known, is_new] = new_seed.try_emplace(of_[f], f);
            if (cost_[f] > cost_[known->second]) known->second = f;
        }
        if (new_seed.empty()) at_borders(new_seed);
        if (new_seed.empty()) at_points(at, new_seed);
        for (const auto& [tile, face] : new_seed) add(face);
        return !new_seed.empty();
    }

    const std::vector<std::uint32_t>& of() const { return of_; }

 private:
    // In the middle of the shortest part of a border in several parts, the triangle farther from its seed.
    void at_borders(std::map<std::uint32_t, std::uint32_t>& new_seed) const {
        for (const RegionBorder& part : split_borders(graph_, of_)) {
            const auto [f, g] = graph_.edges[part.edges[part.edges.size() / 2]].face;
            offer(cost_[f] >= cost_[g] ? f : g, new_seed);
        }
    }

    void at_points(const std::vector<std::set<std::uint32_t>>& at,
                   std::map<std::uint32_t, std::uint32_t>& new_seed) const {
        std::set<std::uint32_t> is_near;  // tiles that get a seed beside them in this round
        for (std::uint32_t f = 0; f < graph_.size(); ++f) {
            for (const std::uint32_t p : graph_.mesh->triangles[f]) {
                if (at[p].size() < 4) continue;
                if (std::ranges::any_of(at[p], [&](std::uint32_t t) { return is_near.contains(t); })) continue;
                is_near.insert(at[p].begin(), at[p].end());
                offer(f, new_seed);
            }
        }
    }

    // A triangle that is a seed already cannot become one; its neighbours can.
    void offer(std::uint32_t face, std::map<std::uint32_t, std::uint32_t>& new_seed) const {
        if (cost_[face] > 0) {
            new_seed.try_emplace(of_[face], face);
            return;
        }
        for (const std::uint32_t e : graph_.around[face]) {
            if (e == no_dual_edge || cost_[graph_.across(e, face)] == 0) continue;
            new_seed.try_emplace(of_[graph_.across(e, face)], graph_.across(e, face));
            return;
        }
    }

    void add(std::uint32_t seed) {
        using Entry = std::pair<double, std::uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        const auto tile = static_cast<std::uint32_t>(seeds_.size());
        seeds_.push_back(seed);
        cost_[seed] = 0;
        of_[seed] = tile;
        queue.emplace(0, seed);
        while (!queue.empty()) {
            const auto [at, face] = queue.top();
            queue.pop();
            if (at > cost_[face]) continue;
            for (const Arc& arc : paths_[face]) {
                if (!(at + arc.cost < cost_[arc.to])) continue;
                cost_[arc.to] = at + arc.cost;
                of_[arc.to] = tile;
                queue.emplace(cost_[arc.to], arc.to);
            }
        }
    }

    const FaceGraph& graph_;
    WeightedGraph paths_;
    std::vector<std::uint32_t> seeds_;
    std::vector<double> cost_;
    std::vector<std::uint32_t> of_;
};

}  // namespace

Labels eck_tiles(const FaceGraph& graph, const RegionOptions& /*options*/) {
    Tiling tiling(graph);
    for (int round = 0; round < max_rounds && tiling.add_seeds(); ++round) {
    }
    return numbered(tiling.of());
}

TileFaults tile_faults(const FaceGraph& graph, const Labels& labels) {
    TileFaults faults;
    const auto at = tiles_at_points(graph, labels.of);
    faults.no_discs =
        static_cast<std::size_t>(std::ranges::count(are_discs(graph, labels.of, labels.count, at), false));
    faults.split_borders = split_borders(graph, labels.of).size();
    for (const std::set<std::uint32_t>& tiles : at) faults.crowded_points += tiles.size() > 3 ? 1 : 0;
    return faults;
}

}  // namespace qchopper
