// Patterns of the dowels of one joint: which of them can be turned, and which two can be mistaken for each other.
//
// mm. Two patterns are *alike* if their dowels can be paired, sizes equal, so that no distance between two dowels of
// one differs by more than 2 * tolerance from that of the other. Patterns that some rotation, mirrored or not, maps
// onto each other within the tolerance are alike, because a distance changes by at most twice what its ends move. So
// what is not alike does not fit (tests/segment/joint/dowel_pattern_test.cpp).

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "segment/joint/dowel.h"
#include "segment/mesh/polygon.h"

namespace qchopper {

struct PatternDowel {
    std::size_t size = 0;  // index in the list of sizes
    Point2 at;             // plane coordinates
};
using DowelPattern = std::vector<PatternDowel>;

// How far a dowel may be from where it belongs and still be pressed in.
inline double pattern_tolerance(double play) {
    return 2 * play + 1;
}

// Whether two patterns of the same number of dowels, each at most four, are alike. O(permutations).
bool are_alike(const DowelPattern& a, const DowelPattern& b, double tolerance);

// Whether a pattern is alike itself with its dowels paired in another way. A single dowel always turns.
bool can_be_turned(const DowelPattern& pattern, double tolerance);

// For each size the sites where it is clear in both pieces, in a fixed order.
using SitesOfSizes = std::vector<std::vector<Point2>>;

// Calls accept(pattern) for the patterns that hold a joint and cannot be turned, the wanted ones first, until it
// returns true; returns whether it did. Dowels are at least 3 diameters, and both radii and the wall, apart. Two dowels
// of two sizes come first, the largest sizes first and of one pair of sizes those farthest apart; then three dowels. Of
// each pair of sizes at most a few patterns of every distance are proposed: a fixed and bounded number. `sizes`
// descend. O(sites squared).
template <class Accept>
bool first_pattern(std::span<const DowelSize> sizes, const SitesOfSizes& sites, double tolerance, const Accept& accept);

// The proposals of first_pattern for two sizes, a != b; for a == b the pairs that a third dowel may complete.
std::vector<DowelPattern> pairs_of(std::span<const DowelSize> sizes, const SitesOfSizes& sites, std::size_t a,
                                   std::size_t b, double tolerance);
// Proposals of three dowels: pairs of size a and a third of size c.
std::vector<DowelPattern> triples_of(std::span<const DowelSize> sizes, const SitesOfSizes& sites, std::size_t a,
                                     std::size_t c, double tolerance);

template <class Accept>
bool first_pattern(std::span<const DowelSize> sizes, const SitesOfSizes& sites, double tolerance,
                   const Accept& accept) {
    const auto is_any_accepted = [&](const std::vector<DowelPattern>& patterns) {
        for (const DowelPattern& pattern : patterns) {
            if (accept(pattern)) return true;
        }
        return false;
    };
    for (std::size_t sum = 1; sum + 2 < 2 * sizes.size() + 1; ++sum) {
        for (std::size_t a = 0; 2 * a < sum; ++a) {
            const std::size_t b = sum - a;
            if (b < sizes.size() && is_any_accepted(pairs_of(sizes, sites, a, b, tolerance))) return true;
        }
    }
    for (std::size_t a = 0; a < sizes.size(); ++a) {
        for (std::size_t c = 0; c < sizes.size(); ++c) {
            if (is_any_accepted(triples_of(sizes, sites, a, c, tolerance))) return true;
        }
    }
    return false;
}

}  // namespace qchopper
