// What no tool reaches of the two sides of a plane, where samples that no direction of the scan reaches are asked along
// 2,000 directions too.
//
// mm2, for a tool of radius zero. The 264 directions of the scan understate the tilt: a plane that is turned by three
// degrees can come out worse by them alone. As the sweep (access_sweep.h), with each side on the base that it finds
// best, less the samples that one of the dense directions opens; of those every n-th is asked, so that at most 4,000
// are. Exact where the sweep is, and where every sample is asked (tests/segment/search/refined_plane_test.cpp).

#pragma once

#include <memory>

#include "segment/cut/piece.h"

namespace qchopper {

// Keeps the distances that it asked for: planes near each other ask for most of them again. Not for several threads at
// once.
class DenseAccess {
 public:
    // The piece must outlive this. Precondition: it has samples.
    DenseAccess(const Piece& piece, double tilt_deg);
    ~DenseAccess();
    DenseAccess(const DenseAccess&) = delete;
    DenseAccess& operator=(const DenseAccess&) = delete;

    // Of both sides. Precondition: the normal is a unit vector. O(samples x directions), and up to 2,000 rays for each
    // sample that is asked, once.
    double unreachable_mm2(const Plane& plane);

 private:
    struct Asked;
    std::unique_ptr<Asked> asked_;
};

}  // namespace qchopper
