// Proposes the planes that are considered for the next cut of a piece (Nicholson 2016, section 4.1; Luo et al.,
// "Chopper: partitioning models into 3D-printable parts", 2012).
//
// mm. All planes are canonical (plane.h), nudged off the vertices (nudge.h), and none crosses surface that must not be
// cut (no_cut.h): tests/segment/search/candidates/candidates_test.cpp.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "segment/cut/piece.h"
#include "segment/mesh/oriented_box.h"
#include "segment/objectives/symmetry_plane.h"
#include "segment/search/candidates/no_cut.h"

namespace qchopper {

enum class CandidateNormals {
    box,    // the axes of the piece's oriented box
    sphere  // those, and the 129 normals of the subdivided octahedron (tool_directions.h)
};

// A plane that is a candidate of every piece that it parts.
struct GivenPlane {
    Plane plane;          // canonical
    std::string by = {};  // the method of segment/regions/methods.h that proposed it; empty: the operator
    bool operator==(const GivenPlane&) const = default;
};

struct CandidateOptions {
    std::optional<CandidateNormals> normals;  // nothing: box, or where surface out of reach has a weight sphere
    int offsets_per_normal = 40;              // evenly spaced strictly inside the piece's extent
    // In their place offsets at steps of so many mm, or of a two-hundredth of the extent where that is more.
    std::optional<double> offset_step_mm;
    bool takes_symmetry = false;            // whether the symmetry plane is looked for
    std::optional<SymmetryPlane> symmetry;  // that of the uncut scan: a candidate, and so are the mirror images of cuts
    std::vector<GivenPlane> given;          // those of the operator first
    NoCut no_cut;                           // no candidate goes through this surface
    // Whether planes along the caps of a piece are candidates of it (cap_frame.h), because blocks end in caps.
    bool along_caps = false;
    bool operator==(const CandidateOptions&) const = default;
};

// Candidate::normal_index and offset_index of planes that are along none of the normals: the operator's choice for one
// piece; the best of a ranking moved and turned a little (segment/search/refined_plane.h); the symmetry plane; one that
// is given for all pieces, offset_index being its place; the mirror image of a cut, offset_index being its number; a
// given plane moved and turned a little, offset_index being its place too.
constexpr int own_index = -1;
constexpr int refined_index = -2;
constexpr int symmetry_index = -3;
constexpr int given_index = -4;
constexpr int mirror_index = -5;
constexpr int refined_given_index = -6;

struct Candidate {
    Plane plane;               // nudged: the plane that is evaluated, cut and stored
    double wanted_offset = 0;  // before the nudge
    int normal_index = 0;      // ties go to the lower normal_index, then offset_index
    int offset_index = 0;
};

constexpr int max_steps = 200;  // of an extent

// Directions nearer than this to an earlier one, up to sign, are left out.
constexpr double min_turn_deg = 0.5;

// The axes of the box, then the octahedron's normals, all canonical: what Candidate::normal_index counts.
std::vector<Vec3> candidate_normals(const OrientedBox& box, CandidateNormals normals);

// Offsets before their nudge, ascending: lo + (hi - lo) k / (count + 1), k = 1..count; or lo + k s, k = 1, 2, ...,
// below hi, with s = offset_step().
std::vector<double> candidate_offsets(const Extent& range, const CandidateOptions& options);

// The same as shares of an extent of this size, 0 to 1.
std::vector<double> offset_shares(double size, const CandidateOptions& options);

// The distance of two neighbouring offsets.
double offset_step(const Extent& range, const CandidateOptions& options);

// Of one normal at most so many offsets.
inline int max_offsets(const CandidateOptions& options) {
    return options.offset_step_mm ? max_steps - 1 : options.offsets_per_normal;
}

// All offsets of all normals, ordered by normal_index, then offset_index. Planes that miss the piece are left out.
std::vector<Candidate> candidate_planes(const Piece& piece, const CandidateOptions& options);

// The same with the oriented box given.
std::vector<Candidate> candidate_planes(const Piece& piece, const OrientedBox& box, const CandidateOptions& options);

// Of one normal, a unit vector.
std::vector<Candidate> candidates_along(const Piece& piece, Vec3 normal, int normal_index,
                                        const CandidateOptions& options);
std::vector<Candidate> candidates_along(const Piece& piece, Vec3 normal, int normal_index, int count);

// Of one normal with these offsets, the place of each being its offset_index. `no_cut`: the triangles of the piece
// through which no plane may go.
std::vector<Candidate> candidates_at(const Piece& piece, Vec3 normal, int normal_index,
                                     const std::vector<double>& wanted, std::span<const NoCutTriangle> no_cut);

}  // namespace qchopper
