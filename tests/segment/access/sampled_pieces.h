// Pieces with their accessibility, and the slow reference: rays cast on the mesh of the piece that was really cut.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "segment/access/accessibility.h"
#include "segment/access/tool_directions.h"
#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/connectivity/solids.h"
#include "segment/mesh/oriented_box.h"
#include "tests/pieces.h"

namespace qchopper {

struct TrackedPiece {
    Piece piece;
    PieceAccessibility accessibility;
};

inline std::vector<Piece> pieces_of_solids(const TriangleMesh& mesh) {
    std::vector<Piece> pieces;
    for (TriangleMesh& solid : split_solids(mesh, {0, 0, 1})) pieces.push_back(piece_of(std::move(solid)));
    return pieces;
}

inline SampledScan sampled(const TriangleMesh& mesh, std::size_t samples,
                           PreciseRays::Instructions instructions = PreciseRays::Instructions::widest) {
    SampledScanOptions options;
    options.samples = samples;
    options.instructions = instructions;
    return sampled_scan(pieces_of_solids(mesh), tool_directions(oriented_box(mesh.points).axis), options);
}

inline std::vector<TrackedPiece> uncut_pieces(const SampledScan& scan) {
    std::vector<TrackedPiece> pieces;
    for (PieceAccessibility& a : uncut_accessibility(scan)) {
        Piece piece;
        piece.mesh = scan.solid[a.solid];
        pieces.push_back({std::move(piece), std::move(a)});
    }
    return pieces;
}

// Replaces pieces[which] by what a plane makes of it. Returns how many pieces it makes; 0 if the plane misses.
inline std::size_t cut_along(const SampledScan& scan, std::vector<TrackedPiece>& pieces, std::size_t which,
                             const Plane& plane, std::int32_t number) {
    const TrackedPiece parent = pieces[which];
    const auto made = cut_piece(parent.piece, plane, number);
    if (!made) return 0;
    std::vector<PieceAccessibility> accessibility = cut_accessibility(scan, parent.accessibility, *made);
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(which));
    for (std::size_t k = 0; k < made->pieces.size(); ++k) {
        pieces.push_back({made->pieces[k], std::move(accessibility[k])});
    }
    return made->pieces.size();
}

// The same along a plane at this share of the piece's extent, nudged.
inline std::size_t cut_at(const SampledScan& scan, std::vector<TrackedPiece>& pieces, std::size_t which, Vec3 normal,
                          double share, std::int32_t number) {
    const Piece& parent = pieces[which].piece;
    const Extent range = extent(*parent.mesh, normal);
    const auto nudged = nudge(parent, normal, std::array{range.low + share * range.size()});
    return nudged[0] ? cut_along(scan, pieces, which, {normal, nudged[0]->offset}, number) : 0;
}

inline Vec3 origin_of(const SampledScan& scan, const SurfaceSample& sample) {
    return sample.point + (1e-6 * scan.diagonal_mm) * sample.normal;
}

// Distance to the first triangle by trying all: Moller and Trumbore, "Fast, minimum storage ray/triangle intersection"
// (1997).
inline double brute_force_distance(const TriangleMesh& mesh, Vec3 origin, Vec3 direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = corners_of(mesh, t);
        const Vec3 p = cross(direction, c - a);
        const double determinant = dot(b - a, p);
        if (determinant == 0) continue;
        const double u = dot(origin - a, p) / determinant;
        const Vec3 q = cross(origin - a, b - a);
        const double v = dot(direction, q) / determinant;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const double distance = dot(c - a, q) / determinant;
        if (distance >= 0) nearest = std::min(nearest, distance);
    }
    return nearest;
}

// Whether samples of a piece are open, from the mesh of the cut piece alone.
class CutPieceReference {
 public:
    CutPieceReference(const SampledScan& scan, const TrackedPiece& piece)
        : scan_(scan), piece_(piece), tree_(*piece.piece.mesh) {}
    // In single precision; where that is not `expected`, all triangles are tried in double precision.
    bool is_open(std::size_t row, Vec3 direction, bool expected) const {
        const SurfaceSample& sample = scan_.samples.sample[piece_.accessibility.sample[row]];
        if (dot(sample.normal, direction) < min_facing) return false;
        const Vec3 origin = origin_of(scan_, sample);
        const bool is_open = !tree_.meets(origin, direction);
        return is_open == expected ? expected : std::isinf(brute_force_distance(*piece_.piece.mesh, origin, direction));
    }
    // Whether the sample lies on a plane of its piece, within the flush tolerance.
    bool lies_on_a_plane(std::size_t row) const {
        const Vec3 point = scan_.samples.sample[piece_.accessibility.sample[row]].point;
        return std::any_of(piece_.piece.half_spaces.begin(), piece_.piece.half_spaces.end(), [&](const HalfSpace& h) {
            return std::abs(height(h.plane.normal, point) - h.plane.offset) < 4e-6 * scan_.diagonal_mm;
        });
    }

 private:
    const SampledScan& scan_;
    const TrackedPiece& piece_;
    RayTree tree_;
};

}  // namespace qchopper
