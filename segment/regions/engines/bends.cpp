#include "segment/regions/engines/bends.h"

#include <cmath>
#include <numeric>

namespace qchopper {

Bends bends(const FaceGraph& graph, int rounds) {
    std::vector<Vec3> normal = graph.normal;
    for (int round = 0; round < rounds; ++round) {
        std::vector<Vec3> sum(graph.size());
        for (std::size_t f = 0; f < graph.size(); ++f) sum[f] = graph.area[f] * normal[f];
        for (const DualEdge& edge : graph.edges) {
            const auto [a, b] = edge.face;
            sum[a] = sum[a] + graph.area[b] * normal[b];
            sum[b] = sum[b] + graph.area[a] * normal[a];
        }
        for (std::size_t f = 0; f < graph.size(); ++f) normal[f] = normalized(sum[f]);
    }
    Bends found;
    for (const DualEdge& edge : graph.edges) {
        const auto [a, b] = edge.face;
        found.turn.push_back(std::atan2(norm(cross(normal[a], normal[b])), dot(normal[a], normal[b])));
        found.is_concave.push_back(dot(normal[b] - normal[a], graph.centroid[b] - graph.centroid[a]) < 0 ? 1 : 0);
    }
    return found;
}

std::vector<double> angular_distances(const FaceGraph& graph) {
    const Bends bent = bends(graph);
    std::vector<double> angle;
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        angle.push_back((bent.is_concave[e] != 0 ? 1 : convex_eta) * (1 - std::cos(bent.turn[e])));
    }
    return angle;
}

std::vector<double> mixed_with_paths(const FaceGraph& graph, std::vector<double> bend, double path_share) {
    double mean_bend = 0;
    double mean_path = 0;
    const auto count = static_cast<double>(graph.edges.size());
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        mean_bend += bend[e] / count;
        mean_path += graph.edges[e].path / count;
    }
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        bend[e] = (1 - path_share) * (mean_bend > 0 ? bend[e] / mean_bend : 0) +
                  path_share * (mean_path > 0 ? graph.edges[e].path / mean_path : 1);
    }
    return bend;
}

std::vector<double> neighbour_distances(const FaceGraph& graph) {
    return mixed_with_paths(graph, angular_distances(graph), path_share_of_neighbours);
}

}  // namespace qchopper
