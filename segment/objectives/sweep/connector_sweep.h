// The objective connector: how well the parts that a plane makes can be held together by dowels (Luo et al. 2012,
// section 3.3, made precise in docs/developer/objectives.md).
//
// A joint is a part above and a part below and all regions of the section in which they touch, each at least 4 cm2.
// Form `spread`: the mean over the joints, by area, of 1 if the farthest two dowels that fit are less than three
// diameters apart, else of max(0, 1 - 2 s/D); s their distance, D the largest extent of the joint along 16 directions,
// at most 0.5 % below its diameter. Form `ratio`: of the region with the largest value, its area / the area of the hull
// of the dowels that fit in it, less 10, in [0, 100]. The joints of older cuts of the piece count too, in the form
// `spread` (old_joints.h). 0 without a joint. Equal to cutting, from the same places
// (tests/segment/objectives/sweep/connector_test.cpp).

#pragma once

#include <optional>
#include <span>

#include "segment/cut/cut_evaluation.h"
#include "segment/objectives/joint_measure.h"
#include "segment/objectives/sweep/section.h"

namespace qchopper {

constexpr double min_joint_mm2 = 400;

// Fills in `connector` of the evaluations, one per offset. O(points + triangles), and the places that are asked.
void add_connector(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                   const SweptSections& sections, const ConnectorOptions& options,
                   std::span<std::optional<CutEvaluation>> evaluations);

}  // namespace qchopper
