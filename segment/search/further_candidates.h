// Planes beside those along the normals of a piece: the symmetry plane of the scan, planes that the operator gives,
// mirror images of the cuts made so far, offsets between those that were evaluated. And which of many planes are near
// to others.
//
// mm. Nudged and clear of surface that must not be cut, as all candidates (candidates.h). They follow from the
// segmentation, the piece and the options alone (tests/segment/search/further_candidates_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "segment/search/rank.h"

namespace qchopper {

// The symmetry plane, the given planes, then the mirror image in the symmetry plane of each cut of the segmentation;
// those that miss the piece are left out. `piece` is an index in Segmentation::pieces.
std::vector<Candidate> further_candidates(const Segmentation& segmentation, std::size_t piece,
                                          const CandidateOptions& options);

// Offsets around that of a plane, a fifth of the step between offsets apart, as far as its neighbours.
std::vector<Candidate> offsets_around(const Piece& piece, const Ranked& plane, const CandidateOptions& options);

// Drops from a ranking every plane that is near to a better one: their normals are within 18 degrees, up to sign, and
// their distance over the piece's centroid is less than 5 % of the diagonal of its box. Returns the indices of the
// others, best first. O(planes x planes that are kept + triangles).
std::vector<std::size_t> without_near_planes(const std::vector<Ranked>& ranked, const Piece& piece,
                                             const OrientedBox& box);

}  // namespace qchopper
