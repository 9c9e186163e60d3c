// What the objective connector knows of a joint, and its value.
//
// mm. Tests: tests/segment/objectives/sweep/connector_test.cpp. Formula: connector_sweep.h.

#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "segment/mesh/polygon.h"
#include "segment/objectives/objectives.h"

namespace qchopper {

// The largest extent of points along 16 directions, at most 0.5 % below their diameter. 0 without points.
class Extent16 {
 public:
    void include(Point2 p);
    void include(const Extent16& other);
    double largest() const;

 private:
    static constexpr std::size_t count = 16;
    static constexpr double none = std::numeric_limits<double>::infinity();
    static constexpr std::array<double, count> filled(double value) {
        std::array<double, count> all{};
        for (double& x : all) x = value;
        return all;
    }
    std::array<double, count> low_ = filled(none);
    std::array<double, count> high_ = filled(-none);
};

// A joint, or in the form `ratio` a region.
struct JointMeasure {
    double area_mm2 = 0;
    double diameter = 0;         // of the contact: Extent16
    std::vector<Point2> places;  // ascending in y, those of equal y in x; the extreme ones of each row suffice
};

// The objective from its joints or regions.
double connector_of(std::span<const JointMeasure> joints, const ConnectorOptions& options);

}  // namespace qchopper
