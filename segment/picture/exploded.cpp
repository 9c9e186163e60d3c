// One factor for all pieces, from the narrowest gap between the two sides of a cut. O(triangles + pieces squared).

#include "segment/picture/exploded.h"

#include <algorithm>

#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

// Lies in the convex hull of the piece, and so on its side of every cut that bounds it.
Vec3 surface_centroid(const TriangleMesh& mesh) {
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

// The distance by which two pieces separate per unit of the factor, along the normal of a cut between them; 0 without
// such a cut.
double separation(const Piece& a, const Piece& b, Vec3 between) {
    for (const HalfSpace& half_space : a.half_spaces) {
        for (const HalfSpace& other : b.half_spaces) {
            if (half_space.cut == other.cut && half_space.above != other.above) return -dot(half_space.up(), between);
        }
    }
    return 0;
}

}  // namespace

std::vector<Vec3> exploded_shifts(std::span<const Piece> pieces, const ExplodeOptions& options) {
    const Box whole = box_of_all(pieces);
    const double wanted = options.gap * norm(whole.size());
    std::vector<Vec3> from_centre;
    for (const Piece& piece : pieces) from_centre.push_back(surface_centroid(*piece.mesh) - whole.centre());
    double factor = options.min_factor;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const double distance = separation(pieces[i], pieces[k], from_centre[k] - from_centre[i]);
            if (distance > 0) factor = std::max(factor, wanted / distance);
        }
    }
    factor = std::min(factor, options.max_factor);
    std::vector<Vec3> shifts;
    shifts.reserve(from_centre.size());
    for (const Vec3& out : from_centre) shifts.push_back(factor * out);
    return shifts;
}

std::vector<ColouredMesh> coloured(std::span<const Piece> pieces, std::span<const Vec3> shifts) {
    std::vector<ColouredMesh> all;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        all.push_back({pieces[i].mesh.get(), piece_colour(i), i < shifts.size() ? shifts[i] : Vec3{}, pieces[i].name});
    }
    return all;
}

}  // namespace qchopper
