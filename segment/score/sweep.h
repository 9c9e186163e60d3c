// Evaluations all planes of one normal at once, without cutting: linear in the mesh, whatever the number of offsets.
//
// Equal to evaluate_by_cutting (reference.h) on every closed mesh: pieces, face counts and bases exactly, sums to 1e-9
// (tests/segment/score/sweep_test.cpp, touching_test.cpp). How: the offsets divide the mesh into slabs; what hangs
// together in a slab is a node; parts above and below a plane are merges of nodes, joined across it by the cap regions
// of its loops. A planar cut makes no new cavity, so surfaces of one solid are joined by a cap region or by the link
// of an uncut cavity.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/context.h"
#include "segment/score/cut_evaluation.h"
#include "segment/score/prepared.h"

namespace qchopper {

// One evaluation per offset, nothing where the plane misses. `offsets` ascending, nudged: none at a vertex's height;
// the normal canonical. The piece must be closed (prepared.edges.faults).
std::vector<std::optional<CutEvaluation>> sweep(const PreparedPiece& prepared, Vec3 normal,
                                                std::span<const double> offsets, const Objectives& objectives);

// The same without fragility: what the sweep itself costs.
std::vector<std::optional<CutEvaluation>> sweep_solids(const PreparedPiece& prepared, Vec3 normal,
                                                       std::span<const double> offsets);

}  // namespace qchopper
