// The unreachable area on both sides of all planes of one normal, without cutting and without casting a ray.
//
// mm2, for a tool of radius zero, on the samples of a piece. A cut removes what lies beyond its plane, so that a ray
// that meets the plane before the surface leaves the piece there: for every base each sample has one offset from which
// on it is unreachable, and a histogram over the offsets, summed up once, gives all of them. Equal, sample for sample,
// to rays cast on the really cut piece where each side is one solid (tests/segment/score/reach_sweep_test.cpp). Where a
// side is several solids its area is neither a bound above nor below.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "segment/score/cut_evaluation.h"
#include "segment/score/unreachable.h"

namespace qchopper {

// One side of a plane on one base.
struct SideOnBase {
    std::int32_t cut = 0;        // whose cap is the base; new_cut: that of the plane
    double unreachable_mm2 = 0;  // caps that face away from all allowed directions included; steep surface as the tilt
                                 // wants
    double base_mm2 = 0;         // area of that cap on this side, measured on the samples
    double projected_mm2 = 0;    // of the side along the base's up, measured on the samples
    bool carries() const { return base_mm2 >= least_base_share * projected_mm2; }
};

// The ingredients of one plane: other weights need no new sweep.
struct PlaneReach {
    std::vector<SideOnBase> above;  // the new base first, then the old ones that have a part of their cap on this side
    std::vector<SideOnBase> below;
};

// The least over the bases that carry the side; over all if none carries it. Precondition: there is one.
double least_unreachable_mm2(std::span<const SideOnBase> bases);

// What all normals share: the directions that are open at each sample, the allowed ones of every base. Both `piece` and
// what it refers to must outlive it. sweep() may be called from many threads at once.
class ReachSweep {
 public:
    // `bases` are those that the piece has already (bases_of).
    ReachSweep(const JudgedPiece& piece, std::span<const TiltBase> bases, double tilt_deg);
    ~ReachSweep();
    ReachSweep(const ReachSweep&) = delete;
    ReachSweep& operator=(const ReachSweep&) = delete;

    // One per offset. Preconditions: the normal is a unit vector, the offsets ascend.
    std::vector<PlaneReach> sweep(Vec3 normal, std::span<const double> offsets) const;

 private:
    struct Prepared;
    std::unique_ptr<const Prepared> prepared_;
};

}  // namespace qchopper
