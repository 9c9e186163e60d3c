// R. Liu and H. Zhang, "Segmentation of 3D meshes through spectral clustering" (2004): triangles whose distance is
// small lie near each other in the space of the first eigenvectors of their affinities, and are grouped there.
//
// Of the paper: the distance of Katz and Tal, with eta = 0.15 for convex edges; the Gaussian affinity with sigma the
// mean distance; N = D^-1/2 W D^-1/2, its k largest eigenvectors, rows of unit length; k-means on the rows of V V^T,
// whose distances are those of rows of V by the metric V^T V. Of R. Liu, V. Jain and H. Zhang, "Subsampling for
// efficient spectral mesh processing" (2006): the affinities to 400 samples stand for all (the Nystroem method); with
// fewer triangles all are samples. Ours: samples and first means are farthest from each other, not chosen by chance; k
// without a given one is where the eigenvalues fall most. O(s n log n + s^2 n) for n triangles and s samples.

#include <algorithm>
#include <vector>

#include "segment/regions/engines/bends.h"
#include "segment/regions/engines/representatives.h"
#include "segment/regions/engines/spectrum.h"
#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

constexpr std::size_t samples = 400;
constexpr std::size_t most_regions = 20;

}  // namespace

Labels liu_zhang_parts(const FaceGraph& graph, const RegionOptions& options) {
    const WeightedGraph weighted = weighted_faces(graph, neighbour_distances(graph));
    const std::vector<std::uint32_t> sampled =
        farthest_first(weighted, nearest_face(graph, surface_centroid(graph)), samples).element;
    const Spectrum spectrum = affinity_spectrum(weighted, sampled, most_regions + 1);
    const std::size_t k = options.regions > 0 ? options.regions : count_at_largest_fall(spectrum.values);
    return connected(graph, numbered(grouped_rows(spectrum, std::min(k, spectrum.values.size()), graph.area)));
}

}  // namespace qchopper
