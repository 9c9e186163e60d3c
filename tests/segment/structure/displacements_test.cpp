#include "segment/structure/displacements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "segment/structure/stress.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

struct Bricks {
    VoxelGrid grid;
    std::vector<std::uint32_t> voxels;
    BrickNodes nodes;
    BrickLoads loads;

    explicit Bricks(const TriangleMesh& mesh, double size = 1) : grid(voxel_grid(mesh, {0, 0, 1}, size)) {
        // The axes of the tests, not those that a frame would take.
        std::swap(grid.count[0], grid.count[1]);
        grid.axis = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
        const Box box = bounds(mesh);
        grid.corner = box.min;
        voxels = voxels_inside(mesh, grid);
        nodes = brick_nodes(grid, voxels);
        loads.load.resize(nodes.number.size());
        loads.is_held.assign(nodes.number.size(), 0);
    }

    void add_weight() {
        for (const auto& corners : nodes.corners) {
            for (const std::uint32_t node : corners) loads.load[node].z -= 1.0 / 8;
        }
    }

    // The stress at the centre of a voxel, of a modulus of 1.
    std::array<double, 6> stress(const Brick& brick, const Displacements& d, std::size_t voxel) const {
        std::array<double, 6> s{};
        for (std::size_t row = 0; row < 6; ++row) {
            for (std::size_t i = 0; i < 24; ++i) {
                s[row] += brick.stress[row][i] * d.of_node[nodes.corners[voxel][i / 3]][static_cast<int>(i % 3)];
            }
        }
        return s;
    }
};

// The forces of all bricks, one brick at a time.
std::vector<Vec3> forces(const Bricks& b, const Brick& brick, const std::vector<Vec3>& displacement) {
    std::vector<Vec3> force(displacement.size());
    for (const auto& corners : b.nodes.corners) {
        for (std::size_t i = 0; i < 24; ++i) {
            for (std::size_t j = 0; j < 24; ++j) {
                force[corners[i / 3]][static_cast<int>(i % 3)] +=
                    brick.stiffness[i][j] * displacement[corners[j / 3]][static_cast<int>(j % 3)];
            }
        }
    }
    return force;
}

TEST(Displacements, OfEveryShapeBalanceTheLoads) {
    const Brick element = brick(0.3);
    for (const TriangleMesh& mesh : {shapes::torus({0, 0, 0}, 9, 3), shapes::stairs(), shapes::ball({0, 0, 0}, 6)}) {
        const Vec3 size = bounds(mesh).size();
        Bricks b(mesh, std::max({size.x, size.y, size.z}) / 14);
        b.add_weight();
        for (std::uint32_t node = 0; node < b.nodes.number.size(); ++node) {
            if (b.nodes.place(node)[2] == 0) b.loads.is_held[node] = 7;
        }
        const Displacements d = solve(b.nodes, element, b.loads, {}, {});
        ASSERT_TRUE(d.has_converged);
        const std::vector<Vec3> force = forces(b, element, d.of_node);
        double left = 0;
        double all = 0;
        for (std::size_t node = 0; node < force.size(); ++node) {
            if (b.loads.is_held[node] != 0) {
                EXPECT_EQ(d.of_node[node], Vec3{});
                continue;
            }
            left += dot(b.loads.load[node] - force[node], b.loads.load[node] - force[node]);
            all += dot(b.loads.load[node], b.loads.load[node]);
        }
        EXPECT_LT(std::sqrt(left / all), 1.1e-6);
    }
}

TEST(Displacements, UniformStressIsExactInAnyShape) {
    // The patch test: tractions of one stress on all faces, and no more held than the body as a whole.
    const Brick element = brick(0.3);
    const Stress s{0.7, -0.4, 0.3, 0.25, -0.15, 0.45};
    Bricks b(shapes::torus({0, 0, 0}, 6, 2.4));
    const std::vector<VoxelNeighbours> beside = voxel_neighbours(b.grid, b.voxels);
    for (std::size_t v = 0; v < b.voxels.size(); ++v) {
        for (std::size_t side = 0; side < 6; ++side) {
            if (beside[v][side] != no_voxel) continue;
            Vec3 normal;
            normal[static_cast<int>(side / 2)] = side % 2 == 0 ? -1 : 1;
            for (std::size_t corner = 0; corner < 8; ++corner) {
                if ((corner >> (side / 2) & 1U) != side % 2) continue;
                Vec3& load = b.loads.load[b.nodes.corners[v][corner]];
                load = load + 0.25 * traction(s, normal);
            }
        }
    }
    b.loads.is_held[b.nodes.corners[0][0]] = 7;
    b.loads.is_held[b.nodes.corners[0][1]] = 6;  // no turn about y and z
    b.loads.is_held[b.nodes.corners[0][2]] = 4;  // nor about x
    const Displacements d = solve(b.nodes, element, b.loads, {1e-12, 10'000}, {});
    ASSERT_TRUE(d.has_converged);
    for (std::size_t v = 0; v < b.voxels.size(); ++v) {
        const std::array<double, 6> got = b.stress(element, d, v);
        const std::array<double, 6> wanted{s.xx, s.yy, s.zz, s.xy, s.yz, s.zx};
        for (std::size_t row = 0; row < 6; ++row) EXPECT_NEAR(got[row], wanted[row], 1e-8);
    }
}

TEST(Displacements, ABarOnASlidingBaseCarriesTheWeightAboveEverySection) {
    const Brick element = brick(0.3);
    Bricks b(shapes::box({0, 0, 0}, {3, 4, 20}));
    b.add_weight();
    for (std::uint32_t node = 0; node < b.nodes.number.size(); ++node) {
        const VoxelPlace at = b.nodes.place(node);
        if (at[2] > 0) continue;
        b.loads.is_held[node] = at[0] == 0 && at[1] == 0 ? 7 : at[0] == 3 && at[1] == 0 ? 6 : 4;
    }
    const Displacements d = solve(b.nodes, element, b.loads, {}, {});
    for (std::uint32_t layer = 0; layer < 20; ++layer) {
        double mean = 0;
        for (std::size_t v = 0; v < b.voxels.size(); ++v) {
            if (b.grid.place(b.voxels[v])[2] == layer) mean += b.stress(element, d, v)[2] / 12;
        }
        const double wanted = -(20 - layer - 0.5);
        EXPECT_NEAR(mean / wanted, 1, 1e-3) << layer;
    }
}

struct Bending {
    double worst_stress = 0;  // over the middle half: the sum of the tension by that of the beam, least 1
    double deflection = 0;    // of the tip, by that of the beam
};

// A cantilever along x of n x n voxels across and 8 n long under its own weight, against Timoshenko's beam.
Bending bend(int n) {
    const Brick element = brick(0.3);
    const double length = 8.0 * n;
    Bricks b(shapes::box({0, 0, 0}, {length, 1.0 * n, 1.0 * n}));
    b.add_weight();
    double tip = 0;
    for (std::uint32_t node = 0; node < b.nodes.number.size(); ++node) {
        if (b.nodes.place(node)[0] == 0) b.loads.is_held[node] = 7;
    }
    const Displacements d = solve(b.nodes, element, b.loads, {}, {});
    EXPECT_TRUE(d.has_converged);
    for (std::uint32_t node = 0; node < b.nodes.number.size(); ++node) {
        if (b.nodes.place(node)[0] == 8U * static_cast<unsigned>(n)) tip -= d.of_node[node].z / ((n + 1) * (n + 1));
    }
    const double weight = 1.0 * n * n;  // per length
    const double inertia = std::pow(n, 4) / 12;
    const double shear = 10 * 1.3 / (12 + 11 * 0.3) / (2 * 1.3) * n * n;  // k G A, Cowper 1966
    Bending result;
    result.deflection = tip / (weight * std::pow(length, 4) / (8 * inertia) + weight * length * length / (2 * shear));
    for (int x = 2 * n; x < 6 * n; ++x) {
        double tension = 0;
        for (std::size_t v = 0; v < b.voxels.size(); ++v) {
            if (b.grid.place(b.voxels[v])[0] == static_cast<unsigned>(x)) {
                tension += std::max(b.stress(element, d, v)[0], 0.0);
            }
        }
        const double moment = weight * std::pow(length - x - 0.5, 2) / 2;
        result.worst_stress = std::max(result.worst_stress, std::abs(tension / (1.5 * moment / n) - 1));
    }
    return result;
}

TEST(Displacements, OfACantileverAreThoseOfTheBeam) {
    EXPECT_LT(bend(2).worst_stress, 0.05);
    const Bending fine = bend(4);
    EXPECT_LT(fine.worst_stress, 0.05);
    EXPECT_NEAR(fine.deflection, 1, 0.05);
}

TEST(Displacements, AreTheSameBitsForAnyNumberOfThreads) {
    const Brick element = brick(0.3);
    Bricks b(shapes::torus({0, 0, 0}, 12, 5));
    b.add_weight();
    for (std::uint32_t node = 0; node < b.nodes.number.size(); ++node) {
        if (b.nodes.place(node)[2] == 0) b.loads.is_held[node] = 7;
    }
    const Displacements all = solve(b.nodes, element, b.loads, {}, {});
    const ThreadLimit one(1);
    const Displacements alone = solve(b.nodes, element, b.loads, {}, {});
    EXPECT_EQ(all.of_node, alone.of_node);
    EXPECT_EQ(all.iterations, alone.iterations);
}

TEST(Displacements, OfABodyThatIsNotHeldAreNotFound) {
    Bricks b(shapes::box({0, 0, 0}, {3, 3, 3}));
    b.add_weight();
    EXPECT_FALSE(solve(b.nodes, brick(0.3), b.loads, {1e-6, 500}, {}).has_converged);
}

TEST(Displacements, ACancelledSolutionStops) {
    Bricks b(shapes::box({0, 0, 0}, {3, 3, 3}));
    b.add_weight();
    const std::atomic<bool> cancelled{true};
    Context context;
    context.cancelled = &cancelled;
    EXPECT_THROW(solve(b.nodes, brick(0.3), b.loads, {}, context), Cancelled);
}

}  // namespace
}  // namespace qchopper
