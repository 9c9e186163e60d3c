// Tries all rotations of a pattern of dowels, for the tests: slow, and apart from how the project decides.

#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "segment/joint/dowel_pattern.h"

namespace qchopper {

struct TurnOptions {
    bool is_mirrored = false;
    double from_deg = 0;  // rotations from here to the full turn less as much
};

// The least over rotations of half degrees and all pairings of dowels of equal size, of the largest distance between
// paired dowels after the shift that brings their middles together; infinite where the sizes differ.
inline double min_error(const DowelPattern& a, const DowelPattern& b, const TurnOptions& options) {
    double best = INFINITY;
    if (a.size() != b.size()) return best;
    const auto middle = [](const DowelPattern& pattern) {
        Point2 sum;
        for (const PatternDowel& d : pattern) sum = {sum.x + d.at.x, sum.y + d.at.y};
        const double n = static_cast<double>(pattern.size());
        return Point2{sum.x / n, sum.y / n};
    };
    const Point2 from = middle(a);
    const Point2 to = middle(b);
    for (double turn = options.from_deg; turn <= 360 - options.from_deg; turn += 0.5) {
        const double c = std::cos(turn * std::numbers::pi / 180);
        const double s = std::sin(turn * std::numbers::pi / 180);
        std::vector<std::size_t> order(a.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        do {
            double error = 0;
            for (std::size_t i = 0; i < a.size(); ++i) {
                if (a[i].size != b[order[i]].size) error = INFINITY;
                const double x = a[i].at.x - from.x;
                const double y = (options.is_mirrored ? -1 : 1) * (a[i].at.y - from.y);
                const Point2 other = b[order[i]].at;
                error = std::max(error, std::hypot(c * x - s * y + to.x - other.x, s * x + c * y + to.y - other.y));
            }
            best = std::min(best, error);
        } while (std::next_permutation(order.begin(), order.end()));
    }
    return best;
}

inline double min_error_of_rotations(const DowelPattern& a, const DowelPattern& b) {
    return std::min(min_error(a, b, {}), min_error(a, b, {.is_mirrored = true}));
}

}  // namespace qchopper
