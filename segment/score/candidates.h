// Proposes the planes that are considered for the next cut of a piece (Nicholson 2016, section 4.1).
//
// mm. All planes are canonical (plane.h) and nudged off the vertices (nudge.h):
// tests/segment/score/candidates_test.cpp.

#pragma once

#include <vector>

#include "segment/cut/piece.h"
#include "segment/mesh/oriented_box.h"

namespace qchopper {

struct CandidateOptions {
    int offsets_per_normal = 40;  // evenly spaced strictly inside the piece's extent
    bool operator==(const CandidateOptions&) const = default;
};

// Candidate::normal_index and offset_index of planes that are not proposed: the operator's own, and the best of a
// ranking moved and turned a little (segment/search/refined_plane.h).
constexpr int own_index = -1;
constexpr int refined_index = -2;

struct Candidate {
    Plane plane;               // nudged: the plane that is evaluated, cut and stored
    double wanted_offset = 0;  // before the nudge
    int normal_index = 0;      // ties go to the lower normal_index, then offset_index
    int offset_index = 0;
};

// The axes of the piece's oriented box times the offsets, ordered by normal_index, then offset_index. Planes that miss
// the piece are left out.
std::vector<Candidate> candidate_planes(const Piece& piece, const CandidateOptions& options);

// The same with the oriented box given.
std::vector<Candidate> candidate_planes(const Piece& piece, const OrientedBox& box, const CandidateOptions& options);

// Of one normal, a unit vector: the offsets lo + (hi - lo) k / (count + 1), k = 1..count, that do not miss.
std::vector<Candidate> candidates_along(const Piece& piece, Vec3 normal, int normal_index, int count);

}  // namespace qchopper
