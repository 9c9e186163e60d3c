// Gauss integration with 2 x 2 x 2 points, exact for what is integrated here: shape functions (1 +- xi)(1 +- eta)
// (1 +- zeta)/8 and modes 1 - xi^2, 1 - eta^2, 1 - zeta^2, in each of three directions.

#include "segment/structure/brick.h"

#include <Eigen/Dense>
#include <cassert>
#include <cmath>

namespace qchopper {
namespace {

using Strain = Eigen::Matrix<double, 6, 24>;
using ModeStrain = Eigen::Matrix<double, 6, 9>;
using Point = std::array<double, 3>;  // in [-1, 1]

// Of a displacement along `axis` with this gradient.
Eigen::Matrix<double, 6, 1> strain_of(const Point& gradient, std::size_t axis) {
    Eigen::Matrix<double, 6, 1> strain = Eigen::Matrix<double, 6, 1>::Zero();
    strain[static_cast<int>(axis)] = gradient[axis];
    const std::array<std::array<std::size_t, 2>, 3> shear{{{0, 1}, {1, 2}, {2, 0}}};
    for (std::size_t s = 0; s < 3; ++s) {
        const auto& [a, b] = shear[s];
        if (axis == a) strain[static_cast<int>(3 + s)] = gradient[b];
        if (axis == b) strain[static_cast<int>(3 + s)] = gradient[a];
    }
    return strain;
}

// Derivatives are by the coordinates of a cube of side 1: twice those by xi, eta, zeta.
Strain strain_at(const Point& at) {
    Strain b;
    for (std::size_t node = 0; node < 8; ++node) {
        Point sign{};
        for (std::size_t k = 0; k < 3; ++k) sign[k] = (node >> k & 1U) != 0 ? 1 : -1;
        Point gradient{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t l = (k + 1) % 3;
            const std::size_t m = (k + 2) % 3;
            gradient[k] = 2 * sign[k] * (1 + sign[l] * at[l]) * (1 + sign[m] * at[m]) / 8;
        }
        for (std::size_t axis = 0; axis < 3; ++axis)
            b.col(static_cast<int>(3 * node + axis)) = strain_of(gradient, axis);
    }
    return b;
}

ModeStrain mode_strain_at(const Point& at) {
    ModeStrain b;
    for (std::size_t mode = 0; mode < 3; ++mode) {
        Point gradient{};
        gradient[mode] = 2 * -2 * at[mode];
        for (std::size_t axis = 0; axis < 3; ++axis)
            b.col(static_cast<int>(3 * mode + axis)) = strain_of(gradient, axis);
    }
    return b;
}

// Stress by strain of a modulus of 1; shear strains are the whole angles.
Eigen::Matrix<double, 6, 6> elasticity(double poisson_ratio) {
    const double scale = 1 / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
    Eigen::Matrix<double, 6, 6> d = Eigen::Matrix<double, 6, 6>::Zero();
    d.topLeftCorner<3, 3>().setConstant(scale * poisson_ratio);
    for (int k = 0; k < 3; ++k) {
        d(k, k) = scale * (1 - poisson_ratio);
        d(k + 3, k + 3) = 1 / (2 * (1 + poisson_ratio));
    }
    return d;
}

}  // namespace

Brick brick(double poisson_ratio) {
    assert(poisson_ratio >= 0 && poisson_ratio < 0.5);
    const Eigen::Matrix<double, 6, 6> d = elasticity(poisson_ratio);
    Eigen::Matrix<double, 24, 24> nodes = Eigen::Matrix<double, 24, 24>::Zero();
    Eigen::Matrix<double, 24, 9> coupling = Eigen::Matrix<double, 24, 9>::Zero();
    Eigen::Matrix<double, 9, 9> modes = Eigen::Matrix<double, 9, 9>::Zero();
    const double gauss = 1 / std::sqrt(3.0);
    for (std::size_t point = 0; point < 8; ++point) {
        Point at{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = (point >> k & 1U) != 0 ? gauss : -gauss;
        const Strain b = strain_at(at);
        const ModeStrain m = mode_strain_at(at);
        nodes += b.transpose() * d * b / 8;
        coupling += b.transpose() * d * m / 8;
        modes += m.transpose() * d * m / 8;
    }
    const Eigen::Matrix<double, 24, 24> condensed = nodes - coupling * modes.ldlt().solve(coupling.transpose());
    const Strain centre = d * strain_at({0, 0, 0});
    Brick result;
    for (int i = 0; i < 24; ++i) {
        for (int j = 0; j < 24; ++j) {
            result.stiffness[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
                (condensed(i, j) + condensed(j, i)) / 2;
        }
        for (int row = 0; row < 6; ++row) {
            result.stress[static_cast<std::size_t>(row)][static_cast<std::size_t>(i)] = centre(row, i);
        }
    }
    return result;
}

}  // namespace qchopper
