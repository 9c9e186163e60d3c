// How far sections are from symmetric about a plane (Luo et al. 2012, section 3.6).
//
// mm. The root of the mean, over points p of the section, of the squared distance from p to the nearest of the
// reflected points: 0 for the plane itself, and for every section that meets it at right angles and is symmetric. The
// points stand on a square grid of about 256 in the section (tests/segment/objectives/sweep/symmetry_test.cpp).

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "segment/cut/cut_evaluation.h"
#include "segment/objectives/sweep/section.h"

namespace qchopper {

constexpr double section_points = 256;

// The points of one plane. O(points of its loops).
std::vector<Vec3> points_in_section(const PreparedPiece& prepared, const Plane& plane, const SweptSections& sections,
                                    std::size_t index, double area_mm2);

// Fills in symmetry_mm of the evaluations, one per offset. O(offsets * points of a section squared).
void add_symmetry(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                  const SweptSections& sections, const Plane& symmetry,
                  std::span<std::optional<CutEvaluation>> evaluations);

}  // namespace qchopper
