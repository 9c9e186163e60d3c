// Evaluates all planes of one normal at once, without cutting.
//
// Equal to evaluate_by_cutting (tests/reference) on every closed mesh: pieces, face counts and bases exactly, sums to
// 1e-9 (tests/segment/objectives/sweep/sweep_test.cpp, touching_test.cpp). mm. Linear in the mesh and in the crossings
// of triangles and planes, if the offsets are about evenly spaced; docs/decisions/0011.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "segment/cut/cut_evaluation.h"
#include "segment/objectives/sweep/prepared.h"

namespace qchopper {

// One evaluation per offset; nothing where the plane misses. Preconditions: `offsets` ascending and nudged (nudge.h),
// so that none is at the height of a vertex; the normal canonical (plane.h); the piece closed (prepared.edges.faults);
// `prepared` made with the same objectives.
std::vector<std::optional<CutEvaluation>> sweep(const PreparedPiece& prepared, Vec3 normal,
                                                std::span<const double> offsets, const Objectives& objectives);

// The solids and their sizes alone. Measured by itself in docs/measurements/performance.md. Faces, cap area and
// fragility of a plane are the same bits whatever other offsets are swept with it; volumes and base sums are not.
std::vector<std::optional<CutEvaluation>> sweep_solids(const PreparedPiece& prepared, Vec3 normal,
                                                       std::span<const double> offsets);

// The terms that may wait until a plane can still win. They are filled in for evaluations that sweep_solids returned
// for planes of the normal, all or some of them: the values of a plane are the same bits whatever others are asked
// with it (tests/segment/objectives/sweep/connector_test.cpp).
void add_fragility(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                   const Objectives& objectives, std::span<std::optional<CutEvaluation>> evaluations);
// Seam, structure, connector and symmetry where they have a weight.
void add_section_terms(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                       const Objectives& objectives, std::span<std::optional<CutEvaluation>> evaluations);

}  // namespace qchopper
