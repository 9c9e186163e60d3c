// Lists of faults are those of links.h; edges of more than one face are grouped by their ends. Only the places that are
// taken are worked out. O(faults log faults), and a pass over the triangles each for collapsed and repeated ones.

#include "segment/import/fault_places.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "segment/mesh/connectivity/manifold.h"

namespace qchopper {
namespace {

Vec3 centroid(const TriangleMesh& mesh, std::uint32_t triangle) {
    const Triangle& t = mesh.triangles[triangle];
    return (1.0 / 3) * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]);
}

Vec3 middle(const TriangleMesh& mesh, std::uint32_t half_edge) {
    return 0.5 * (mesh.points[start_of(mesh, half_edge)] + mesh.points[end_of(mesh, half_edge)]);
}

// Those that have the corners of an earlier one.
std::vector<std::uint32_t> repeated_triangles(const TriangleMesh& mesh) {
    std::vector<std::pair<Triangle, std::uint32_t>> sorted(mesh.triangles.size());
    for (std::uint32_t t = 0; t < sorted.size(); ++t) {
        sorted[t] = {mesh.triangles[t], t};
        std::ranges::sort(sorted[t].first);
    }
    std::ranges::sort(sorted);
    std::vector<std::uint32_t> repeated;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        if (sorted[i].first == sorted[i - 1].first) repeated.push_back(sorted[i].second);
    }
    std::ranges::sort(repeated);
    return repeated;
}

}  // namespace

std::vector<IrregularEdge> irregular_edges(const TriangleMesh& mesh, const Links& links) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, IrregularEdge> by_ends;
    for (const std::uint32_t h : links.non_manifold) {
        const std::uint32_t from = start_of(mesh, h);
        const std::uint32_t to = end_of(mesh, h);
        IrregularEdge& edge = by_ends.try_emplace(std::minmax(from, to), IrregularEdge{h}).first->second;
        ++(from < to ? edge.up : edge.down);
    }
    std::vector<IrregularEdge> edges;
    edges.reserve(by_ends.size());
    for (const auto& [ends, edge] : by_ends) edges.push_back(edge);
    std::ranges::sort(edges, {}, &IrregularEdge::half_edge);
    return edges;
}

void add_places(std::vector<FaultPlaces>& all, const char* kind, std::size_t count,
                const std::function<Vec3(std::size_t)>& place) {
    if (count == 0) return;
    FaultPlaces places{kind, {}};
    const std::size_t taken = std::min(count, max_places_of_kind);
    for (std::size_t i = 0; i < taken; ++i) places.points.push_back(place(i * count / taken));
    all.push_back(std::move(places));
}

void add_face_places(std::vector<FaultPlaces>& all, const char* kind, const TriangleMesh& mesh,
                     const std::vector<std::uint32_t>& triangles) {
    add_places(all, kind, triangles.size(), [&](std::size_t i) { return centroid(mesh, triangles[i]); });
}

void add_collapsed_places(std::vector<FaultPlaces>& all, const TriangleMesh& mesh) {
    std::vector<std::uint32_t> collapsed;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& corner = mesh.triangles[t];
        const Vec3& a = mesh.points[corner[0]];
        const Vec3& b = mesh.points[corner[1]];
        const Vec3& c = mesh.points[corner[2]];
        if (a == b || b == c || c == a) collapsed.push_back(t);
    }
    add_face_places(all, "collapsed_faces", mesh, collapsed);
}

void add_link_places(std::vector<FaultPlaces>& all, const TriangleMesh& mesh, const Links& links,
                     const std::vector<IrregularEdge>& edges) {
    add_places(all, "open_edges", links.open.size(), [&](std::size_t i) { return middle(mesh, links.open[i]); });
    const auto add = [&](const char* kind, const auto& is_of_kind) {
        std::vector<std::uint32_t> half_edges;
        for (const IrregularEdge& edge : edges) {
            if (is_of_kind(edge)) half_edges.push_back(edge.half_edge);
        }
        add_places(all, kind, half_edges.size(), [&](std::size_t i) { return middle(mesh, half_edges[i]); });
    };
    add("non_manifold_edges", [](const IrregularEdge& edge) { return !edge.is_inconsistent(); });
    add("touching_edges", [](const IrregularEdge& edge) { return edge.is_touching(); });
    add("inconsistent_edges", [](const IrregularEdge& edge) { return edge.is_inconsistent(); });
    add_places(all, "non_manifold_vertices", links.extra_fans.size(),
               [&](std::size_t i) { return mesh.points[start_of(mesh, links.extra_fans[i][0])]; });
    if (links.repeated > 0) add_face_places(all, "repeated_faces", mesh, repeated_triangles(mesh));
}

}  // namespace qchopper
