// Reduces the faces of a piece, and measures how far the result is from it.
//
// Lengths are mm. Points that stay do not move. Caps keep every triangle and point, so that two pieces that meet at a
// cut match to the last bit, whatever the options for either. The result is closed, lies on the same sides of the
// piece's cuts, and no face is inverted; with a tolerance no sample of either surface, interiors of faces included, is
// farther than that from the other, and no more faces run through each other than before
// (tests/segment/simplify/simplify_test.cpp). Same input, same bytes, whatever the
// number of threads.

#pragma once

#include <cstddef>
#include <optional>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct SimplifyOptions {
    std::optional<double> tolerance;       // mm: as few faces as this deviation allows
    std::optional<std::size_t> max_faces;  // stop at this number; with a tolerance, at whichever comes first
    // Without a tolerance, for display: by passes alone, where more faces may be left, and crossings are not counted.
    bool is_quick = false;
};

struct SimplifyReport {
    std::size_t faces_before = 0;
    std::size_t faces_after = 0;
    std::size_t cap_faces = 0;        // that had to stay
    double from_piece = 0;            // mm: largest distance of the samples of the piece to the result
    double from_result = 0;           // mm: of the samples of the result to the piece (sampled_deviation.h)
    std::size_t crossings = 0;        // pairs of faces that run through each other (self_intersections.h), new ones
    bool has_too_many_faces = false;  // more faces than max_faces are left: no other edge could collapse
    bool is_by_queue = false;         // the passes did not reach max_faces, so the slower way was taken (collapse.h)
    double deviation() const { return from_piece > from_result ? from_piece : from_result; }
};

// The mesh is unchanged if it has few enough faces already, or if no result keeps the tolerance. Throws InputError:
// (use) without tolerance and max_faces, or with a tolerance that is not above 0 or fewer than 4 faces; (mesh) if the
// mesh is not closed. Throws Cancelled (base/context.h); the mesh is unchanged then. O(n) for n faces; with a tolerance
// O(n log n), up to 8 times.
SimplifyReport simplify(TriangleMesh& mesh, const SimplifyOptions& options, const Context& context = {});

}  // namespace qchopper
