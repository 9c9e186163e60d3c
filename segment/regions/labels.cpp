#include "segment/regions/labels.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>

#include "segment/mesh/connectivity/disjoint_sets.h"

namespace qchopper {
namespace {

// The lengths of the borders of each region, by the neighbour.
std::vector<std::map<std::uint32_t, double>> borders_of(const FaceGraph& graph, const Labels& labels) {
    std::vector<std::map<std::uint32_t, double>> borders(labels.count);
    for (const DualEdge& edge : graph.edges) {
        const std::uint32_t a = labels.of[edge.face[0]];
        const std::uint32_t b = labels.of[edge.face[1]];
        if (a == b) continue;
        borders[a][b] += edge.length;
        borders[b][a] += edge.length;
    }
    return borders;
}

}  // namespace

Labels numbered(const std::vector<std::uint32_t>& values) {
    Labels labels;
    labels.of.reserve(values.size());
    std::unordered_map<std::uint32_t, std::uint32_t> number;
    for (const std::uint32_t value : values) {
        labels.of.push_back(number.try_emplace(value, static_cast<std::uint32_t>(number.size())).first->second);
    }
    labels.count = number.size();
    return labels;
}

Labels connected(const FaceGraph& graph, const Labels& labels) {
    assert(labels.of.size() == graph.size());
    DisjointSets sets(graph.size());
    for (const DualEdge& edge : graph.edges) {
        if (labels.of[edge.face[0]] == labels.of[edge.face[1]]) sets.unite(edge.face[0], edge.face[1]);
    }
    std::vector<std::uint32_t> roots(graph.size());
    for (std::uint32_t f = 0; f < roots.size(); ++f) roots[f] = sets.root(f);
    return numbered(roots);
}

std::vector<double> region_areas(const FaceGraph& graph, const Labels& labels) {
    assert(labels.of.size() == graph.size());
    std::vector<double> areas(labels.count);
    for (std::size_t f = 0; f < graph.size(); ++f) areas[labels.of[f]] += graph.area[f];
    return areas;
}

Labels without_small(const FaceGraph& graph, const Labels& labels, double min_share) {
    std::vector<double> areas = region_areas(graph, labels);
    const double least = min_share * std::accumulate(areas.begin(), areas.end(), 0.0);
    std::vector<std::map<std::uint32_t, double>> borders = borders_of(graph, labels);
    std::vector<std::uint32_t> into(labels.count);
    std::iota(into.begin(), into.end(), 0U);
    std::set<std::pair<double, std::uint32_t>> small;
    for (std::uint32_t r = 0; r < labels.count; ++r) {
        if (areas[r] < least) small.insert({areas[r], r});
    }
    while (!small.empty()) {
        const std::uint32_t r = small.begin()->second;
        small.erase(small.begin());
        if (borders[r].empty()) continue;
        const auto shorter = [](const auto& a, const auto& b) { return a.second < b.second; };
        const std::uint32_t to = std::ranges::max_element(borders[r], shorter)->first;
        for (const auto& [other, length] : borders[r]) {
            borders[other].erase(r);
            if (other == to) continue;
            borders[to][other] += length;
            borders[other][to] += length;
        }
        small.erase({areas[to], to});
        areas[to] += areas[r];
        if (areas[to] < least) small.insert({areas[to], to});
        into[r] = to;
    }
    std::vector<std::uint32_t> values;
    values.reserve(graph.size());
    for (std::uint32_t r : labels.of) {
        while (into[r] != r) r = into[r];
        values.push_back(r);
    }
    return numbered(values);
}

}  // namespace qchopper
