// Compares the volumes of the solids (solids.h). O(triangles + points).

#include "segment/repair/fragments.h"

#include <numeric>
#include <vector>

#include "segment/mesh/connectivity/solids.h"
#include "segment/mesh/submesh.h"

namespace qchopper {
namespace {

// Sets in is_kept, one flag per triangle, those of no fragment.
FragmentCounts find_fragments(const TriangleMesh& mesh, double volume_share, std::vector<bool>& is_kept) {
    FragmentCounts counts;
    is_kept.assign(mesh.triangles.size(), true);
    const Shells found = shells(mesh);
    if (found.count() < 2) return counts;
    const Solids bodies = solids(mesh, found, {0, 0, 1});
    std::vector<double> volume(bodies.count);
    for (std::size_t s = 0; s < found.count(); ++s) volume[bodies.solid_of_shell[s]] += found.volume[s];
    const double least = volume_share * std::accumulate(volume.begin(), volume.end(), 0.0);
    for (const double v : volume) counts.fragments += v < least;
    if (counts.fragments == 0) return counts;
    double area = 0;
    double fragment_area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double own = norm(area_vector(mesh, t));
        area += own;
        if (volume[bodies.solid_of_shell[found.shell_of[t]]] >= least) continue;
        fragment_area += own;
        ++counts.faces;
        is_kept[t] = false;
    }
    counts.area_share = fragment_area / area;
    return counts;
}

}  // namespace

FragmentCounts count_fragments(const TriangleMesh& mesh, double volume_share) {
    std::vector<bool> is_kept;
    return find_fragments(mesh, volume_share, is_kept);
}

FragmentCounts drop_fragments(TriangleMesh& mesh, double volume_share, SourceFaces* sources) {
    std::vector<bool> is_kept;
    const FragmentCounts counts = find_fragments(mesh, volume_share, is_kept);
    if (counts.fragments > 0) keep_triangles(mesh, is_kept, sources);
    return counts;
}

}  // namespace qchopper
