// Compares the scanned and the new area of every shell. O(triangles + points).

#include "segment/repair/open_components.h"

#include <cassert>
#include <vector>

#include "segment/mesh/connectivity/shells.h"
#include "segment/mesh/submesh.h"

namespace qchopper {

OpenComponents drop_open_components(TriangleMesh& mesh, SourceFaces& sources, double drop_share) {
    assert(sources.of.size() == mesh.triangles.size());
    OpenComponents result;
    const Shells found = shells(mesh);
    std::vector<double> scanned(found.count());
    std::vector<double> added(found.count());
    double all_scanned = 0;
    double all_added = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double area = norm(area_vector(mesh, t));
        const bool is_added = sources.of[t] == new_face;
        (is_added ? added : scanned)[found.shell_of[t]] += area;
        (is_added ? all_added : all_scanned) += area;
    }
    std::vector<bool> is_open_component(found.count());
    double in_open_components = 0;
    for (std::size_t s = found.count(); s-- > 0;) {
        is_open_component[s] = added[s] > max_fill_of_surface * scanned[s];
        if (!is_open_component[s]) continue;
        ++result.left;
        result.first = found.box[s].centre();
        in_open_components += scanned[s];
    }
    if (result.left > 0 && result.left < found.count() && in_open_components <= drop_share * all_scanned) {
        std::vector<bool> is_kept(mesh.triangles.size());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            is_kept[t] = !is_open_component[found.shell_of[t]];
            if (is_kept[t]) continue;
            result.dropped_faces += sources.of[t] != new_face;
            if (sources.of[t] == new_face) all_added -= norm(area_vector(mesh, t));
        }
        keep_triangles(mesh, is_kept, &sources);
        result.dropped = result.left;
        result.left = 0;
    }
    result.added_area_share = all_added > 0 ? all_added / (all_scanned + all_added) : 0;
    return result;
}

}  // namespace qchopper
