// Every point is compared with a robust fit of the surface around it (surface_fit.h), which a narrow line does not pull
// down. Points that lie too deep are grouped along edges; a group is measured by the distance of its points from its
// rim (E. Dijkstra, "A note on two problems in connexion with graphs", 1959), and those that are long and nowhere wide
// are grooves. A second fit without the points of the lines gives the positions to which they are lifted. The cost is
// one fit per point, on all cores, and O(n log n) for the rest.

#include "segment/repair/pen_grooves/pen_grooves.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/normals.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/pen_grooves/surface_fit.h"

namespace qchopper {
namespace {

constexpr double near_in_widths = 0.9;      // reach of the fits
constexpr double far_in_widths = 1.35;      // of the second fits, which show whether the depth grows with the reach
constexpr double coarsest_in_widths = 0.4;  // mean edge: with fewer than three points across, no line is resolved
constexpr double seed_in_roughness = 4;     // depth that noise does not reach
constexpr double flank_in_roughness = 1;
constexpr double mean_in_roughness = 5.7;  // mean depth of a whole pen groove
constexpr double min_known = 0.9;          // share of its points with good fits
constexpr double max_growth = 1.2;         // of its depth: between crests of the bone it grows with the reach
constexpr double min_depth_mm = 0.02;

enum class GrooveKind : std::uint8_t {
    none,
    flank,  // belongs to a groove if it is connected to a seed
    seed
};

struct Groove {
    std::vector<std::uint32_t> points;  // ascending
    double area_mm2 = 0;
    double width = 0;   // mean
    double length = 0;  // area over width: of all branches together
    double depth = 0;   // of the deepest point
};

constexpr double infinite = std::numeric_limits<double>::infinity();

// Neighbours of every point along edges, in one array; each is listed once per triangle of the edge.
struct Neighbours {
    std::vector<std::uint32_t> first;  // per point where its neighbours begin in `all`; one more at the end
    std::vector<std::uint32_t> all;

    explicit Neighbours(const TriangleMesh& mesh) : first(mesh.points.size() + 1, 0) {
        for (const Triangle& t : mesh.triangles) {
            for (const std::uint32_t corner : t) first[corner + 1] += 2;
        }
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        all.resize(first.back());
        std::vector<std::uint32_t> filled(first.begin(), first.end() - 1);
        for (const Triangle& t : mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                all[filled[t[k]]++] = t[(k + 1) % 3];
                all[filled[t[k]]++] = t[(k + 2) % 3];
            }
        }
    }
};

// Per point of a groove the length of the shortest way along edges out of it: to the middle of an edge that leaves it.
std::vector<double> distances_out(const TriangleMesh& mesh, const Neighbours& next,
                                  const std::vector<std::uint8_t>& is_in) {
    std::vector<double> way(mesh.points.size(), 0);
    using Open = std::pair<double, std::uint32_t>;
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    for (std::uint32_t i = 0; i < way.size(); ++i) {
        if (is_in[i] == 0) continue;
        way[i] = infinite;
        for (std::uint32_t k = next.first[i]; k < next.first[i + 1]; ++k) {
            const Vec3 across = mesh.points[i] - mesh.points[next.all[k]];
            if (is_in[next.all[k]] == 0) way[i] = std::min(way[i], 0.5 * norm(across));
        }
        if (way[i] < infinite) open.push({way[i], i});
    }
    while (!open.empty()) {
        const auto [so_far, i] = open.top();
        open.pop();
        if (so_far > way[i]) continue;
        for (std::uint32_t k = next.first[i]; k < next.first[i + 1]; ++k) {
            const std::uint32_t j = next.all[k];
            const double longer = so_far + norm(mesh.points[j] - mesh.points[i]);
            if (is_in[j] == 0 || longer >= way[j]) continue;
            way[j] = longer;
            open.push({longer, j});
        }
    }
    return way;
}

// Per point a third of the area of its triangles.
std::vector<double> areas_of(const TriangleMesh& mesh) {
    std::vector<double> areas(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double third = norm(area_vector(mesh, t)) / 3;
        for (const std::uint32_t corner : mesh.triangles[t]) areas[corner] += third;
    }
    return areas;
}

// Connected groups of points that have a seed, in the order of their first points.
std::vector<Groove> groups(const Neighbours& next, const std::vector<GrooveKind>& kinds) {
    DisjointSets sets(kinds.size());
    for (std::uint32_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == GrooveKind::none) continue;
        for (std::uint32_t k = next.first[i]; k < next.first[i + 1]; ++k) {
            if (kinds[next.all[k]] != GrooveKind::none) sets.unite(i, next.all[k]);
        }
    }
    std::vector<std::uint8_t> has_seed(kinds.size(), 0);
    for (std::uint32_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == GrooveKind::seed) has_seed[sets.root(i)] = 1;
    }
    std::vector<Groove> grooves;
    std::vector<std::uint32_t> number(kinds.size(), 0);
    for (std::uint32_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == GrooveKind::none || has_seed[sets.root(i)] == 0) continue;
        if (sets.root(i) == i) {
            number[i] = static_cast<std::uint32_t>(grooves.size());
            grooves.emplace_back();
        }
        grooves[number[sets.root(i)]].points.push_back(i);
    }
    return grooves;
}

bool is_line(const Groove& groove, const PenGrooveOptions& o) {
    constexpr double min_slenderness = 4;
    const double min_length = o.min_length > 0 ? o.min_length : 3 * o.max_width;
    return groove.depth <= o.max_depth && groove.width <= o.max_width && groove.length >= min_length &&
           groove.length >= min_slenderness * groove.width;
}

// The grooves within the options' limits, in the order of their first points. `kinds` and `fits`: one per point of the
// mesh.
std::vector<Groove> line_like_grooves(const TriangleMesh& mesh, const std::vector<GrooveKind>& kinds,
                                      const std::vector<SurfaceFit>& fits, const PenGrooveOptions& options) {
    const Neighbours next(mesh);
    const std::vector<double> areas = areas_of(mesh);
    std::vector<std::uint8_t> is_in(kinds.size(), 0);
    for (std::size_t i = 0; i < kinds.size(); ++i) is_in[i] = kinds[i] != GrooveKind::none ? 1 : 0;
    const std::vector<double> way = distances_out(mesh, next, is_in);
    std::vector<Groove> grooves = groups(next, kinds);
    for (Groove& groove : grooves) {
        double weighted = 0;
        for (const std::uint32_t i : groove.points) {
            groove.area_mm2 += areas[i];
            weighted += areas[i] * way[i];
            groove.depth = std::max(groove.depth, fits[i].depth);
        }
        // The mean distance from the rim of a strip is a quarter of its width.
        groove.width = groove.area_mm2 > 0 ? 4 * weighted / groove.area_mm2 : 0;
        groove.length = groove.width > 0 ? groove.area_mm2 / groove.width : 0;
    }
    std::erase_if(grooves, [&](const Groove& groove) { return !is_line(groove, options); });
    return grooves;
}

void check(const PenGrooveOptions& o) {
    const auto is_length = [](double mm) { return std::isfinite(mm) && mm >= 0; };
    if (is_length(o.max_width) && is_length(o.max_depth) && is_length(o.min_depth) && is_length(o.min_length) &&
        o.max_width > 0 && o.max_depth > o.min_depth) {
        return;
    }
    throw InputError(InputFault::use, "no pen groove has this width and depth",
                     "give a width and a depth above 0 in mm, for example 6 and 1");
}

double mean_edge(const TriangleMesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) sum += norm(mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]]);
    }
    return sum / static_cast<double>(std::max<std::size_t>(3 * mesh.triangles.size(), 1));
}

std::vector<SurfaceFit> fits(const SurfaceFitter& fitter, std::size_t points, const Context& context) {
    std::vector<SurfaceFit> all(points);
    context.check_cancelled();
    parallel_for(0, points, [&](std::size_t i) { all[i] = fitter.fit(static_cast<std::uint32_t>(i)); });
    context.check_cancelled();
    return all;
}

// Fits at the points of all grooves, to the samples outside of grooves; one per point of the mesh.
std::vector<SurfaceFit> fits_without(const SurfaceFitter& fitter, const std::vector<Groove>& grooves,
                                     const std::vector<std::uint8_t>& is_in_groove) {
    std::vector<SurfaceFit> all(is_in_groove.size());
    for (const Groove& groove : grooves) {
        parallel_for(0, groove.points.size(),
                     [&](std::size_t k) { all[groove.points[k]] = fitter.fit(groove.points[k], &is_in_groove); });
    }
    return all;
}

// Adds to every groove the points next to it, where its flanks end.
void widen(const TriangleMesh& mesh, std::vector<Groove>& grooves) {
    std::vector<std::uint32_t> number(mesh.points.size(), 0);  // of the groove, from 1
    for (std::uint32_t g = 0; g < grooves.size(); ++g) {
        for (const std::uint32_t i : grooves[g].points) number[i] = g + 1;
    }
    std::vector<std::uint32_t> wider = number;
    for (const Triangle& t : mesh.triangles) {
        const std::uint32_t near = std::max({number[t[0]], number[t[1]], number[t[2]]});
        for (const std::uint32_t corner : t) wider[corner] = std::max(wider[corner], near);
    }
    for (Groove& groove : grooves) groove.points.clear();
    for (std::uint32_t i = 0; i < wider.size(); ++i) {
        if (wider[i] > 0) grooves[wider[i] - 1].points.push_back(i);
    }
}

// Fits with both reaches, one per point of the mesh.
struct NearAndFarFits {
    std::vector<SurfaceFit> near;
    std::vector<SurfaceFit> far;
};

// Whether the surface around the groove is known and smooth compared with the depth of the groove, and the depth does
// not depend on the reach: in a valley of the bone it would.
bool is_distinct(const Groove& groove, const NearAndFarFits& fits, double max_depth) {
    double near = 0;
    double far = 0;
    double roughness = 0;
    double deepest = 0;
    std::size_t known = 0;
    for (const std::uint32_t i : groove.points) {
        if (fits.near[i].is_good) deepest = std::max(deepest, fits.near[i].depth);
        if (!fits.near[i].is_good || !fits.far[i].is_good) continue;
        near += std::max(0.0, fits.near[i].depth);
        far += std::max(0.0, fits.far[i].depth);
        roughness += fits.near[i].roughness;
        ++known;
    }
    return static_cast<double>(known) >= min_known * static_cast<double>(groove.points.size()) &&
           near >= mean_in_roughness * roughness && far <= max_growth * near && near <= max_growth * far &&
           deepest <= max_depth;
}

// Seeds are deep compared with the roughness there; flanks only lie below the surface.
std::vector<GrooveKind> kinds_of(const std::vector<SurfaceFit>& fits, const PenGrooveOptions& o) {
    std::vector<GrooveKind> kinds(fits.size(), GrooveKind::none);
    for (std::size_t i = 0; i < fits.size(); ++i) {
        if (!fits[i].is_good) continue;
        const double least =
            o.min_depth > 0 ? o.min_depth : std::max(min_depth_mm, seed_in_roughness * fits[i].roughness);
        const double flank = std::max(0.25 * min_depth_mm, flank_in_roughness * fits[i].roughness);
        if (fits[i].depth >= least) {
            kinds[i] = GrooveKind::seed;
        } else if (fits[i].depth >= std::min(flank, 0.5 * least)) {
            kinds[i] = GrooveKind::flank;
        }
    }
    return kinds;
}

void lift(TriangleMesh& mesh, const std::vector<Groove>& grooves, const std::vector<SurfaceFit>& fits,
          PenGrooveReport& report) {
    std::vector<std::uint8_t> is_moved(mesh.points.size(), 0);
    double sum = 0;
    for (const Groove& groove : grooves) {
        report.length_mm += groove.length;
        for (const std::uint32_t i : groove.points) {
            const SurfaceFit& fit = fits[i];
            if (!fit.is_good || fit.depth <= 0) continue;
            const Vec3 lifted = mesh.points[i] + fit.depth * fit.normal;
            if (report.points_moved == 0) report.box = {lifted, lifted};
            extend(report.box, lifted);
            mesh.points[i] = lifted;
            is_moved[i] = 1;
            ++report.points_moved;
            report.max_depth = std::max(report.max_depth, fit.depth);
            sum += fit.depth;
        }
    }
    if (report.points_moved == 0) return;
    report.count = grooves.size();
    report.mean_depth = sum / static_cast<double>(report.points_moved);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& c = mesh.triangles[t];
        if (is_moved[c[0]] + is_moved[c[1]] + is_moved[c[2]] > 0) report.area_mm2 += norm(area_vector(mesh, t));
    }
}

}  // namespace

PenGrooveReport smooth_pen_grooves(TriangleMesh& mesh, const PenGrooveOptions& options, const Context& context) {
    check(options);
    PenGrooveReport report;
    if (mesh.triangles.empty()) return report;
    if (mean_edge(mesh) > coarsest_in_widths * options.max_width) {
        report.is_too_coarse = true;
        return report;
    }
    const double spacing = options.max_width / 5;
    const SurfaceFitter near(mesh, near_in_widths * options.max_width, spacing);
    context.progress("surface fits for pen grooves", 0, 2);
    const std::vector<SurfaceFit> first = fits(near, mesh.points.size(), context);
    context.progress("surface fits for pen grooves", 1, 2);
    std::vector<Groove> grooves = line_like_grooves(mesh, kinds_of(first, options), first, options);
    std::vector<std::uint8_t> is_in_groove(mesh.points.size(), 0);
    for (const Groove& groove : grooves) {
        for (const std::uint32_t i : groove.points) is_in_groove[i] = 1;
    }
    widen(mesh, grooves);
    const SurfaceFitter far(mesh, far_in_widths * options.max_width, spacing);
    const NearAndFarFits second{fits_without(near, grooves, is_in_groove), fits_without(far, grooves, is_in_groove)};
    std::erase_if(grooves, [&](const Groove& groove) { return !is_distinct(groove, second, options.max_depth); });
    context.progress("surface fits for pen grooves", 2, 2);
    lift(mesh, grooves, second.near, report);
    return report;
}

}  // namespace qchopper
