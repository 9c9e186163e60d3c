#include "segment/picture/exploded.h"

#include <algorithm>
#include <limits>

#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

// The middle of the surface: inside the convex hull of the piece, so on the piece's side of every cut that bounds it.
Vec3 middle(const TriangleMesh& mesh) {
    Vec3 sum;
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& corner = mesh.triangles[t];
        const double weight = norm(area_vector(mesh, t));
        const Vec3 corners = mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]];
        sum = sum + weight / 3 * corners;
        area += weight;
    }
    return area > 0 ? 1 / area * sum : bounds(mesh).centre();
}

Box box_of_all(std::span<const Piece> pieces) {
    TriangleMesh corners;
    for (const Piece& piece : pieces) {
        const Box box = bounds(*piece.mesh);
        corners.points.push_back(box.min);
        corners.points.push_back(box.max);
    }
    return bounds(corners);
}

// How far apart two pieces stand per unit of the factor, along the normal of a cut between them; 0: no such cut.
double opening(const Piece& a, const Piece& b, Vec3 between) {
    for (const Bound& bound : a.bounds) {
        for (const Bound& other : b.bounds) {
            if (bound.cut == other.cut && bound.above != other.above) return -dot(bound.up(), between);
        }
    }
    return 0;
}

}  // namespace

std::vector<Vec3> exploded_shifts(std::span<const Piece> pieces, const ExplodeOptions& options) {
    const Box whole = box_of_all(pieces);
    const double wanted = options.gap * norm(whole.size());
    std::vector<Vec3> from_centre;
    for (const Piece& piece : pieces) from_centre.push_back(middle(*piece.mesh) - whole.centre());
    double factor = options.least_factor;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const double opens = opening(pieces[i], pieces[k], from_centre[k] - from_centre[i]);
            if (opens > 0) factor = std::max(factor, wanted / opens);
        }
    }
    factor = std::min(factor, options.most_factor);
    std::vector<Vec3> shifts;
    shifts.reserve(from_centre.size());
    for (const Vec3& out : from_centre) shifts.push_back(factor * out);
    return shifts;
}

std::vector<Coloured> coloured(std::span<const Piece> pieces, std::span<const Vec3> shifts) {
    std::vector<Coloured> all;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        all.push_back({pieces[i].mesh.get(), piece_colour(i), i < shifts.size() ? shifts[i] : Vec3{}});
    }
    return all;
}

}  // namespace qchopper
