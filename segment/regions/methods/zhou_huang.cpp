// Y. Zhou and Z. Huang, "Decomposing polygon meshes by means of critical points" (2004): a geodesic tree from a root at
// one end of the surface; its maxima and saddles are seeds; from the farthest on, each seed floods backwards what no
// other has until it meets a saddle.
//
// Of the paper: y is the point farthest from a first one, z the farthest from y; distances along edges; the order and
// the saddle at which a flood ends. Ours: the first point is the farthest from the centroid, not a random one; the root
// is that of y and z around which there is more surface, and the part that it lies in is flooded by the saddles of the
// tree from the other end, but only kept if its border is short; maxima are kept whose height above the saddle at which
// they meet a higher one is 0.05 of the root's distance or more, and saddles are those where two kept maxima meet
// (persistence, H. Edelsbrunner, D. Letscher and A. Zomorodian, "Topological persistence and simplification", 2002); a
// flood ends earlier where its front gets longer before it meets the saddle; and what saddles flood is one region. A
// surface without a saddle, such as a row of balls, is one region. O(n log n) for n triangles and each of the seeds.

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/regions/engines/shortest_paths.h"
#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

constexpr double least_persistence = 0.05;
constexpr double most_neck = 2.5;      // squared length of a border over the area behind it
constexpr double least_share = 0.002;  // of the surface
constexpr double end_share = 0.2;      // of the distance of the ends

std::uint32_t farthest(const ShortestPaths& paths) {
    return paths.order.back();
}

struct Seeds {
    std::vector<std::uint32_t> maxima;
    std::vector<std::uint32_t> saddles;
};

// Points come from the farthest down; components of the surface above meet at saddles, and the lower maximum ends.
Seeds persistent_seeds(const WeightedGraph& points, const ShortestPaths& tree) {
    const std::vector<double>& height = tree.cost;
    const double least = least_persistence * height[farthest(tree)];
    DisjointSets sets(points.size());
    std::vector<std::uint32_t> top(points.size(), no_source);  // of each root: the highest point of its component
    Seeds seeds;
    for (auto at = tree.order.rbegin(); at != tree.order.rend(); ++at) {
        const std::uint32_t p = *at;
        top[p] = p;
        for (const Arc& arc : points[p]) {
            if (top[arc.to] == no_source) continue;
            const std::uint32_t a = sets.root(p);
            const std::uint32_t b = sets.root(arc.to);
            if (a == b) continue;
            const std::uint32_t higher = height[top[a]] >= height[top[b]] ? top[a] : top[b];
            const std::uint32_t lower = higher == top[a] ? top[b] : top[a];
            if (lower != p && height[lower] - height[p] >= least) {
                seeds.maxima.push_back(lower);
                seeds.saddles.push_back(p);
            }
            sets.unite(a, b);
            top[sets.root(p)] = higher;
        }
    }
    seeds.maxima.push_back(farthest(tree));
    return seeds;
}

// The cost before which a flood ends because its front gets longer from there on: the length of a front is the area
// between two fronts over their distance. `cost`: per point, infinite beyond the flood; `last`: the largest one.
double before_widening(const FaceGraph& graph, const std::vector<double>& cost, double last) {
    constexpr int bins = 16;
    constexpr int first_asked = 6;
    constexpr double much_longer = 1.5;
    if (!(last > 0)) return last;
    std::array<double, bins> front{};
    for (std::size_t f = 0; f < graph.size(); ++f) {
        const Triangle& t = graph.mesh->triangles[f];
        const auto [low, high] = std::minmax({cost[t[0]], cost[t[1]], cost[t[2]]});
        if (!(low < last)) continue;
        const double from = low / last * bins;
        const double to = std::max(from + 1e-9, std::min(high, 2 * last) / last * bins);
        for (int b = static_cast<int>(from); b < bins && b < to; ++b) {
            const double share = (std::min(to, b + 1.0) - std::max<double>(from, b)) / (to - from);
            front[static_cast<std::size_t>(b)] += share * graph.area[f];
        }
    }
    const auto* end = std::min_element(front.begin() + first_asked, front.end() - 1);
    const double least = *end;
    while (end != front.end() && *end <= much_longer * least) ++end;
    return last / bins * static_cast<double>(end - front.begin());
}

class Flooding {
 public:
    Flooding(const FaceGraph& graph, const WeightedGraph& points)
        : graph_(graph), points_(points), of_(points.size(), no_source) {}

    // Marks what is nearer to the seed than the first saddle, or than the first point that another seed has, and before
    // the front widens.
    void flood(std::uint32_t seed, std::uint32_t region, const std::vector<std::uint32_t>& saddles) {
        using Entry = std::pair<double, std::uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        std::vector<double> cost(points_.size(), std::numeric_limits<double>::infinity());
        std::vector<std::uint32_t> reached;
        cost[seed] = 0;
        queue.emplace(0, seed);
        double last = 0;
        while (!queue.empty()) {
            const auto [at, p] = queue.top();
            queue.pop();
            if (at > cost[p]) continue;
            if (of_[p] != no_source || (p != seed && std::ranges::find(saddles, p) != saddles.end())) break;
            reached.push_back(p);
            last = at;
            for (const Arc& arc : points_[p]) {
                if (!(at + arc.cost < cost[arc.to])) continue;
                cost[arc.to] = at + arc.cost;
                queue.emplace(cost[arc.to], arc.to);
            }
        }
        const double end = before_widening(graph_, cost, last);
        for (const std::uint32_t p : reached) {
            if (cost[p] <= end) of_[p] = region;
        }
    }

    const std::vector<std::uint32_t>& of() const { return of_; }

 private:
    const FaceGraph& graph_;
    const WeightedGraph& points_;
    std::vector<std::uint32_t> of_;
};

// The region of a triangle is that of two of its corners, or of the first one that is no body.
std::vector<std::uint32_t> of_faces(const FaceGraph& graph, const std::vector<std::uint32_t>& of_point,
                                    std::uint32_t body) {
    std::vector<std::uint32_t> of;
    of.reserve(graph.size());
    for (const Triangle& t : graph.mesh->triangles) {
        std::array<std::uint32_t, 3> r;
        for (std::size_t k = 0; k < 3; ++k) r[k] = of_point[t[k]] == no_source ? body : of_point[t[k]];
        of.push_back(r[0] == r[1] || r[0] == r[2] ? r[0] : r[1] == r[2] ? r[1] : r[0] != body ? r[0] : r[1]);
    }
    return of;
}

// The area around a point within a distance along edges, by corners.
double area_within(const FaceGraph& graph, const ShortestPaths& from, double distance) {
    double area = 0;
    for (std::size_t f = 0; f < graph.size(); ++f) {
        for (const std::uint32_t p : graph.mesh->triangles[f]) area += from.cost[p] <= distance ? graph.area[f] / 3 : 0;
    }
    return area;
}

// Trees from both ends; that from the thicker one comes first.
std::array<ShortestPaths, 2> geodesic_trees(const FaceGraph& graph, const WeightedGraph& points) {
    const std::uint32_t x = graph.mesh->triangles[farthest_face(graph, surface_centroid(graph))][0];
    const std::uint32_t y = farthest(shortest_paths(points, std::vector{x}));
    ShortestPaths from_y = shortest_paths(points, std::vector{y});
    const std::uint32_t z = farthest(from_y);
    ShortestPaths from_z = shortest_paths(points, std::vector{z});
    const double near = end_share * from_y.cost[z];
    if (area_within(graph, from_y, near) < area_within(graph, from_z, near)) std::swap(from_y, from_z);
    return {std::move(from_y), std::move(from_z)};
}

// Whether a region hangs on the others by a border that is short for its area.
bool has_neck(const FaceGraph& graph, const std::vector<std::uint32_t>& of, std::uint32_t region) {
    double border = 0;
    double area = 0;
    for (const DualEdge& edge : graph.edges) {
        if ((of[edge.face[0]] == region) != (of[edge.face[1]] == region)) border += edge.length;
    }
    for (std::size_t f = 0; f < graph.size(); ++f) area += of[f] == region ? graph.area[f] : 0;
    return border * border < most_neck * area;
}

}  // namespace

Labels zhou_huang_parts(const FaceGraph& graph, const RegionOptions& /*options*/) {
    const WeightedGraph points = weighted_points(graph);
    const std::array<ShortestPaths, 2> trees = geodesic_trees(graph, points);
    const ShortestPaths& tree = trees[0];
    Seeds seeds = persistent_seeds(points, tree);
    if (seeds.saddles.empty()) return connected(graph, numbered(std::vector<std::uint32_t>(graph.size(), 0)));
    std::ranges::stable_sort(seeds.maxima, std::ranges::greater(), [&](std::uint32_t p) { return tree.cost[p]; });
    Flooding flooding(graph, points);
    for (std::uint32_t r = 0; r < seeds.maxima.size(); ++r) flooding.flood(seeds.maxima[r], r, seeds.saddles);
    // What is left is what the saddles flood, each as far as the next one, and the root: one region, the body.
    const auto root_part = static_cast<std::uint32_t>(seeds.maxima.size());
    const std::uint32_t body = root_part + 1;
    flooding.flood(tree.order.front(), root_part, persistent_seeds(points, trees[1]).saddles);
    std::vector<std::uint32_t> of = of_faces(graph, flooding.of(), body);
    if (!has_neck(graph, of, root_part)) std::ranges::replace(of, root_part, body);
    return without_small(graph, connected(graph, numbered(of)), least_share);
}

}  // namespace qchopper
