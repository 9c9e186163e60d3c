// The matrix is never assembled: what a node gets from its 27 neighbours depends only on which of the 8 voxels around
// it exist, so there are at most 255 stencils. Values of a row of nodes lie one after the other, with zeros where it is
// interrupted; so a stencil reads at most 9 runs of 9 numbers. Conjugate gradients (M. Hestenes, E. Stiefel, "Methods
// of conjugate gradients for solving linear systems", 1952) preconditioned by the diagonal; sums are taken over blocks
// of fixed size and then in the order of the blocks. About 250 multiplications a node and iteration.

#include "segment/structure/displacements.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"

namespace qchopper {
namespace {

constexpr std::uint32_t not_there = 0xFFFFFFFF;
constexpr std::size_t nodes_per_block = 2048;

// The part of a stencil that reads nodes x-1, x, x+1 of one row: a column per number read, in the fourth place nothing.
struct StencilRow {
    std::size_t row = 0;  // (dz + 1) * 3 + dy + 1
    Eigen::Matrix<double, 4, 9> block = Eigen::Matrix<double, 4, 9>::Zero();
};
using Stencil = std::vector<StencilRow>;

std::array<std::size_t, 3> bits(std::size_t number) {
    return {number & 1U, number >> 1U & 1U, number >> 2U & 1U};
}

Stencil stencil_of(std::uint8_t voxels, const Brick& brick) {
    std::array<Eigen::Matrix<double, 4, 9>, 9> block;
    block.fill(Eigen::Matrix<double, 4, 9>::Zero());
    std::array<bool, 9> is_used{};
    for (std::size_t voxel = 0; voxel < 8; ++voxel) {
        if ((voxels >> voxel & 1U) == 0) continue;
        const std::size_t own = 7 - voxel;  // which corner of the voxel the node is
        const auto [x, y, z] = bits(voxel);
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const auto [cx, cy, cz] = bits(corner);
            const std::size_t row = (z + cz) * 3 + y + cy;
            is_used[row] = true;
            for (std::size_t from = 0; from < 3; ++from) {
                for (std::size_t to = 0; to < 3; ++to) {
                    block[row](static_cast<int>(to), static_cast<int>(3 * (x + cx) + from)) +=
                        brick.stiffness[3 * own + to][3 * corner + from];
                }
            }
        }
    }
    Stencil stencil;
    for (std::size_t row = 0; row < 9; ++row) {
        if (is_used[row]) stencil.push_back({row, block[row]});
    }
    return stencil;
}

// Where the three values of each node lie in a vector: rows of nodes with zeros around them.
struct Layout {
    std::vector<std::uint32_t> of_node;             // index of its first value
    std::vector<std::array<std::uint32_t, 9>> row;  // per node and row of its stencil: the first of nine values
    std::size_t size = 0;
};

std::vector<std::uint32_t> indices_of(const BrickNodes& nodes, std::size_t& size) {
    std::vector<std::uint32_t> index(nodes.number.size());
    std::uint32_t next = 2;
    for (std::uint32_t i = 0; i < index.size(); ++i) {
        if (i > 0) {
            const bool is_same_row = nodes.number[i] / nodes.count[0] == nodes.number[i - 1] / nodes.count[0];
            next += is_same_row ? std::min(nodes.number[i] - nodes.number[i - 1], 3U) : 3;
        }
        index[i] = 3 * next;
    }
    size = 3 * (static_cast<std::size_t>(next) + 3);
    return index;
}

Layout layout_of(const BrickNodes& nodes) {
    Layout layout;
    layout.of_node = indices_of(nodes, layout.size);
    layout.row.resize(nodes.number.size());
    // By the corners of the voxels, because every node that a stencil reads shares one with its own.
    for (auto& rows : layout.row) rows.fill(not_there);
    for (const std::array<std::uint32_t, 8>& corners : nodes.corners) {
        for (std::size_t own = 0; own < 8; ++own) {
            for (std::size_t other = 0; other < 8; ++other) {
                const auto [x, y, z] = bits(own);
                const auto [ox, oy, oz] = bits(other);
                const std::size_t row = (oz + 1 - z) * 3 + oy + 1 - y;
                layout.row[corners[own]][row] =
                    layout.of_node[corners[other]] - static_cast<std::uint32_t>(3 * (ox + 1 - x));
            }
        }
    }
    return layout;
}

// K p at one node.
Eigen::Vector4d product(const Stencil& stencil, const std::array<std::uint32_t, 9>& rows, const double* p) {
    Eigen::Vector4d a = Eigen::Vector4d::Zero();
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    Eigen::Vector4d c = Eigen::Vector4d::Zero();
    for (const StencilRow& s : stencil) {
        const double* v = p + rows[s.row];
        for (int k = 0; k < 3; ++k) {
            a.noalias() += v[k] * s.block.col(k);
            b.noalias() += v[k + 3] * s.block.col(k + 3);
            c.noalias() += v[k + 6] * s.block.col(k + 6);
        }
    }
    return a + b + c;
}

class Solver {
 public:
    Solver(const BrickNodes& nodes, const Brick& brick, const BrickLoads& loads)
        : nodes_(nodes), layout_(layout_of(nodes)), stencils_(256), sums_(blocks_of(nodes.number.size())) {
        for (const std::uint8_t pattern : nodes.voxels) {
            if (stencils_[pattern].empty()) stencils_[pattern] = stencil_of(pattern, brick);
        }
        for (std::vector<double>* v : {&x_, &r_, &p_, &kp_, &inverse_}) v->assign(layout_.size, 0);
        for (std::size_t i = 0; i < nodes.number.size(); ++i) {
            const Stencil& stencil = stencils_[nodes.voxels[i]];
            const auto own = std::find_if(stencil.begin(), stencil.end(), [](const auto& s) { return s.row == 4; });
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if ((loads.is_held[i] >> axis & 1U) != 0) continue;
                const std::size_t at = layout_.of_node[i] + axis;
                inverse_[at] = 1 / own->block(static_cast<int>(axis), static_cast<int>(3 + axis));
                r_[at] = loads.load[i][static_cast<int>(axis)];
                ++unknowns_;
            }
        }
    }

    Displacements run(const SolveOptions& options, const Context& context) {
        Displacements result;
        result.unknowns = unknowns_;
        const double load = residual_norm();
        result.has_converged = load == 0;
        double rz = first_direction();
        while (!result.has_converged && result.iterations < options.max_iterations) {
            if (result.iterations % 50 == 0) {
                context.check_cancelled();
                context.progress("iterations of the stress analysis", result.iterations, 0);
            }
            const double curvature = multiply();
            if (!(curvature > 0)) break;
            const auto [residual_squared, next_rz] = step(rz / curvature);
            ++result.iterations;
            result.residual = std::sqrt(residual_squared) / load;
            result.has_converged = result.residual <= options.residual;
            turn(next_rz / rz);
            rz = next_rz;
        }
        for (const std::uint32_t at : layout_.of_node) result.of_node.push_back({x_[at], x_[at + 1], x_[at + 2]});
        return result;
    }

 private:
    static std::size_t blocks_of(std::size_t nodes) { return (nodes + nodes_per_block - 1) / nodes_per_block; }

    // Adds up a pair of numbers per block of values, or of nodes.
    template <class Work>
    std::array<double, 2> sum(const Work& work) {
        parallel_for(0, sums_.size(), [&](std::size_t block) { sums_[block] = work(block); });
        std::array<double, 2> all{0, 0};
        for (const std::array<double, 2>& s : sums_) {
            all[0] += s[0];
            all[1] += s[1];
        }
        return all;
    }
    std::size_t first_value(std::size_t block) const { return layout_.size * block / sums_.size(); }

    double residual_norm() {
        return std::sqrt(sum([&](std::size_t block) {
            std::array<double, 2> s{0, 0};
            for (std::size_t i = first_value(block); i < first_value(block + 1); ++i) s[0] += r_[i] * r_[i];
            return s;
        })[0]);
    }

    // p = M^-1 r; returns r.p.
    double first_direction() {
        return sum([&](std::size_t block) {
            std::array<double, 2> s{0, 0};
            for (std::size_t i = first_value(block); i < first_value(block + 1); ++i) {
                p_[i] = inverse_[i] * r_[i];
                s[0] += r_[i] * p_[i];
            }
            return s;
        })[0];
    }

    // kp = K p where it is not held; returns p.kp.
    double multiply() {
        return sum([&](std::size_t block) {
            std::array<double, 2> s{0, 0};
            const std::size_t end = std::min((block + 1) * nodes_per_block, nodes_.number.size());
            for (std::size_t i = block * nodes_per_block; i < end; ++i) {
                const Eigen::Vector4d kp = product(stencils_[nodes_.voxels[i]], layout_.row[i], p_.data());
                const std::size_t at = layout_.of_node[i];
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    kp_[at + axis] = inverse_[at + axis] != 0 ? kp[static_cast<int>(axis)] : 0;
                    s[0] += p_[at + axis] * kp_[at + axis];
                }
            }
            return s;
        })[0];
    }

    // x += a p, r -= a kp; returns r.r and r.M^-1 r.
    std::array<double, 2> step(double a) {
        return sum([&](std::size_t block) {
            std::array<double, 2> s{0, 0};
            for (std::size_t i = first_value(block); i < first_value(block + 1); ++i) {
                x_[i] += a * p_[i];
                r_[i] -= a * kp_[i];
                s[0] += r_[i] * r_[i];
                s[1] += inverse_[i] * r_[i] * r_[i];
            }
            return s;
        });
    }

    void turn(double b) {
        parallel_for(0, sums_.size(), [&](std::size_t block) {
            for (std::size_t i = first_value(block); i < first_value(block + 1); ++i) {
                p_[i] = inverse_[i] * r_[i] + b * p_[i];
            }
        });
    }

    const BrickNodes& nodes_;
    Layout layout_;
    std::vector<Stencil> stencils_;  // per set of voxels around a node
    std::vector<std::array<double, 2>> sums_;
    std::size_t unknowns_ = 0;
    std::vector<double> x_;        // displacements
    std::vector<double> r_;        // residual
    std::vector<double> p_;        // direction
    std::vector<double> kp_;       // the matrix times the direction
    std::vector<double> inverse_;  // of the diagonal; 0 where it is held and between the rows
};

}  // namespace

BrickNodes brick_nodes(const VoxelGrid& grid, const std::vector<std::uint32_t>& voxels) {
    BrickNodes nodes;
    nodes.count = {grid.count[0] + 1, grid.count[1] + 1, grid.count[2] + 1};
    const auto corner_of = [&](const VoxelPlace& at, std::size_t corner) {
        const auto [x, y, z] = bits(corner);
        return static_cast<std::uint32_t>(((at[2] + z) * nodes.count[1] + at[1] + y) * nodes.count[0] + at[0] + x);
    };
    for (const std::uint32_t v : voxels) {
        for (std::size_t corner = 0; corner < 8; ++corner) nodes.number.push_back(corner_of(grid.place(v), corner));
    }
    std::sort(nodes.number.begin(), nodes.number.end());
    nodes.number.erase(std::unique(nodes.number.begin(), nodes.number.end()), nodes.number.end());
    nodes.voxels.assign(nodes.number.size(), 0);
    for (const std::uint32_t v : voxels) {
        std::array<std::uint32_t, 8>& corners = nodes.corners.emplace_back();
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const auto at =
                std::lower_bound(nodes.number.begin(), nodes.number.end(), corner_of(grid.place(v), corner));
            corners[corner] = static_cast<std::uint32_t>(at - nodes.number.begin());
            nodes.voxels[corners[corner]] |= static_cast<std::uint8_t>(1U << (7 - corner));
        }
    }
    return nodes;
}

Displacements solve(const BrickNodes& nodes, const Brick& brick, const BrickLoads& loads, const SolveOptions& options,
                    const Context& context) {
    assert(loads.load.size() == nodes.number.size() && loads.is_held.size() == nodes.number.size());
    return Solver(nodes, brick, loads).run(options, context);
}

}  // namespace qchopper
