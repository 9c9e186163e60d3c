// Collapses, then measures both ways by samples and counts the faces that run through each other; with a tolerance this
// is repeated with a smaller limit until the deviation is within it and no faces do. To a number of faces by passes
// (collapse_passes.h), within a tolerance by a queue (collapse.h).

#include "segment/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "segment/mesh/connectivity/links.h"
#include "segment/repair/intersections/self_intersections.h"
#include "segment/simplify/collapse.h"
#include "segment/simplify/collapse_passes.h"
#include "segment/simplify/sampled_deviation.h"
#include "segment/simplify/vertex_clustering.h"

namespace qchopper {
namespace {

constexpr std::size_t fewest_faces = 4;  // of any closed mesh

void check(const SimplifyOptions& options) {
    if (!options.tolerance && !options.max_faces) {
        throw InputError(InputFault::use, "neither a tolerance nor a number of faces is given", "give one of the two");
    }
    if (options.tolerance && !(*options.tolerance > 0 && std::isfinite(*options.tolerance))) {
        throw InputError(InputFault::use, "the tolerance is not a length above 0", "give it in mm, for example 0.5");
    }
    if (options.max_faces && *options.max_faces < fewest_faces) {
        throw InputError(InputFault::use, "a piece has at least " + std::to_string(fewest_faces) + " faces, not " +
                                              std::to_string(*options.max_faces));
    }
}

Links links_of_closed(const TriangleMesh& mesh) {
    const bool has_edges = std::none_of(mesh.triangles.begin(), mesh.triangles.end(), has_equal_corners);
    Links found;
    if (has_edges) found = links(mesh);
    if (mesh.triangles.empty() || !has_edges || !found.faults.is_closed()) {
        throw InputError(InputFault::mesh, "only a closed mesh can be simplified", "repair it first");
    }
    return found;
}

std::vector<std::uint8_t> points_of_caps(const TriangleMesh& mesh) {
    std::vector<std::uint8_t> is_of_cap(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) == no_cap) continue;
        for (const std::uint32_t corner : mesh.triangles[t]) is_of_cap[corner] = 1;
    }
    return is_of_cap;
}

void measure(const TriangleMesh& mesh, const TriangleMesh& fewer, const SimplifyOptions& options,
             SimplifyReport& report, const Context& context) {
    report.from_piece = farthest_sample(mesh, fewer, context);
    report.from_result = farthest_sample(fewer, mesh, context);
    if (options.is_quick) return;
    report.crossings = self_intersections(fewer, {}, context).pairs.size();
    if (report.crossings == 0) return;
    report.crossings -= std::min(report.crossings, self_intersections(mesh, {}, context).pairs.size());
}

// The limits of the collapses hold for points and planes. Edges and interiors of faces are measured afterwards; where
// they deviate too much, all is repeated with a smaller limit.
bool collapse_within(TriangleMesh& mesh, const SimplifyOptions& options, SimplifyReport& report,
                     const Context& context) {
    constexpr int max_tries = 8;
    constexpr double first_share = 0.8;
    const std::vector<std::uint8_t> is_locked = points_of_caps(mesh);
    CollapseLimits limits;
    limits.distance = first_share * *options.tolerance;
    limits.max_faces = options.max_faces.value_or(0);
    for (int i = 0; i < max_tries; ++i) {
        TriangleMesh fewer = mesh;
        if (!collapse_edges(fewer, is_locked, limits, context)) return false;
        measure(mesh, fewer, options, report, context);
        const bool is_near = report.deviation() <= *options.tolerance;
        if (is_near && report.crossings == 0) {
            mesh = std::move(fewer);
            return true;
        }
        limits.distance =
            *limits.distance * (is_near ? 0.5 : std::min(0.8, 0.95 * *options.tolerance / report.deviation()));
    }
    report.from_piece = report.from_result = 0;
    report.crossings = 0;
    return false;
}

// In passes; where these stop early although the caps would allow that number, by the queue.
bool collapse_to(std::size_t max_faces, TriangleMesh& mesh, const SimplifyOptions& options, SimplifyReport& report,
                 const Context& context) {
    const std::vector<std::uint8_t> is_locked = points_of_caps(mesh);
    TriangleMesh fewer = collapse_in_passes(mesh, is_locked, max_faces, context);
    const bool is_enough = fewer.triangles.size() <= std::max(max_faces, report.cap_faces);
    if (!options.is_quick && (!is_enough || !links(fewer).faults.is_closed())) {
        report.is_by_queue = true;
        CollapseLimits limits;
        limits.max_faces = max_faces;
        fewer = mesh;
        if (!collapse_edges(fewer, is_locked, limits, context)) return false;
    }
    measure(mesh, fewer, options, report, context);
    mesh = std::move(fewer);
    return true;
}

}  // namespace

SimplifyReport simplify(TriangleMesh& mesh, const SimplifyOptions& options, const Context& context) {
    check(options);
    const Links found = links_of_closed(mesh);
    mesh.ignored.clear();  // of no use to those who get the result
    SimplifyReport report;
    report.faces_before = mesh.triangles.size();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) report.cap_faces += cap_of(mesh, t) != no_cap ? 1 : 0;
    if (!options.max_faces || mesh.triangles.size() > *options.max_faces) {
        TriangleMesh split = mesh;
        split_fans(split, found.extra_fans);  // the collapses need one fan of faces around every point
        const bool is_done = options.tolerance ? collapse_within(split, options, report, context)
                                               : collapse_to(*options.max_faces, split, options, report, context);
        if (is_done) mesh = std::move(split);
    }
    report.faces_after = mesh.triangles.size();
    report.has_too_many_faces = options.max_faces && report.faces_after > *options.max_faces;
    return report;
}

}  // namespace qchopper
