// Collapses, then measures both ways by samples; with a tolerance this is repeated with a smaller limit until the
// deviation is within it.

#include "segment/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "segment/mesh/distance.h"
#include "segment/mesh/edges.h"
#include "segment/mesh/manifold.h"
#include "segment/simplify/collapse.h"

namespace qchopper {
namespace {

constexpr std::size_t fewest_faces = 4;  // of any closed mesh

void check(const TriangleMesh& mesh, const Edges& edges, const SimplifyOptions& options) {
    if (!options.tolerance && !options.most_faces) {
        throw InputError(InputFault::use, "neither a tolerance nor a number of faces is given", "give one of the two");
    }
    if (options.tolerance && !(*options.tolerance > 0 && std::isfinite(*options.tolerance))) {
        throw InputError(InputFault::use, "the tolerance is not a length above 0", "give it in mm, for example 0.5");
    }
    if (options.most_faces && *options.most_faces < fewest_faces) {
        throw InputError(InputFault::use, "a piece has at least " + std::to_string(fewest_faces) + " faces, not " +
                                              std::to_string(*options.most_faces));
    }
    if (mesh.triangles.empty() || !edges.faults.is_closed()) {
        throw InputError(InputFault::mesh, "only a closed mesh can be simplified", "repair it first");
    }
}

std::vector<std::uint8_t> points_of_caps(const TriangleMesh& mesh) {
    std::vector<std::uint8_t> is_of_cap(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) == no_cap) continue;
        for (const std::uint32_t corner : mesh.triangles[t]) is_of_cap[corner] = 1;
    }
    return is_of_cap;
}

// The limits of the collapses hold for points and planes. Edges and interiors of faces are measured afterwards; where
// they deviate too much, all is repeated with a smaller limit.
bool collapse_within(TriangleMesh& mesh, const SimplifyOptions& options, SimplifyReport& report,
                     const Context& context) {
    constexpr int most_tries = 8;
    constexpr double first_share = 0.8;
    const std::vector<std::uint8_t> is_locked = points_of_caps(mesh);
    CollapseLimits limits;
    if (options.tolerance) limits.distance = first_share * *options.tolerance;
    limits.most_faces = options.most_faces.value_or(0);
    for (int i = 0; i < most_tries; ++i) {
        TriangleMesh fewer = mesh;
        if (!collapse_edges(fewer, is_locked, limits, context)) return false;
        report.from_piece = farthest_sample(mesh, fewer, context);
        report.from_result = farthest_sample(fewer, mesh, context);
        if (!options.tolerance || report.deviation() <= *options.tolerance) {
            mesh = std::move(fewer);
            return true;
        }
        limits.distance = *limits.distance * std::min(0.8, 0.95 * *options.tolerance / report.deviation());
    }
    report.from_piece = report.from_result = 0;
    return false;
}

}  // namespace

SimplifyReport simplify(TriangleMesh& mesh, const SimplifyOptions& options, const Context& context) {
    const Edges found = edges(mesh);
    check(mesh, found, options);
    SimplifyReport report;
    report.faces_before = mesh.triangles.size();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) report.cap_faces += cap_of(mesh, t) != no_cap ? 1 : 0;
    if (!options.most_faces || mesh.triangles.size() > *options.most_faces) {
        TriangleMesh split = mesh;
        split_non_manifold_vertices(split, found);  // half-edges cannot represent surfaces that only touch in a point
        if (collapse_within(split, options, report, context)) mesh = std::move(split);
    }
    report.faces_after = mesh.triangles.size();
    report.has_too_many_faces = options.most_faces && report.faces_after > *options.most_faces;
    return report;
}

}  // namespace qchopper
