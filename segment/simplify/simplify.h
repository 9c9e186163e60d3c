// Makes a piece of fewer faces, and says how far the result is from it.
//
// Lengths are mm. Points that stay do not move. Caps keep every triangle and point, so that two pieces that meet at a
// cut go on matching to the last bit, whatever is asked of either. The result is closed, lies on the same sides of the
// piece's cuts, and no face is turned over; with a tolerance no sample of either surface, insides of faces
// included, is farther than that from the other (tests/segment/simplify/simplify_test.cpp). Same input, same bytes.

#pragma once

#include <cstddef>
#include <optional>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct SimplifyOptions {
    std::optional<double> tolerance;        // mm: as few faces as this deviation allows
    std::optional<std::size_t> most_faces;  // stop at so many; with a tolerance, whichever comes first
};

struct SimplifyReport {
    std::size_t faces_before = 0;
    std::size_t faces_after = 0;
    std::size_t cap_faces = 0;        // that had to stay
    double from_piece = 0;            // mm: largest distance of the samples of the piece to the result
    double from_result = 0;           // mm: of the samples of the result to the piece (distance.h)
    bool has_too_many_faces = false;  // more faces than most_faces are left: no more could be taken out soundly
    double deviation() const { return from_piece > from_result ? from_piece : from_result; }
};

// Throws InputError: (use) options that make no sense, (mesh) a mesh that is not closed.
SimplifyReport simplify(TriangleMesh& mesh, const SimplifyOptions& options, const Context& context = {});

}  // namespace qchopper
