#include "segment/score/prepared.h"

#include <algorithm>
#include <map>

#include "segment/mesh/normals.h"

namespace qchopper {
namespace {

std::vector<std::uint32_t> earlier_neighbours(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> neighbour(mesh.points.size(), no_twin);
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k];
            const std::uint32_t b = t[(k + 1) % 3];
            const std::uint32_t high = std::max(a, b);
            const std::uint32_t low = std::min(a, b);
            if (neighbour[high] == no_twin || neighbour[high] < low) neighbour[high] = low;
        }
    }
    for (std::uint32_t v = 0; v < neighbour.size(); ++v) {
        if (neighbour[v] == no_twin) neighbour[v] = v;
    }
    return neighbour;
}

std::vector<std::uint16_t> bases(const Piece& piece) {
    std::vector<std::uint16_t> result;
    if (piece.mesh->cap_of.empty() || piece.bounds.empty()) return result;
    std::map<std::int32_t, std::uint16_t> index;
    for (std::size_t b = 0; b < piece.bounds.size(); ++b) index[piece.bounds[b].cut] = static_cast<std::uint16_t>(b);
    result.reserve(piece.mesh->cap_of.size());
    for (const std::int32_t cap : piece.mesh->cap_of) {
        const auto it = cap == no_cap ? index.end() : index.find(cap);
        result.push_back(it == index.end() ? no_base : it->second);
    }
    return result;
}

}  // namespace

PreparedPiece prepare(const Piece& piece, const Objectives& objectives) {
    const TriangleMesh& mesh = *piece.mesh;
    PreparedPiece p;
    p.piece = &piece;
    p.origin = mesh.points.empty() ? Vec3{} : mesh.points.front();
    p.edges = edges(mesh);
    p.shells = shells(mesh);
    p.neighbour = earlier_neighbours(mesh);
    p.base = bases(piece);
    for (const Bound& bound : piece.bounds) p.up.push_back(bound.up());
    p.sums.resize(mesh.triangles.size());
    for (std::size_t t = 0; t < p.sums.size(); ++t) {
        const Vec3 area = area_vector(mesh, t);
        p.sums[t] = {area, dot(mesh.points[mesh.triangles[t][0]] - p.origin, area) / 3};
    }
    if (!objectives.undercut_by_area) {
        p.unit.resize(p.sums.size());
        for (std::size_t t = 0; t < p.unit.size(); ++t) {
            const bool is_cap = !p.base.empty() && p.base[t] != no_base;
            p.unit[t] = is_cap ? -piece.bounds[p.base[t]].up() : normalized(p.sums[t].area);
        }
    }
    if (objectives.fragility_form == FragilityForm::thesis) p.vertex_normals = vertex_normals(mesh);
    return p;
}

}  // namespace qchopper
