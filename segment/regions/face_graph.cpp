#include "segment/regions/face_graph.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

DualEdge dual_edge(const FaceGraph& graph, std::uint32_t half_edge, std::uint32_t twin) {
    const TriangleMesh& mesh = *graph.mesh;
    DualEdge edge;
    edge.face = {half_edge / 3, twin / 3};
    edge.point = {mesh.triangles[half_edge / 3][half_edge % 3], mesh.triangles[half_edge / 3][(half_edge % 3 + 1) % 3]};
    const Vec3 a = mesh.points[edge.point[0]];
    const Vec3 b = mesh.points[edge.point[1]];
    const Vec3 middle = 0.5 * (a + b);
    const auto [f, g] = edge.face;
    edge.length = norm(b - a);
    edge.path = norm(graph.centroid[f] - middle) + norm(graph.centroid[g] - middle);
    const Vec3 turned = cross(graph.normal[f], graph.normal[g]);
    edge.turn = std::atan2(norm(turned), dot(graph.normal[f], graph.normal[g]));
    edge.is_concave = dot(graph.normal[f], graph.centroid[g] - graph.centroid[f]) > 0;
    if (edge.face[0] > edge.face[1]) std::swap(edge.face[0], edge.face[1]);
    return edge;
}

}  // namespace

FaceGraph face_graph(const TriangleMesh& mesh) {
    assert(is_consistent(mesh));
    FaceGraph graph;
    graph.mesh = &mesh;
    graph.diagonal = norm(bounds(mesh).size());
    const std::size_t faces = mesh.triangles.size();
    graph.centroid.reserve(faces);
    graph.normal.reserve(faces);
    graph.area.reserve(faces);
    for (std::size_t t = 0; t < faces; ++t) {
        const auto [a, b, c] = corners_of(mesh, t);
        const Vec3 vector = area_vector(mesh, t);
        graph.centroid.push_back((1.0 / 3) * (a + b + c));
        graph.normal.push_back(normalized(vector));
        graph.area.push_back(norm(vector));
    }
    graph.around.assign(faces, {no_dual_edge, no_dual_edge, no_dual_edge});
    const Edges pairs = edges(mesh);
    for (std::uint32_t h = 0; h < pairs.twin.size(); ++h) {
        const std::uint32_t twin = pairs.twin[h];
        if (twin == no_twin || twin < h) continue;
        const auto number = static_cast<std::uint32_t>(graph.edges.size());
        graph.around[h / 3][h % 3] = number;
        graph.around[twin / 3][twin % 3] = number;
        graph.edges.push_back(dual_edge(graph, h, twin));
    }
    return graph;
}

Vec3 surface_centroid(const FaceGraph& graph, std::span<const std::uint32_t> faces) {
    Vec3 sum;
    double area = 0;
    const auto add = [&](std::size_t f) {
        sum = sum + graph.area[f] * graph.centroid[f];
        area += graph.area[f];
    };
    for (const std::uint32_t f : faces) add(f);
    for (std::size_t f = 0; faces.empty() && f < graph.size(); ++f) add(f);
    return area > 0 ? (1 / area) * sum : sum;
}

std::uint32_t farthest_face(const FaceGraph& graph, Vec3 from) {
    assert(graph.size() > 0);
    const auto nearer = [&](Vec3 a, Vec3 b) { return dot(a - from, a - from) < dot(b - from, b - from); };
    return static_cast<std::uint32_t>(std::ranges::max_element(graph.centroid, nearer) - graph.centroid.begin());
}

std::uint32_t nearest_face(const FaceGraph& graph, Vec3 from) {
    assert(graph.size() > 0);
    const auto nearer = [&](Vec3 a, Vec3 b) { return dot(a - from, a - from) < dot(b - from, b - from); };
    return static_cast<std::uint32_t>(std::ranges::min_element(graph.centroid, nearer) - graph.centroid.begin());
}

}  // namespace qchopper
