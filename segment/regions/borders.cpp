#include "segment/regions/borders.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <map>
#include <utility>

#include "segment/mesh/connectivity/disjoint_sets.h"

namespace qchopper {

std::vector<RegionBorder> connected_parts(const FaceGraph& graph, const RegionBorder& border) {
    DisjointSets sets(border.edges.size());
    std::map<std::uint32_t, std::uint32_t> first_at;  // per point: the first edge there
    for (std::uint32_t i = 0; i < border.edges.size(); ++i) {
        for (const std::uint32_t p : graph.edges[border.edges[i]].point) {
            sets.unite(first_at.try_emplace(p, i).first->second, i);
        }
    }
    std::map<std::uint32_t, RegionBorder> by_root;  // a root is the least member
    for (std::uint32_t i = 0; i < border.edges.size(); ++i) by_root[sets.root(i)].edges.push_back(border.edges[i]);
    std::vector<RegionBorder> parts;
    parts.reserve(by_root.size());
    for (auto& [root, part] : by_root) {
        part.region = border.region;
        parts.push_back(std::move(part));
    }
    return parts;
}

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
        std::ranges::move(connected_parts(graph, border), std::back_inserter(parts));
    }
    return parts;
}

}  // namespace qchopper
