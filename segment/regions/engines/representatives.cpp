// A round asks three elements of each group, with a search within all groups at once for each: O(arcs log elements).

#include "segment/regions/engines/representatives.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <queue>

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// Lowers the costs by those from one more source.
void lower(const WeightedGraph& graph, std::uint32_t source, std::vector<double>& cost) {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    cost[source] = 0;
    queue.emplace(0, source);
    while (!queue.empty()) {
        const auto [at, element] = queue.top();
        queue.pop();
        if (at > cost[element]) continue;
        for (const Arc& arc : graph[element]) {
            if (!(at + arc.cost < cost[arc.to])) continue;
            cost[arc.to] = at + arc.cost;
            queue.emplace(cost[arc.to], arc.to);
        }
    }
}

// The least cost within so many steps: what lies in a small spike is as near as what is around it.
std::vector<double> least_around(const WeightedGraph& graph, std::vector<double> cost, int steps) {
    for (int step = 0; step < steps; ++step) {
        std::vector<double> least = cost;
        for (std::size_t e = 0; e < graph.size(); ++e) {
            for (const Arc& arc : graph[e]) least[e] = std::min(least[e], cost[arc.to]);
        }
        cost = std::move(least);
    }
    return cost;
}

class Groups {
 public:
    Groups(const WeightedGraph& graph, const std::vector<double>& weight, const std::vector<Vec3>& place,
           std::vector<std::uint32_t> representatives)
        : graph_(graph), weight_(weight), place_(place), seeds_(std::move(representatives)) {}

    void assign() { of_ = shortest_paths(graph_, seeds_).source; }
    const std::vector<std::uint32_t>& of() const { return of_; }
    const std::vector<std::uint32_t>& representatives() const { return seeds_; }

    // False: no representative has moved.
    bool move() {
        std::vector<double> best = sums(seeds_);
        const std::vector<std::uint32_t> before = seeds_;
        for (const std::vector<std::uint32_t>& asked : {nearest_to_centres(), halfway()}) {
            const std::vector<double> sum = sums(asked);
            for (std::size_t g = 0; g < seeds_.size(); ++g) {
                if (!(sum[g] < best[g] * (1 - 1e-9))) continue;
                best[g] = sum[g];
                seeds_[g] = asked[g];
            }
        }
        return seeds_ != before;
    }

 private:
    // Of the costs to the members of each group, weighted.
    std::vector<double> sums(const std::vector<std::uint32_t>& from) const {
        const ShortestPaths paths = shortest_paths(graph_, from, of_);
        std::vector<double> sum(seeds_.size());
        for (std::size_t e = 0; e < of_.size(); ++e) {
            if (of_[e] == no_source) continue;
            sum[of_[e]] += paths.source[e] == no_source ? infinite : weight_[e] * paths.cost[e];
        }
        return sum;
    }

    std::vector<std::uint32_t> nearest_to_centres() const {
        std::vector<Vec3> centre(seeds_.size());
        std::vector<double> total(seeds_.size());
        for (std::size_t e = 0; e < of_.size(); ++e) {
            if (of_[e] == no_source) continue;
            centre[of_[e]] = centre[of_[e]] + weight_[e] * place_[e];
            total[of_[e]] += weight_[e];
        }
        std::vector<double> least(seeds_.size(), infinite);
        std::vector<std::uint32_t> found = seeds_;
        for (std::uint32_t e = 0; e < of_.size(); ++e) {
            const std::uint32_t g = of_[e];
            if (g == no_source || !(total[g] > 0)) continue;
            const double far = norm(place_[e] - (1 / total[g]) * centre[g]);
            if (far >= least[g]) continue;
            least[g] = far;
            found[g] = e;
        }
        return found;
    }

    std::vector<std::uint32_t> last_of(const ShortestPaths& paths) const {
        std::vector<std::uint32_t> last = seeds_;
        for (const std::uint32_t e : paths.order) {
            if (of_[e] != no_source) last[of_[e]] = e;
        }
        return last;
    }

    // Where the costs from two far ends of each group are most nearly equal and least.
    std::vector<std::uint32_t> halfway() const {
        const std::vector<std::uint32_t> one = last_of(shortest_paths(graph_, seeds_, of_));
        const ShortestPaths from_one = shortest_paths(graph_, one, of_);
        const ShortestPaths from_other = shortest_paths(graph_, last_of(from_one), of_);
        std::vector<double> least(seeds_.size(), infinite);
        std::vector<std::uint32_t> found = seeds_;
        for (std::uint32_t e = 0; e < of_.size(); ++e) {
            const std::uint32_t g = of_[e];
            if (g == no_source) continue;
            const double farther = std::max(from_one.cost[e], from_other.cost[e]);
            if (farther >= least[g]) continue;
            least[g] = farther;
            found[g] = e;
        }
        return found;
    }

    const WeightedGraph& graph_;
    const std::vector<double>& weight_;
    const std::vector<Vec3>& place_;
    std::vector<std::uint32_t> seeds_;
    std::vector<std::uint32_t> of_;
};

}  // namespace

Representatives farthest_first(const WeightedGraph& graph, std::uint32_t first, std::size_t most) {
    assert(first < graph.size());
    Representatives found;
    std::vector<double> cost(graph.size(), infinite);
    std::uint32_t next = first;
    double gap = infinite;
    const int steps = 3 + static_cast<int>(std::sqrt(static_cast<double>(graph.size())) / 30);
    while (found.element.size() < most && gap > 0) {
        found.element.push_back(next);
        found.gap.push_back(gap);
        lower(graph, next, cost);
        const std::vector<double> around = least_around(graph, cost, steps);
        next = static_cast<std::uint32_t>(std::ranges::max_element(around) - around.begin());
        gap = around[next];
    }
    return found;
}

std::size_t count_at_largest_fall(const std::vector<double>& gaps) {
    std::size_t best = std::min<std::size_t>(gaps.size(), 1);
    double largest = 0;
    for (std::size_t k = 1; k + 1 < gaps.size(); ++k) {
        if (!std::isfinite(gaps[k])) continue;
        const double fall = gaps[k] - gaps[k + 1];
        if (fall <= largest) continue;
        largest = fall;
        best = k + 1;
    }
    return best;
}

Grouping grouped(const WeightedGraph& graph, const std::vector<double>& weight, const std::vector<Vec3>& place,
                 std::vector<std::uint32_t> representatives, int rounds) {
    Groups groups(graph, weight, place, std::move(representatives));
    groups.assign();
    for (int round = 0; round < rounds; ++round) {
        if (!groups.move()) break;
        const std::vector<std::uint32_t> before = groups.of();
        groups.assign();
        if (groups.of() == before) break;
    }
    return {groups.of(), groups.representatives()};
}

}  // namespace qchopper
