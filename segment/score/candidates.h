// The planes that are considered for the next cut of a piece (Nicholson 2016, section 4.1).

#pragma once

#include <vector>

#include "segment/cut/piece.h"

namespace qchopper {

struct CandidateOptions {
    int offsets_per_normal = 40;  // evenly spaced strictly inside the piece's extent
    bool operator==(const CandidateOptions&) const = default;
};

struct Candidate {
    Plane plane;               // nudged: the plane that is evaluated, cut and stored
    double wanted_offset = 0;  // before the nudge
    int normal = 0;            // which normal, which offset: ties go to the lower
    int offset = 0;
};

// The axes of the piece's oriented box times the offsets; those that miss are left out. Ordered by normal, offset.
std::vector<Candidate> candidate_planes(const Piece& piece, const CandidateOptions& options);

// The offsets lo + (hi - lo) k / (count + 1), k = 1..count, that hit, of one normal.
std::vector<Candidate> candidates_along(const Piece& piece, Vec3 normal, int normal_number, int count);

}  // namespace qchopper
