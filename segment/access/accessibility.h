// Along which directions a tool of radius zero comes out of a piece, at samples of its surface: accessibility.
//
// mm. A sample is open along a direction if the ray from it leaves its piece without meeting the piece's surface. One
// set of rays of the uncut scan serves the whole segmentation: a cut removes what lies beyond its plane, so a ray that
// meets a plane of its piece before the surface leaves the piece there. Only where a cut parts solids on one side of
// its plane are rays cast again. Other solids of the scan, fragments included, do not block. The same bytes for any
// number of threads and any instruction set: rays are decided in double precision (rays.h), because fixing the set
// would still leave the processors' reciprocals. Equal to rays cast on really cut pieces, but for rays that pass a cut
// within the flush tolerance: tests/segment/access/accessibility_test.cpp. Related: Mahdavi-Amiri et al., "VDAC: volume
// decompose-and-carve for subtractive manufacturing" (2020).
//
// Memory: 4 bytes per sample and direction, 21 MB for 20,000 x 264, shared out among the pieces; 4 bytes per triangle
// of a piece; and the trees, about 80 bytes per triangle of the scan.

#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "segment/access/surface_samples.h"
#include "segment/cut/cut_piece.h"
#include "segment/mesh/rays.h"

namespace qchopper {

// Below this cosine of the angle between normal and direction a sample is not open: the surface faces away, or is
// steep.
constexpr double min_facing = 0.05;

// The samples of an uncut scan, and what casts their rays. Shared by all segmentations of the scan.
struct SampledScan {
    std::vector<std::shared_ptr<const TriangleMesh>> solid;
    SurfaceSamples samples;        // SurfaceSample::mesh is an index of `solid`
    std::vector<Vec3> directions;  // unit vectors (tool_directions.h)
    PreciseRays rays;              // of the solids, in their order
    double diagonal_mm = 0;        // of the box of all solids
};

struct SampledScanOptions {
    std::size_t samples = default_surface_samples;
    std::vector<std::vector<bool>> is_left_out;  // per piece and triangle: carries no sample; or empty
    PreciseRays::Instructions instructions = PreciseRays::Instructions::widest;
};

// `uncut` are the pieces of the uncut scan, without its fragments: each is one solid. Preconditions: they have meshes
// and no half-spaces, and the directions are unit vectors.
SampledScan sampled_scan(std::span<const Piece> uncut, std::vector<Vec3> directions,
                         const SampledScanOptions& options = {});

// The accessibility of one piece.
struct PieceAccessibility {
    std::uint32_t solid = 0;             // of the uncut scan: index of SampledScan::solid
    std::vector<HalfSpace> half_spaces;  // of the piece
    // One per triangle of the piece's mesh: the triangle of the uncut solid of which it is a part; caps: no_parent.
    std::vector<std::uint32_t> scan_triangle;
    std::vector<std::uint32_t> sample;  // on the piece: indices of SampledScan::samples, ascending
    // Per sample of the piece, then per direction: mm from the sample to the first hit with the piece along the
    // direction, infinite without one; 0 if the sample does not face the direction (min_facing), or if the ray begins
    // inside the material.
    std::vector<float> distance;

    std::size_t directions() const { return sample.empty() ? 0 : distance.size() / sample.size(); }
    // `row` is an index of `sample`.
    std::span<const float> distances(std::size_t row) const {
        return {distance.data() + row * directions(), directions()};
    }
    bool is_open(std::size_t row, std::size_t direction) const { return std::isinf(distances(row)[direction]); }
};

// Per solid of the scan, uncut, without distances.
std::vector<PieceAccessibility> unasked_accessibility(const SampledScan& scan);

// Per solid of the scan, uncut. O(samples x directions) rays, in parallel.
std::vector<PieceAccessibility> uncut_accessibility(const SampledScan& scan);

// Of the pieces that a cut made of `piece`, in their order; a fragment's is for the caller to drop. `made` is the
// result of cut_piece() for the piece. Rays that met the surface beyond the plane are open now. The other blocked ones
// are cast again on a side of the plane where there are several solids; elsewhere only those whose hit lies within 4e-6
// of the scan's diagonal of the plane. O(samples x directions + triangles of the solid).
std::vector<PieceAccessibility> cut_accessibility(const SampledScan& scan, const PieceAccessibility& piece,
                                                  const CutPieces& made);

// Casts single rays on one piece, for directions that are not among those of the scan. Both must outlive this. distance
// may be called from many threads at once. 4 bytes per triangle of the uncut solid.
class PieceRays {
 public:
    PieceRays(const SampledScan& scan, const PieceAccessibility& piece);
    // As PieceAccessibility::distance, for any unit vector.
    float distance(std::size_t row, Vec3 direction) const;
    // Per sample of the piece, in parallel.
    std::vector<float> distances(Vec3 direction) const;

 private:
    const SampledScan& scan_;
    const PieceAccessibility& piece_;
    std::vector<std::uint32_t> label_;  // per triangle of the uncut solid: 0 for those of the piece; or empty: all
};

}  // namespace qchopper
