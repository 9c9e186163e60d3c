// The objective connector: how well the parts that a plane makes can be held together by dowels (Luo et al. 2012,
// section 3.3, made precise in docs/chopper.md).
//
// A joint is a part above and a part below and all regions of the section in which they touch, each at least 4 cm2.
// Form `spread`: the mean over the joints, by area, of 1 if the farthest two dowels that fit are less than three
// diameters apart, else of max(0, 1 - 2 s/D); s their distance, D the largest extent of the joint along 16 directions,
// at most 0.5 % below its diameter. Form `ratio`: of the region with the largest value, its area / the area of the hull
// of the dowels that fit in it, less 10, in [0, 100]. 0 for a section without a region that counts. Equal to cutting,
// from the same places (tests/segment/score/connector_test.cpp).

#pragma once

#include <array>
#include <optional>
#include <span>

#include "segment/score/cut_evaluation.h"
#include "segment/score/dowel_columns.h"
#include "segment/score/section.h"

namespace qchopper {

constexpr double least_joint_mm2 = 400;

// The largest extent of points along 16 directions.
class Extent16 {
 public:
    void include(Point2 p);
    double largest() const;

 private:
    static constexpr std::size_t count = 16;
    static constexpr double none = std::numeric_limits<double>::infinity();
    std::array<double, count> low_ = filled(none);
    std::array<double, count> high_ = filled(-none);
    static constexpr std::array<double, count> filled(double value) {
        std::array<double, count> all{};
        for (double& x : all) x = value;
        return all;
    }
};

// A joint, or in the form `ratio` a region: what of it enters the objective.
struct JointMeasure {
    double area_mm2 = 0;
    double diameter = 0;         // D
    std::vector<Point2> places;  // the extreme ones of each row of the grid suffice; ascending in y
};

// The objective from its joints or regions.
double connector_of(std::span<const JointMeasure> joints, const ConnectorOptions& options);

// Fills in `connector` of the evaluations, one per offset. O(points + triangles), and the places that are asked.
void add_connector(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                   const SweptSections& sections, const ConnectorOptions& options,
                   std::span<std::optional<CutEvaluation>> evaluations);

}  // namespace qchopper
