// Two circles of one radius meet square to the middle of the chord of their middles, sqrt(R^2 - chord^2 / 4) away.

#include "cam/toolpath/finishing/scallop.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace qchopper {

double scallop_height(double radius, double chord, double bulge) {
    assert(radius > 0);
    const double square = radius * radius - 0.25 * chord * chord;
    if (square <= 0) return std::numeric_limits<double>::infinity();
    return radius - std::sqrt(square) - bulge;
}

double chord_for_scallop(double radius, double h) {
    assert(h > 0 && h <= radius);
    return 2 * std::sqrt(2 * radius * h - h * h);
}

}  // namespace qchopper
