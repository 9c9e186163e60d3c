// With C the affinities of all elements (rows) to the samples and A those among samples, W is near C A^-1 C^T = G G^T,
// G = C A^-1/2; so the eigenvectors of N = D^-1/2 G G^T D^-1/2 follow from those of a matrix of s x s. C. Fowlkes,
// S. Belongie, F. Chung and J. Malik, "Spectral grouping using the Nystroem method" (2004). Eigen decomposes, in
// O(s^3).

#include "segment/regions/engines/spectrum.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace qchopper {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_value = 1e-9;  // of N, and of A as a share of the largest: what is below counts as 0
constexpr int rounds = 100;

Eigen::Index index(std::size_t i) {
    return static_cast<Eigen::Index>(i);
}

// One row per element, one column per sample: least costs.
MatrixXd costs(const WeightedGraph& graph, const std::vector<std::uint32_t>& samples) {
    MatrixXd cost(index(graph.size()), index(samples.size()));
    parallel_ranges(0, samples.size(), 1, [&](std::size_t first, std::size_t end) {
        for (std::size_t s = first; s < end; ++s) {
            const std::vector<double> from = shortest_paths(graph, std::span(&samples[s], 1)).cost;
            for (std::size_t e = 0; e < from.size(); ++e) cost(index(e), index(s)) = from[e];
        }
    });
    return cost;
}

MatrixXd affinities(MatrixXd cost) {
    double sum = 0;
    double count = 0;
    for (const double c : cost.reshaped()) {
        if (!std::isfinite(c)) continue;
        sum += c;
        ++count;
    }
    const double sigma = sum > 0 ? sum / count : 1;
    for (double& c : cost.reshaped()) c = std::exp(-c * c / (2 * sigma * sigma));
    return cost;
}

// A^-1/2 of a symmetric matrix, on the space of its eigenvalues above 0.
MatrixXd inverse_root(const MatrixXd& a) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a);
    const double least = least_value * solver.eigenvalues().maxCoeff();
    VectorXd root = solver.eigenvalues();
    for (double& value : root) value = value > least ? 1 / std::sqrt(value) : 0;
    return solver.eigenvectors() * root.asDiagonal();
}

// The first mean is farthest from a point, each further one is the row farthest from those before it.
MatrixXd first_means(const MatrixXd& rows, std::size_t k, const Eigen::RowVectorXd& from) {
    MatrixXd means(index(k), rows.cols());
    VectorXd least = (rows.rowwise() - from).rowwise().squaredNorm();
    for (Eigen::Index m = 0; m < index(k); ++m) {
        Eigen::Index farthest = 0;
        least.maxCoeff(&farthest);
        means.row(m) = rows.row(farthest);
        const VectorXd away = (rows.rowwise() - means.row(m)).rowwise().squaredNorm();
        least = m == 0 ? away : VectorXd(least.cwiseMin(away));
    }
    return means;
}

struct Means {
    MatrixXd means;
    std::vector<std::uint32_t> of;  // the nearest mean of each row
    double error = 0;               // the sum of squared distances from it, weighted
};

void assign(Means& found, const MatrixXd& rows, const std::vector<double>& weight) {
    found.error = 0;
    for (std::size_t r = 0; r < weight.size(); ++r) {
        Eigen::Index nearest = 0;
        const double square = (found.means.rowwise() - rows.row(index(r))).rowwise().squaredNorm().minCoeff(&nearest);
        found.of[r] = static_cast<std::uint32_t>(nearest);
        found.error += weight[r] * square;
    }
}

// Rows are assigned and means moved until no row changes.
Means settled(MatrixXd means, const MatrixXd& rows, const std::vector<double>& weight) {
    Means found{std::move(means), std::vector<std::uint32_t>(weight.size()), 0};
    assign(found, rows, weight);
    for (int round = 0; round < rounds; ++round) {
        MatrixXd sum = MatrixXd::Zero(found.means.rows(), rows.cols());
        VectorXd total = VectorXd::Zero(found.means.rows());
        for (std::size_t r = 0; r < weight.size(); ++r) {
            sum.row(found.of[r]) += weight[r] * rows.row(index(r));
            total[found.of[r]] += weight[r];
        }
        for (Eigen::Index m = 0; m < found.means.rows(); ++m) {
            if (total[m] > 0) found.means.row(m) = sum.row(m) / total[m];
        }
        const std::vector<std::uint32_t> before = found.of;
        assign(found, rows, weight);
        if (found.of == before) break;
    }
    return found;
}

}  // namespace

Spectrum affinity_spectrum(const WeightedGraph& graph, const std::vector<std::uint32_t>& samples, std::size_t count) {
    assert(!samples.empty());
    const MatrixXd c = affinities(costs(graph, samples));
    MatrixXd a(c.cols(), c.cols());
    for (std::size_t s = 0; s < samples.size(); ++s) a.row(index(s)) = c.row(index(samples[s]));
    MatrixXd g = c * inverse_root(0.5 * (a + a.transpose()));
    const VectorXd sums = g * g.colwise().sum().transpose();
    for (Eigen::Index e = 0; e < g.rows(); ++e) g.row(e) *= sums[e] > 0 ? 1 / std::sqrt(sums[e]) : 0;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(g.transpose() * g);  // its values ascend
    Spectrum spectrum;
    const Eigen::Index last = g.cols() - 1;
    while (spectrum.values.size() < count && index(spectrum.values.size()) <= last) {
        const double value = solver.eigenvalues()[last - index(spectrum.values.size())];
        if (!(value > least_value)) break;
        spectrum.values.push_back(value);
    }
    const Eigen::Index kept = index(spectrum.values.size());
    MatrixXd vectors = g * solver.eigenvectors().rightCols(kept).rowwise().reverse();
    vectors.colwise().normalize();
    spectrum.vectors.resize(graph.size() * spectrum.values.size());
    for (Eigen::Index e = 0; e < vectors.rows(); ++e) {
        for (Eigen::Index v = 0; v < kept; ++v)
            spectrum.vectors[static_cast<std::size_t>(e * kept + v)] = vectors(e, v);
    }
    return spectrum;
}

std::vector<std::uint32_t> grouped_rows(const Spectrum& spectrum, std::size_t k, const std::vector<double>& weight) {
    assert(k > 0 && k <= spectrum.values.size());
    MatrixXd v(index(weight.size()), index(k));
    for (std::size_t e = 0; e < weight.size(); ++e) {
        for (std::size_t i = 0; i < k; ++i) v(index(e), index(i)) = spectrum.row(e)[i];
    }
    v.rowwise().normalize();
    // |V v_i - V v_j|^2 = (v_i - v_j)^T V^T V (v_i - v_j), so the rows are mapped by the root of V^T V.
    const Eigen::SelfAdjointEigenSolver<MatrixXd> metric(v.transpose() * v);
    const MatrixXd rows = v * metric.operatorSqrt();
    Means best = settled(first_means(rows, k, rows.colwise().mean()), rows, weight);
    const MatrixXd starts = best.means;
    for (Eigen::Index m = 0; m < starts.rows(); ++m) {
        Means other = settled(first_means(rows, k, starts.row(m)), rows, weight);
        if (other.error < best.error) best = std::move(other);
    }
    return best.of;
}

}  // namespace qchopper
