// Finds the solids of a scan that are too small to become pieces: dust that the scanner saw.
//
// A fragment goes whole, with the cavities in it (tests/segment/repair/fragments_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

constexpr double fragment_share = 1e-5;  // of the volume: a solid with less is too small to be a piece

struct FragmentCounts {
    std::size_t fragments = 0;
    std::size_t faces = 0;
    double area_share = 0;  // of the surface of the mesh
};

// Solids with less volume than this share of the whole. The mesh must be closed and face outwards.
FragmentCounts count_fragments(const TriangleMesh& mesh, double volume_share);

// The same counts, and the fragments are gone.
FragmentCounts drop_fragments(TriangleMesh& mesh, double volume_share, SourceFaces* sources = nullptr);

}  // namespace qchopper
