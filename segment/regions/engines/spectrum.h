// The first eigenvectors of the affinities between the elements of a graph, and groups of elements that lie near each
// other in their space.
//
// Tests: tests/segment/regions/spectrum_test.cpp.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/regions/engines/shortest_paths.h"

namespace qchopper {

struct Spectrum {
    std::vector<double> values;   // descending; the largest is 1
    std::vector<double> vectors;  // element by element, one number per value; columns have unit length
    std::span<const double> row(std::size_t element) const {
        return std::span(vectors).subspan(element * values.size(), values.size());
    }
};

// The affinity of two elements is exp(-d^2 / (2 sigma^2)), d being the least cost of a path and sigma its mean over all
// samples and elements; 0 without a path. Of N = D^-1/2 W D^-1/2, with D the sums of the rows of W, the first `count`
// eigenvectors or as many as N has above 1e-9. W is known from the samples to all elements and extended by the Nystroem
// method; it is exact, but for eigenvalues below 0, if all elements are samples. Precondition: there is a sample, each
// once. Elements that no sample reaches have rows of zeros. O(s n log n + s^2 n + s^3) for n elements and s samples,
// and 16 s n bytes. The same for any number of threads.
Spectrum affinity_spectrum(const WeightedGraph& graph, const std::vector<std::uint32_t>& samples, std::size_t count);

// A group, below k, per element: k-means, weighted, on the rows of the first k vectors, each of unit length, by the
// distances of rows of V V^T. The best of k + 1 starts, each with rows far from each other. Precondition: 0 < k <=
// values. O(n k^3) for each of at most 100 rounds.
std::vector<std::uint32_t> grouped_rows(const Spectrum& spectrum, std::size_t k, const std::vector<double>& weight);

}  // namespace qchopper
