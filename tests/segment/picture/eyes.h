// How far apart two colours are for eyes with and without all cones.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "segment/picture/colour.h"

namespace qchopper::eyes {

using Matrix = std::array<std::array<double, 3>, 3>;
using Triple = std::array<double, 3>;

inline double linear(std::uint8_t value) {
    const double s = value / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

inline double root(double t) {
    return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116;
}

inline Triple times(const Matrix& m, Triple v) {
    Triple out{};
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) out[i] += m[i][k] * v[k];
    }
    return out;
}

// CIE L*a*b* of the colour as an eye sees it.
inline Triple perceived(Rgb colour, const Matrix& eye) {
    Triple light = times(eye, {linear(colour.r), linear(colour.g), linear(colour.b)});
    for (double& channel : light) channel = std::clamp(channel, 0.0, 1.0);
    const Triple xyz = times({{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}}, light);
    const double y = root(xyz[1]);
    return {116 * y - 16, 500 * (root(xyz[0] / 0.9505) - y), 200 * (y - root(xyz[2] / 1.089))};
}

// Eyes after Vienot, Brettel and Mollon (1999): all cones, without red ones, without green ones.
constexpr std::array<Matrix, 3> all{{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                     {{{0.11238, 0.88762, 0}, {0.11238, 0.88762, 0}, {0.00401, -0.00401, 1}}},
                                     {{{0.29275, 0.70725, 0}, {0.29275, 0.70725, 0}, {-0.02234, 0.02234, 1}}}}};

// The least distance of the two in CIE L*a*b*, of all these eyes; below 2 no eye tells them apart.
inline double distance(Rgb one, Rgb other) {
    double least = 1e300;
    for (const Matrix& eye : all) {
        const Triple a = perceived(one, eye);
        const Triple b = perceived(other, eye);
        least = std::min(least, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
    return least;
}

}  // namespace qchopper::eyes
