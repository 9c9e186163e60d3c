#include "segment/regions/methods.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "base/parallel.h"
#include "segment/mesh/triangle_tree.h"
#include "segment/regions/straight_borders.h"
#include "segment/simplify/simplify.h"

namespace qchopper {
namespace {

constexpr double min_share = 0.002;

constexpr std::array table{
    RegionMethod{"superfaces", RegionsSought::charts, 100'000, superfaces},
    RegionMethod{"shuffler", RegionsSought::parts, 20'000, shuffler_parts},
    RegionMethod{"eck", RegionsSought::charts, 100'000, eck_tiles},
    RegionMethod{"zhou-huang", RegionsSought::parts, 100'000, zhou_huang_parts},
    RegionMethod{"garland", RegionsSought::charts, 100'000, garland_clusters},
    RegionMethod{"attene", RegionsSought::charts, 100'000, attene_primitives},
    RegionMethod{"sander", RegionsSought::charts, 100'000, sander_charts},
    RegionMethod{"shlafman", RegionsSought::parts, 100'000, shlafman_parts},
    RegionMethod{"katz-tal", RegionsSought::parts, 20'000, katz_tal_parts},
    RegionMethod{"liu-zhang", RegionsSought::parts, 30'000, liu_zhang_parts},
    RegionMethod{"shape-diameter", RegionsSought::parts, 30'000, shape_diameter_parts},
    RegionMethod{"variational", RegionsSought::charts, 30'000, variational_charts},
};

// The connected part of a surface with the most area, as a mesh.
TriangleMesh largest_part(const TriangleMesh& mesh) {
    const FaceGraph graph = face_graph(mesh);
    const Labels parts = connected(graph, numbered(std::vector<std::uint32_t>(graph.size(), 0)));
    if (parts.count == 1) return mesh;
    const std::vector<double> area = region_areas(graph, parts);
    const auto largest = static_cast<std::uint32_t>(std::ranges::max_element(area) - area.begin());
    constexpr std::uint32_t unused = no_dual_edge;
    std::vector<std::uint32_t> number(mesh.points.size(), unused);
    TriangleMesh part;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (parts.of[t] != largest) continue;
        std::array<std::uint32_t, 3> corners = mesh.triangles[t];
        for (std::uint32_t& p : corners) {
            if (number[p] == unused) {
                number[p] = static_cast<std::uint32_t>(part.points.size());
                part.points.push_back(mesh.points[p]);
            }
            p = number[p];
        }
        part.triangles.push_back(corners);
    }
    return part;
}

}  // namespace

std::span<const RegionMethod> region_methods() {
    return table;
}

const RegionMethod* region_method(std::string_view name) {
    const auto found = std::ranges::find(table, name, &RegionMethod::name);
    return found == table.end() ? nullptr : &*found;
}

std::string names_of_region_methods() {
    std::string names;
    for (const RegionMethod& method : table) names += (names.empty() ? "" : ", ") + std::string(method.name);
    return names;
}

ScanRegions scan_regions(const TriangleMesh& scan, const RegionMethod& method, const RegionOptions& options,
                         const Context& context) {
    assert(!scan.triangles.empty());
    ScanRegions regions{scan, {}};
    regions.copy.cap_of.clear();
    if (scan.triangles.size() > method.faces) {
        SimplifyOptions fewer;
        fewer.max_faces = method.faces;
        fewer.is_quick = true;
        simplify(regions.copy, fewer, context);
    }
    context.check_cancelled();
    regions.copy = largest_part(regions.copy);
    const FaceGraph graph = face_graph(regions.copy);
    regions.labels = method.labels(graph, options);
    const bool are_parts = method.sought == RegionsSought::parts;
    if (are_parts) regions.labels = without_small(graph, regions.labels, min_share);
    regions.labels = with_straight_borders(graph, regions.labels);
    return regions;
}

Labels on_scan(const ScanRegions& regions, const TriangleMesh& scan) {
    const TriangleTree tree(regions.copy);
    std::vector<std::uint32_t> values(scan.triangles.size());
    constexpr std::size_t grain = 1'000;
    parallel_ranges(0, values.size(), grain, [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t) {
            const auto [a, b, c] = corners_of(scan, t);
            values[t] = regions.labels.of[tree.nearest(regions.copy, (1.0 / 3) * (a + b + c)).triangle];
        }
    });
    return numbered(values);
}

}  // namespace qchopper
