#include "segment/structure/brick.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/vec3.h"

namespace qchopper {
namespace {

using Values = std::array<double, 24>;

Vec3 corner(std::size_t node) {
    return {node & 1U ? 1.0 : 0.0, node & 2U ? 1.0 : 0.0, node & 4U ? 1.0 : 0.0};
}

// The displacements g x of the corners.
Values linear(const std::array<Vec3, 3>& g) {
    Values u{};
    for (std::size_t node = 0; node < 8; ++node) {
        for (std::size_t k = 0; k < 3; ++k) u[3 * node + k] = dot(g[k], corner(node));
    }
    return u;
}

double energy(const Brick& b, const Values& u) {
    double sum = 0;
    for (std::size_t i = 0; i < 24; ++i) {
        for (std::size_t j = 0; j < 24; ++j) sum += u[i] * b.stiffness[i][j] * u[j];
    }
    return sum;
}

TEST(Brick, RigidMotionsHaveNoForces) {
    const Brick b = brick(0.3);
    for (int axis = 0; axis < 3; ++axis) {
        Values shift{};
        for (std::size_t node = 0; node < 8; ++node) shift[3 * node + static_cast<std::size_t>(axis)] = 1;
        Vec3 e;
        e[axis] = 1;
        const Values turn = linear({cross({1, 0, 0}, e), cross({0, 1, 0}, e), cross({0, 0, 1}, e)});
        for (const Values& u : {shift, turn}) {
            for (std::size_t i = 0; i < 24; ++i) {
                double force = 0;
                for (std::size_t j = 0; j < 24; ++j) force += b.stiffness[i][j] * u[j];
                EXPECT_NEAR(force, 0, 1e-14);
            }
        }
    }
}

TEST(Brick, UniformStrainIsExact) {
    const double nu = 0.3;
    const Brick b = brick(nu);
    const std::array<Vec3, 3> g{Vec3{0.3, -0.2, 0.5}, Vec3{0.1, -0.7, 0.2}, Vec3{0.4, 0.9, 0.6}};
    const Values u = linear(g);
    const double lambda = nu / ((1 + nu) * (1 - 2 * nu));
    const double shear = 1 / (2 * (1 + nu));
    const double trace = g[0].x + g[1].y + g[2].z;
    const std::array<double, 6> strain{g[0].x, g[1].y, g[2].z, g[0].y + g[1].x, g[1].z + g[2].y, g[2].x + g[0].z};
    double wanted = 0;
    for (std::size_t row = 0; row < 6; ++row) {
        const double stress = row < 3 ? lambda * trace + 2 * shear * strain[row] : shear * strain[row];
        double got = 0;
        for (std::size_t j = 0; j < 24; ++j) got += b.stress[row][j] * u[j];
        EXPECT_NEAR(got, stress, 1e-14);
        wanted += stress * strain[row];
    }
    EXPECT_NEAR(energy(b, u), wanted, 1e-13) << "the modes take no part";
}

TEST(Brick, BendingCostsAsMuchAsInABeam) {
    // u = x z, w = -x^2 / 2 about the middle: at the corners only u differs. A beam of side 1 bent to a curvature of 1
    // has the energy E I = 1/12; without modes and with Poisson's ratio 0.3 a brick has over 1.5 times that.
    Values u{};
    for (std::size_t node = 0; node < 8; ++node) {
        const Vec3 p = corner(node) - Vec3{0.5, 0.5, 0.5};
        u[3 * node] = p.x * p.z;
    }
    EXPECT_NEAR(energy(brick(0), u), 1.0 / 12, 1e-14);
    EXPECT_NEAR(energy(brick(0.3), u), 1.0 / 12, 1e-2);
}

TEST(Brick, EveryDeformationCostsEnergy) {
    const Brick b = brick(0.45);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> value(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        Values u{};
        for (double& x : u) x = value(random);
        EXPECT_GT(energy(b, u), 0);
    }
    for (std::size_t i = 0; i < 24; ++i) {
        for (std::size_t j = 0; j < 24; ++j) EXPECT_EQ(b.stiffness[i][j], b.stiffness[j][i]);
    }
}

}  // namespace
}  // namespace qchopper
