#include "segment/score/prepared.h"

#include <tbb/parallel_invoke.h>

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

std::vector<TriangleSums> triangle_sums(const TriangleMesh& mesh, Vec3 origin) {
    std::vector<TriangleSums> sums(mesh.triangles.size());
    for (std::size_t t = 0; t < sums.size(); ++t) {
        const Vec3 area = area_vector(mesh, t);
        sums[t] = {area, dot(mesh.points[mesh.triangles[t][0]] - origin, area) / 3};
    }
    return sums;
}

// A cap takes its plane's normal: its triangles may be too thin to have one of their own.
std::vector<Vec3> unit_normals(const PreparedPiece& p) {
    std::vector<Vec3> unit(p.sums.size());
    for (std::size_t t = 0; t < unit.size(); ++t) {
        const bool is_cap = !p.base.empty() && p.base[t] != no_base;
        unit[t] = is_cap ? -p.up[p.base[t]] : normalized(p.sums[t].area);
    }
    return unit;
}

}  // namespace

PreparedPiece prepare(const Piece& piece, const Objectives& objectives) {
    const TriangleMesh& mesh = *piece.mesh;
    PreparedPiece p;
    p.piece = &piece;
    p.origin = mesh.points.empty() ? Vec3{} : mesh.points.front();
    p.base = bases(piece);
    for (const Bound& bound : piece.bounds) p.up.push_back(bound.up());
    // Four passes that know nothing of each other.
    tbb::parallel_invoke([&] { p.edges = edges(mesh); }, [&] { p.shells = shells(mesh); },
                         [&] { p.neighbour = earlier_neighbours(mesh); },
                         [&] { p.sums = triangle_sums(mesh, p.origin); });
    if (!objectives.undercut_by_area) p.unit = unit_normals(p);
    if (objectives.fragility_form == FragilityForm::thesis) p.vertex_normals = vertex_normals(mesh);
    return p;
}

}  // namespace qchopper
