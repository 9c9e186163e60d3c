#include "segment/regions/borders.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

#include "segment/mesh/connectivity/disjoint_sets.h"

namespace qchopper {
namespace {

// Appends the connected parts of the edges between two regions.
void append_parts(const FaceGraph& graph, const RegionBorder& whole, std::vector<RegionBorder>& parts) {
    DisjointSets sets(whole.edges.size());
    std::map<std::uint32_t, std::uint32_t> first_at;  // per point: the first edge there
    for (std::uint32_t i = 0; i < whole.edges.size(); ++i) {
        for (const std::uint32_t p : graph.edges[whole.edges[i]].point) {
            sets.unite(first_at.try_emplace(p, i).first->second, i);
        }
    }
    std::map<std::uint32_t, RegionBorder> by_root;  // a root is the least member
    for (std::uint32_t i = 0; i < whole.edges.size(); ++i) by_root[sets.root(i)].edges.push_back(whole.edges[i]);
    for (auto& [root, part] : by_root) {
        part.region = whole.region;
        parts.push_back(std::move(part));
    }
}

}  // namespace

std::vector<RegionBorder> region_borders(const FaceGraph& graph, std::span<const std::uint32_t> of) {
    assert(of.size() == graph.size());
    std::map<std::array<std::uint32_t, 2>, RegionBorder> between;
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
        const std::uint32_t a = of[graph.edges[e].face[0]];
        const std::uint32_t b = of[graph.edges[e].face[1]];
        if (a != b) between[{std::min(a, b), std::max(a, b)}].edges.push_back(e);
    }
    std::vector<RegionBorder> parts;
    for (auto& [regions, border] : between) {
        border.region = regions;
        append_parts(graph, border, parts);
    }
    return parts;
}

}  // namespace qchopper
