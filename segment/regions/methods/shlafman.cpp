// S. Shlafman, A. Tal and S. Katz, "Metamorphosis of polyhedral surfaces using decomposition" (2002): k representatives
// far from each other; triangles go to the nearest one; each representative moves to where the mean distance to its
// triangles is least, until no triangle changes.
//
// Of the paper: the distance of neighbours, (1 - d) (1 - cos^2 turn) + d path; the first representative, nearest to the
// centroid, and each further one, farthest from those before. Ours: bends and paths are measured in their means, with
// d = 0.1, bends of smoothed normals, and those of convex edges a tenth, because limbs begin at concave ones; the mean
// distance is asked at three triangles of each region, not at all (engines/representatives.h); without a given k it
// follows from the gaps of the representatives, as in Katz and Tal (2003). O(k n log n) for n triangles.

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "segment/regions/engines/bends.h"
#include "segment/regions/engines/representatives.h"
#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

constexpr double path_share = 0.1;
constexpr double convex_share = 0.1;
constexpr std::size_t most_regions = 20;  // where no number is given
constexpr int rounds = 12;

std::vector<double> costs(const FaceGraph& graph) {
    const Bends bent = bends(graph);
    std::vector<double> bend;
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        bend.push_back((bent.is_concave[e] != 0 ? 1 : convex_share) * std::pow(std::sin(bent.turn[e]), 2));
    }
    return mixed_with_paths(graph, std::move(bend), path_share);
}

}  // namespace

Labels shlafman_parts(const FaceGraph& graph, const RegionOptions& options) {
    const WeightedGraph weighted = weighted_faces(graph, costs(graph));
    const std::uint32_t first = nearest_face(graph, surface_centroid(graph));
    const std::size_t most = options.regions > 0 ? options.regions : most_regions + 1;
    Representatives found = farthest_first(weighted, first, most);
    if (options.regions == 0) found.element.resize(count_at_largest_fall(found.gap));
    return connected(graph, numbered(grouped(weighted, graph.area, graph.centroid, found.element, rounds).of));
}

}  // namespace qchopper
