// k representatives of the elements of a graph, and how many there should be.
//
// The engine of the iterative methods. Tests: tests/segment/regions/representatives_test.cpp.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "segment/regions/engines/shortest_paths.h"

namespace qchopper {

struct Representatives {
    std::vector<std::uint32_t> element;
    std::vector<double> gap;  // of each from the nearest of those before it; of the first: infinite
};

// Begins with `first`; each further one is the element farthest from those before, the first of equal ones. How far an
// element is, is the least cost within 3 + sqrt(elements) / 30 steps of it, so that none is chosen in a small spike.
// Elements that no path reaches come first of all. At most `most`, fewer if all elements are taken. One search per
// representative: O(most * arcs log elements).
Representatives farthest_first(const WeightedGraph& graph, std::uint32_t first, std::size_t most);

// The number of representatives, from 2, after which their gap falls most: k where G(k) -
// G(k + 1) is largest among the gaps, of S. Katz and A. Tal (2003). 1 if there are fewer than 3.
std::size_t count_at_largest_fall(const std::vector<double>& gaps);

struct Grouping {
    std::vector<std::uint32_t> of;  // one per element: the place of its representative, or no_source
    std::vector<std::uint32_t> representative;
};

// Assigns elements to the nearest representative, moves each to a more central element of its group, and so on until no
// group changes, at most `rounds` times. More central: with a smaller mean cost to the members, weighted; asked are the
// element itself, that in the middle between two far ends of the group, and that nearest in space to the mean `place`
// of the group.
Grouping grouped(const WeightedGraph& graph, const std::vector<double>& weight, const std::vector<Vec3>& place,
                 std::vector<std::uint32_t> representatives, int rounds);

}  // namespace qchopper
