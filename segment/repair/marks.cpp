// What a dent lies below is told by a quadric (Petitjean 2002) that is fitted to the surface around by iteratively
// reweighted least squares: points below it count the less the deeper they lie, points above it always count. So a
// narrow line does not pull it down. A second fit leaves out what the first has found.

#include "segment/repair/marks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "segment/mesh/normals.h"
#include "segment/repair/dents.h"
#include "segment/repair/surroundings.h"

namespace qchopper {
namespace {

constexpr double near_in_widths = 0.9;      // how far around the surface is looked at
constexpr double far_in_widths = 1.35;      // and once more, to see whether the depth grows with that
constexpr double coarsest_in_widths = 0.4;  // mean edge: with fewer than three points across, no line can be told
constexpr double seed_in_roughness = 4;     // a dent that deep is no accident
constexpr double flank_in_roughness = 1;
constexpr double mean_in_roughness = 5.7;  // of a whole mark
constexpr double least_known = 0.9;        // share of its points
constexpr double most_growth = 1.2;        // of its depth: between crests of the bone it grows, in a line it does not
constexpr double least_depth_mm = 0.02;

void check(const MarkOptions& o) {
    const auto is_length = [](double mm) { return std::isfinite(mm) && mm >= 0; };
    if (is_length(o.most_width) && is_length(o.most_depth) && is_length(o.least_depth) && is_length(o.least_length) &&
        o.most_width > 0 && o.most_depth > o.least_depth) {
        return;
    }
    throw InputError(InputFault::use, "no mark can have these measures",
                     "give a width and a depth above 0 in mm, for example 6 and 1");
}

double mean_edge(const TriangleMesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) sum += norm(mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]]);
    }
    return sum / static_cast<double>(std::max<std::size_t>(3 * mesh.triangles.size(), 1));
}

std::vector<SurfaceFit> fits(const Surroundings& around, std::size_t points, const Context& context) {
    std::vector<SurfaceFit> all(points);
    context.check_cancelled();
    parallel_for(0, points, [&](std::size_t i) { all[i] = around.fit(static_cast<std::uint32_t>(i)); });
    context.check_cancelled();
    return all;
}

// The fit of the points of all dents, by what lies around them.
std::vector<SurfaceFit> fits_without(const Surroundings& around, const std::vector<Dent>& dents,
                                     const std::vector<std::uint8_t>& is_dented) {
    std::vector<SurfaceFit> all(is_dented.size());
    for (const Dent& dent : dents) {
        parallel_for(0, dent.points.size(),
                     [&](std::size_t k) { all[dent.points[k]] = around.fit(dent.points[k], &is_dented); });
    }
    return all;
}

// Adds the points next to a dent, where its flanks run out.
void widen(const TriangleMesh& mesh, std::vector<Dent>& dents) {
    std::vector<std::uint32_t> number(mesh.points.size(), 0);  // of the dent, from 1
    for (std::uint32_t d = 0; d < dents.size(); ++d) {
        for (const std::uint32_t i : dents[d].points) number[i] = d + 1;
    }
    std::vector<std::uint32_t> wider = number;
    for (const Triangle& t : mesh.triangles) {
        const std::uint32_t near = std::max({number[t[0]], number[t[1]], number[t[2]]});
        for (const std::uint32_t corner : t) wider[corner] = std::max(wider[corner], near);
    }
    for (Dent& dent : dents) dent.points.clear();
    for (std::uint32_t i = 0; i < wider.size(); ++i) {
        if (wider[i] > 0) dents[wider[i] - 1].points.push_back(i);
    }
}

// What was measured of a dent from near by and from farther around.
struct Views {
    std::vector<SurfaceFit> near;
    std::vector<SurfaceFit> far;
};

// Whether the surface around the dent is known, smooth for how deep the dent is, and the depth does not depend on how
// far one looks: in a valley of the bone it would.
bool stands_out(const Dent& dent, const Views& views, double most_depth) {
    double near = 0;
    double far = 0;
    double roughness = 0;
    double deepest = 0;
    std::size_t known = 0;
    for (const std::uint32_t i : dent.points) {
        if (views.near[i].is_good) deepest = std::max(deepest, views.near[i].depth);
        if (!views.near[i].is_good || !views.far[i].is_good) continue;
        near += std::max(0.0, views.near[i].depth);
        far += std::max(0.0, views.far[i].depth);
        roughness += views.near[i].roughness;
        ++known;
    }
    return static_cast<double>(known) >= least_known * static_cast<double>(dent.points.size()) &&
           near >= mean_in_roughness * roughness && far <= most_growth * near && near <= most_growth * far &&
           deepest <= most_depth;
}

DentLimits limits_of(const MarkOptions& o) {
    DentLimits limits;
    limits.most_width = o.most_width;
    limits.most_depth = o.most_depth;
    limits.least_length = o.least_length > 0 ? o.least_length : 3 * o.most_width;
    return limits;
}

// Seeds are deep for how rough the surface is there; flanks only need to lie below it.
std::vector<DentKind> kinds_of(const std::vector<SurfaceFit>& fits, const MarkOptions& o) {
    std::vector<DentKind> kinds(fits.size(), DentKind::none);
    for (std::size_t i = 0; i < fits.size(); ++i) {
        if (!fits[i].is_good) continue;
        const double least =
            o.least_depth > 0 ? o.least_depth : std::max(least_depth_mm, seed_in_roughness * fits[i].roughness);
        const double flank = std::max(0.25 * least_depth_mm, flank_in_roughness * fits[i].roughness);
        if (fits[i].depth >= least) {
            kinds[i] = DentKind::seed;
        } else if (fits[i].depth >= std::min(flank, 0.5 * least)) {
            kinds[i] = DentKind::flank;
        }
    }
    return kinds;
}

std::vector<double> depths_of(const std::vector<SurfaceFit>& fits) {
    std::vector<double> depths;
    depths.reserve(fits.size());
    for (const SurfaceFit& fit : fits) depths.push_back(fit.depth);
    return depths;
}

void lift(TriangleMesh& mesh, const std::vector<Dent>& dents, const std::vector<SurfaceFit>& fits, MarkReport& report) {
    std::vector<std::uint8_t> is_moved(mesh.points.size(), 0);
    double sum = 0;
    for (const Dent& dent : dents) {
        report.length_mm += dent.length;
        for (const std::uint32_t i : dent.points) {
            const SurfaceFit& fit = fits[i];
            if (!fit.is_good || fit.depth <= 0) continue;
            const Vec3 lifted = mesh.points[i] + fit.depth * fit.normal;
            report.box = report.points_moved == 0 ? Box{lifted, lifted} : report.box;
            for (int axis = 0; axis < 3; ++axis) {
                report.box.min[axis] = std::min(report.box.min[axis], lifted[axis]);
                report.box.max[axis] = std::max(report.box.max[axis], lifted[axis]);
            }
            mesh.points[i] = lifted;
            is_moved[i] = 1;
            ++report.points_moved;
            report.most_depth = std::max(report.most_depth, fit.depth);
            sum += fit.depth;
        }
    }
    if (report.points_moved == 0) return;
    report.marks = dents.size();
    report.mean_depth = sum / static_cast<double>(report.points_moved);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& c = mesh.triangles[t];
        if (is_moved[c[0]] + is_moved[c[1]] + is_moved[c[2]] > 0) report.area_mm2 += norm(area_vector(mesh, t));
    }
}

}  // namespace

MarkReport smooth_marks(TriangleMesh& mesh, const MarkOptions& options, const Context& context) {
    check(options);
    MarkReport report;
    if (mesh.triangles.empty()) return report;
    if (mean_edge(mesh) > coarsest_in_widths * options.most_width) {
        report.is_too_coarse = true;
        return report;
    }
    const double spacing = options.most_width / 5;
    const Surroundings near(mesh, near_in_widths * options.most_width, spacing);
    context.progress("fits for marks", 0, 2);
    const std::vector<SurfaceFit> first = fits(near, mesh.points.size(), context);
    context.progress("fits for marks", 1, 2);
    std::vector<Dent> dents = line_like_dents(mesh, kinds_of(first, options), depths_of(first), limits_of(options));
    std::vector<std::uint8_t> is_dented(mesh.points.size(), 0);
    for (const Dent& dent : dents) {
        for (const std::uint32_t i : dent.points) is_dented[i] = 1;
    }
    widen(mesh, dents);
    const Surroundings far(mesh, far_in_widths * options.most_width, spacing);
    const Views views{fits_without(near, dents, is_dented), fits_without(far, dents, is_dented)};
    std::erase_if(dents, [&](const Dent& dent) { return !stands_out(dent, views, options.most_depth); });
    context.progress("fits for marks", 2, 2);
    lift(mesh, dents, views.near, report);
    return report;
}

}  // namespace qchopper
