// CGAL's implementation of C. Portaneri et al., "Alpha wrapping with an offset" (2022). Time and memory depend on the
// area of the wrap over alpha squared more than on the size of the mesh.

#include "segment/repair/alpha_wrap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <cmath>

#include "base/error.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr double usual_alpha = 1.0 / 100;      // of the diagonal
constexpr double smallest_alpha = 1.0 / 2000;  // of the diagonal
constexpr double usual_offset = 1.0 / 30;      // of alpha
constexpr double smallest_offset = 1e-4;       // of alpha

TriangleMesh mesh_from(const Surface& surface) {
    TriangleMesh mesh;
    mesh.points.reserve(surface.number_of_vertices());
    mesh.triangles.reserve(surface.number_of_faces());
    std::vector<std::uint32_t> number(surface.num_vertices());
    for (const auto vertex : surface.vertices()) {
        number[vertex] = static_cast<std::uint32_t>(mesh.points.size());
        const Kernel::Point_3& p = surface.point(vertex);
        mesh.points.push_back({p.x(), p.y(), p.z()});
    }
    for (const auto face : surface.faces()) {
        Triangle triangle{};
        std::size_t k = 0;
        for (const auto vertex : surface.vertices_around_face(surface.halfedge(face))) triangle[k++] = number[vertex];
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

}  // namespace

AlphaWrapOptions filled_in(const AlphaWrapOptions& options, const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) throw InputError(InputFault::mesh, "there is no face to wrap");
    const double diagonal = norm(bounds(mesh).size());
    const auto is_wrong = [](double length) { return !std::isfinite(length) || length < 0; };
    if (is_wrong(options.alpha_mm) || is_wrong(options.offset_mm)) {
        throw InputError(InputFault::use, "alpha and offset of the wrap must be finite and not negative, in mm",
                         "leave them out for the usual ones");
    }
    AlphaWrapOptions result = options;
    if (result.alpha_mm == 0) result.alpha_mm = usual_alpha * diagonal;
    if (result.offset_mm == 0) result.offset_mm = usual_offset * result.alpha_mm;
    if (!(diagonal > 0)) throw InputError(InputFault::mesh, "the mesh to wrap has no size");
    if (result.alpha_mm < smallest_alpha * diagonal) {
        throw InputError(InputFault::use, "an alpha below 1/2000 of the scan's diagonal would take hours",
                         "use a larger one");
    }
    if (result.offset_mm < smallest_offset * result.alpha_mm) {
        throw InputError(InputFault::use, "the wrap's offset is below 1/10000 of its alpha", "use a larger one");
    }
    return result;
}

TriangleMesh alpha_wrap(const TriangleMesh& mesh, const AlphaWrapOptions& options, const Context& context) {
    const AlphaWrapOptions chosen = filled_in(options, mesh);
    context.check_cancelled();
    context.progress("scan wrapped", 0, 1);
    std::vector<Kernel::Point_3> points;
    points.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
    std::vector<std::array<std::size_t, 3>> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) triangles.push_back({t[0], t[1], t[2]});
    Surface surface;
    CGAL::alpha_wrap_3(points, triangles, chosen.alpha_mm, chosen.offset_mm, surface);
    context.progress("scan wrapped", 1, 1);
    return mesh_from(surface);
}

}  // namespace qchopper
