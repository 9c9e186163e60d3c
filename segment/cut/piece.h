// A piece: one connected closed solid of the segmentation, and the cuts that bound it.
//
// mm. The mesh is closed and shared: several segmentations may hold it (tests/segment/cut/cut_test.cpp).

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "segment/mesh/plane.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A cut that bounds a piece. The piece lies wholly on one side of it.
struct HalfSpace {
    std::int32_t cut = 0;  // number of the cut, as in TriangleMesh::cap_of
    Plane plane;
    bool above = true;  // the piece lies on the side that plane.normal points to
    bool operator==(const HalfSpace&) const = default;
    // The inward normal: the upward direction when this cap is the base.
    Vec3 up() const { return above ? plane.normal : -plane.normal; }
};

struct SampledPiece;   // segment/access/sampled_piece.h
struct StressedModel;  // segment/structure/stress.h

struct Piece {
    std::string name;  // A, B, ... Z, AA, ...: in the order in which pieces were made
    std::shared_ptr<const TriangleMesh> mesh;
    std::vector<HalfSpace> half_spaces;  // in the order of the cuts; of some of them the piece may have no cap left
    std::shared_ptr<const SampledPiece> samples =
        {};  // along which directions its surface is open; null: not asked yet
    // Per point what a mm of seam there costs, in [0, 1] (segment/objectives/seam_cost.h); null: 1 everywhere.
    std::shared_ptr<const std::vector<float>> seam_cost = {};
    std::shared_ptr<const StressedModel> stress = {};  // of the uncut scan under load; null: no load is given
};

}  // namespace qchopper
