// Two methods of CGAL that Nicholson 2016 does not survey, to compare the others with.
//
// Shape diameter: L. Shapira, A. Shamir and D. Cohen-Or, "Consistent mesh partitioning and skeletonisation using the
// shape diameter function" (2008). Variational: D. Cohen-Steiner, P. Alliez and M. Desbrun, "Variational shape
// approximation" (2004), with the metric of normals. A mesh that CGAL's Surface_mesh does not take is one region per
// connected part. O(n log n) for n triangles, with 25 rays per triangle or 30 rounds.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Variational_shape_approximation.h>
#include <CGAL/mesh_segmentation.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Mesh::Face_index;

constexpr std::size_t thickness_clusters = 4;
constexpr std::size_t most_proxies = 64;
constexpr std::size_t least_faces = 4;  // a closed mesh has as many
constexpr double error_drop = 0.02;     // of the error of one proxy
constexpr std::size_t rounds = 30;
constexpr unsigned seed = 1;

// Face t is triangle t.
std::optional<Mesh> surface_mesh(const FaceGraph& graph) {
    if (graph.size() < least_faces) return std::nullopt;
    Mesh mesh;
    std::vector<Mesh::Vertex_index> vertex;
    vertex.reserve(graph.mesh->points.size());
    for (const Vec3& p : graph.mesh->points) vertex.push_back(mesh.add_vertex({p.x, p.y, p.z}));
    for (const auto& [a, b, c] : graph.mesh->triangles) {
        if (mesh.add_face(vertex[a], vertex[b], vertex[c]) == Mesh::null_face()) return std::nullopt;
    }
    return mesh;
}

template <class Map>
Labels labels_from(const FaceGraph& graph, const Mesh& mesh, const Map& of) {
    std::vector<std::uint32_t> values;
    values.reserve(graph.size());
    for (const Face f : mesh.faces()) values.push_back(static_cast<std::uint32_t>(of[f]));
    return connected(graph, numbered(values));
}

Labels one_region(const FaceGraph& graph) {
    return connected(graph, numbered(std::vector<std::uint32_t>(graph.size(), 0)));
}

}  // namespace

Labels shape_diameter_parts(const FaceGraph& graph, const RegionOptions& options) {
    std::optional<Mesh> mesh = surface_mesh(graph);
    if (!mesh) return one_region(graph);
    CGAL::get_default_random() = CGAL::Random(seed);  // which CGAL begins anew in every process
    auto diameter = mesh->add_property_map<Face, double>("f:diameter").first;
    auto part = mesh->add_property_map<Face, std::size_t>("f:part").first;
    CGAL::sdf_values(*mesh, diameter);
    const std::size_t clusters =
        options.regions > 1 ? std::min(options.regions, thickness_clusters) : thickness_clusters;
    CGAL::segmentation_from_sdf_values(*mesh, diameter, part, clusters);
    return labels_from(graph, *mesh, part);
}

Labels variational_charts(const FaceGraph& graph, const RegionOptions& options) {
    namespace parameters = CGAL::parameters;
    std::optional<Mesh> mesh = surface_mesh(graph);
    if (!mesh) return one_region(graph);
    CGAL::get_default_random() = CGAL::Random(seed);  // which CGAL begins anew in every process
    auto proxy = mesh->add_property_map<Face, std::size_t>("f:proxy").first;
    using Points = Mesh::Property_map<Mesh::Vertex_index, Kernel::Point_3>;
    using Metric = CGAL::Surface_mesh_approximation::L21_metric_plane_proxy<Mesh, Points>;
    const Points points = mesh->points();
    const Metric metric(*mesh, points);  // which the approximation refers to
    CGAL::Variational_shape_approximation<Mesh, Points> fit(*mesh, points, metric);
    const std::size_t most = options.regions > 0 ? options.regions : most_proxies;
    fit.initialize_seeds(parameters::seeding_method(CGAL::Surface_mesh_approximation::HIERARCHICAL)
                             .max_number_of_proxies(std::min(most, graph.size()))
                             .min_error_drop(options.regions > 0 ? 0.0 : error_drop));
    fit.run(rounds);
    fit.proxy_map(proxy);
    return labels_from(graph, *mesh, proxy);
}

}  // namespace qchopper
