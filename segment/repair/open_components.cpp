#include "segment/repair/open_components.h"

#include <cassert>
#include <cstdint>
#include <vector>

#include "segment/mesh/shells.h"
#include "segment/mesh/submesh.h"

namespace qchopper {

Sheets judge_sheets(TriangleMesh& mesh, SourceFaces& sources, double drop_share) {
    assert(sources.of.size() == mesh.triangles.size());
    Sheets result;
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
    std::vector<bool> is_sheet(found.count());
    double in_sheets = 0;
    for (std::size_t s = found.count(); s-- > 0;) {
        is_sheet[s] = added[s] > most_fill_of_surface * scanned[s];
        if (!is_sheet[s]) continue;
        ++result.left;
        result.first = found.box[s].centre();
        in_sheets += scanned[s];
    }
    const bool goes = result.left > 0 && result.left < found.count() && in_sheets <= drop_share * all_scanned;
    if (goes) {
        std::vector<bool> is_kept(mesh.triangles.size());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            is_kept[t] = !is_sheet[found.shell_of[t]];
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
