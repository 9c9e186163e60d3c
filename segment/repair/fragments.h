// Counts or drops the solids of a scan that are too small to become pieces, such as scanned dust.
//
// A fragment is dropped with the cavities in it (tests/segment/repair/fragments_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

constexpr double fragment_share = 1e-5;  // of the volume of the mesh: a solid with less is a fragment

struct FragmentCounts {
    std::size_t fragments = 0;
    std::size_t faces = 0;
    double area_share = 0;  // of the surface of the mesh
};

// Counts solids with less volume than this share of the whole. Precondition: the mesh is closed and faces outwards.
FragmentCounts count_fragments(const TriangleMesh& mesh, double volume_share);

// Drops them, and returns the same counts. Points stay.
FragmentCounts drop_fragments(TriangleMesh& mesh, double volume_share, SourceFaces* sources = nullptr);

}  // namespace qchopper
