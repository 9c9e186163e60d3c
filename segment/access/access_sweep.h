// The unreachable area on both sides of all planes of one normal, without cutting and without casting a ray.
//
// mm2, for a tool of radius zero, on the samples of a piece. A cut removes what lies beyond its plane, so that a ray
// that meets the plane before the surface leaves the piece there: for every base each sample has one offset from which
// on it is unreachable, and a histogram over the offsets, summed up once, gives all of them. Equal, sample for sample,
// to rays cast on the really cut piece where each side is one solid, but for rays that pass the plane within the flush
// tolerance of accessibility.h (tests/segment/access/access_sweep_test.cpp). Where a side is several solids its area is
// neither a bound above nor below. Areas of old caps are exact; that of the new cap follows from the samples, because
// the area vectors of a closed surface add up to zero: with 20,000 of them it errs by up to 0.2 % of the piece's area
// (bench/carve.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "segment/access/unreachable.h"
#include "segment/cut/cut_evaluation.h"
#include "segment/cut/piece.h"

namespace qchopper {

// One side of a plane on one base.
struct SideOnBase {
    std::int32_t cut = 0;        // whose cap is the base; new_cut: that of the plane
    double unreachable_mm2 = 0;  // samples, steep ones as the tilt wants, and caps
    double caps_mm2 = 0;         // of it caps that face away from all allowed directions
    double base_mm2 = 0;         // area of that cap on this side; of the new cap measured on the samples
    double projected_mm2 = 0;    // of the side along the base's up, measured on the samples
    bool is_stable() const { return carries(base_mm2, projected_mm2); }
};

// The base with the least area of those that carry the side, of all if none carries it; the first of several.
// Precondition: there is one.
const SideOnBase& best_base(std::span<const SideOnBase> bases);

// The ingredients of one plane: other weights need no new sweep.
struct PlaneAccess {
    std::vector<SideOnBase> above;  // the new base first, then the old ones that have a part of their cap on this side
    std::vector<SideOnBase> below;
    // Of both sides, each on its best base.
    double unreachable_mm2() const { return best_base(above).unreachable_mm2 + best_base(below).unreachable_mm2; }
};

// What all normals share: the directions that are open at each sample, the allowed ones of every base.
class AccessSweep {
 public:
    // On the samples of the piece, which must outlive this. Precondition: it has some. Old bases are all its caps: one
    // too small for the piece may carry a side. O(triangles + samples x directions), and a ray per sample for a base
    // whose up is not a direction of the scan.
    AccessSweep(const Piece& piece, double tilt_deg);
    // `judged` is that of `piece`, with all its caps; what it refers to must outlive this.
    AccessSweep(const Piece& piece, const JudgedPiece& judged, double tilt_deg);
    ~AccessSweep();
    AccessSweep(const AccessSweep&) = delete;
    AccessSweep& operator=(const AccessSweep&) = delete;

    // One per offset; a side without samples has no unreachable area. On one thread; may be called from many at once.
    // A normal whose two signs are not directions of the scan casts up to one ray per sample. Preconditions: the normal
    // is a unit vector, the offsets ascend.
    std::vector<PlaneAccess> sweep(Vec3 normal, std::span<const double> offsets) const;

 private:
    struct Prepared;
    class PlaneSweep;
    std::unique_ptr<const Prepared> prepared_;
};

// Of planes with one normal, by a sweep of their own: the piece has samples. Otherwise as AccessSweep::sweep.
std::vector<CutAccess> cut_access(const Piece& piece, Vec3 normal, std::span<const double> offsets, double tilt_deg);
CutAccess cut_access(const Piece& piece, const Plane& plane, double tilt_deg);

}  // namespace qchopper
