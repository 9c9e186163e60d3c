// A piece: one connected closed solid of the segmentation, and the cuts that bound it.

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "segment/mesh/plane.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A cut that bounds a piece. The piece lies wholly on one side of it.
struct Bound {
    std::int32_t cut = 0;  // number of the cut, as in TriangleMesh::cap_of
    Plane plane;
    bool above = true;  // the piece lies on the side that plane.normal points to
    bool operator==(const Bound&) const = default;
    // The inward normal: "up" when this cap lies on the table.
    Vec3 up() const { return above ? plane.normal : -plane.normal; }
};

struct Piece {
    std::string name;  // A, B, ... Z, AA, ...: in the order in which pieces came to be
    std::shared_ptr<const TriangleMesh> mesh;
    std::vector<Bound> bounds;  // in the order of the cuts; a piece may own no cap of a bound any more
};

}  // namespace qchopper
