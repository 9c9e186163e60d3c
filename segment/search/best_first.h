// Finds the planes of a piece that cost least without evaluating all terms of all planes: best-first search under lower
// bounds (Land and Doig, "An automatic method of solving discrete programming problems", 1960).
//
// No term is negative, so the terms that are evaluated so far are a bound on the cost. Normals are taken in the order
// of the least bound of their planes, because planes of one normal are evaluated together; it ends when no plane that
// is not evaluated can cost less than the best that are. Same planes and evaluations for any number of threads
// (tests/segment/search/best_first_test.cpp).

#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "segment/search/candidates/evaluated_plane.h"
#include "segment/search/rank.h"

namespace qchopper {

constexpr double never = std::numeric_limits<double>::infinity();  // what a plane costs that is not to be chosen

// Per normal, then per plane: what it costs at least.
using Bounds = std::vector<std::vector<double>>;

// A plane that is not evaluated whole, and may be among the best.
inline bool can_win(const EvaluatedPlane& plane, double bound, double most) {
    return plane.stage != TermStage::whole && bound < never && bound <= most + tie;
}

struct BestFirst {
    const std::vector<PlanesOfNormal>& planes;
    std::size_t best = 1;             // so many are to be found
    std::size_t normals_at_once = 1;  // fixed, so that what is evaluated does not depend on the threads
    // The cost of a plane as far as it is evaluated; at TermStage::whole, the cost. Called from many threads at once.
    std::function<double(std::size_t normal, std::size_t plane)> bound = {};
    // Evaluates planes of these normals further, at least one that can win of each. `most`: what the last of the best
    // costs that are known, or `never`.
    std::function<void(std::span<const std::size_t> normals, const Bounds& bounds, double most)> evaluate = {};
};

// Evaluates until no other plane can be among the best. Returns what the last of them costs; `never` if there are
// fewer.
double evaluate_what_can_win(const BestFirst& search);

// Of some planes of one normal, given by ascending index, those with the least values: at most `count`, ascending.
// Planes of equal value go by their index.
void keep_least(std::vector<std::size_t>& planes, std::size_t count, std::span<const double> values);

}  // namespace qchopper
