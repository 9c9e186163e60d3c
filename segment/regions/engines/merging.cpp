#include "segment/regions/engines/merging.h"

#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace qchopper {
namespace {

struct Border {
    double length = 0;
    double turned = 0;  // turn times length
    SharedBorder mean() const { return {length, length > 0 ? turned / length : 0}; }
};

class Merger {
 public:
    Merger(const FaceGraph& graph, ClusterModel& model, const MergeLimits& limits)
        : model_(model), limits_(limits), borders_(graph.size()), parent_(graph.size()), version_(graph.size(), 0) {
        for (std::uint32_t f = 0; f < parent_.size(); ++f) parent_[f] = f;
        for (const DualEdge& edge : graph.edges) {
            const auto [a, b] = edge.face;
            if (a == b) continue;
            add(a, b, {edge.length, edge.turn * edge.length});
            add(b, a, {edge.length, edge.turn * edge.length});
        }
        for (const DualEdge& edge : graph.edges) push(edge.face[0], edge.face[1]);
    }

    Labels run() {
        std::size_t left = parent_.size();
        while (!heap_.empty() && left > limits_.regions) {
            const auto [cost, a, b, versions] = heap_.top();
            if (cost > limits_.max_cost) break;
            heap_.pop();
            const std::uint32_t ra = root(a);
            const std::uint32_t rb = root(b);
            if (ra == rb) continue;
            if (ra != a || rb != b || versions != version_[ra] + version_[rb]) {
                push_again(ra, rb);
                continue;
            }
            join(ra, rb);
            --left;
        }
        for (std::uint32_t f = 0; f < parent_.size(); ++f) parent_[f] = root(f);
        return numbered(parent_);
    }

 private:
    using Entry = std::tuple<double, std::uint32_t, std::uint32_t, std::uint64_t>;

    void add(std::uint32_t from, std::uint32_t to, const Border& more) {
        Border& border = borders_[from][to];
        border.length += more.length;
        border.turned += more.turned;
    }

    std::uint32_t root(std::uint32_t f) {
        while (parent_[f] != f) f = parent_[f] = parent_[parent_[f]];
        return f;
    }

    void push(std::uint32_t a, std::uint32_t b) {
        const auto [low, high] = std::minmax(a, b);
        const SharedBorder border = borders_[low][high].mean();
        if (border.turn > limits_.max_turn) return;  // joined later only over another part of the border
        heap_.emplace(model_.cost(low, high, border), low, high, version_[low] + version_[high]);
    }

    // An entry is made again at most once for each state of its two clusters.
    void push_again(std::uint32_t a, std::uint32_t b) {
        const auto [low, high] = std::minmax(a, b);
        const std::uint64_t state = version_[low] + version_[high] + 1;
        std::uint64_t& made = made_[(std::uint64_t{low} << 32U) | high];
        if (made == state) return;
        made = state;
        push(low, high);
    }

    void join(std::uint32_t a, std::uint32_t b) {
        if (borders_[a].size() < borders_[b].size()) std::swap(a, b);
        model_.join(a, b, borders_[a][b].mean());
        borders_[a].erase(b);
        for (const auto& [other, border] : borders_[b]) {
            if (other == a) continue;
            borders_[other].erase(b);
            add(a, other, border);
            add(other, a, border);
        }
        borders_[b] = {};
        parent_[b] = a;
        ++version_[a];
    }

    ClusterModel& model_;
    MergeLimits limits_;
    std::vector<std::unordered_map<std::uint32_t, Border>> borders_;
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint64_t> version_;  // how often a cluster has grown
    std::unordered_map<std::uint64_t, std::uint64_t> made_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap_;
};

}  // namespace

Labels merge_faces(const FaceGraph& graph, ClusterModel& model, const MergeLimits& limits) {
    return Merger(graph, model, limits).run();
}

}  // namespace qchopper
