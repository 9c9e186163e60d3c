// Gauss-Jordan elimination with partial pivoting of the Jacobian.

#include "tests/reference/cam/cell/joint_speeds.h"

#include <array>
#include <cmath>
#include <utility>

namespace qchopper {

std::optional<Joints> joint_speeds(const ArmGeometry& arm, const Joints& joints, Vec3 tip_in_flange,
                                   const CartesianVelocity& tip) {
    constexpr double smallest_pivot = 1e-9;
    const double scale = 1 / (arm.c2 + std::hypot(arm.a2, arm.c3));
    const Vec3 flange = tip.linear - cross(tip.angular, rotate(forward(arm, joints), tip_in_flange));
    const Jacobian matrix = jacobian(arm, joints);
    std::array<std::array<double, 7>, 6> row{};  // the matrix, and the velocity as its last column
    for (std::size_t i = 0; i < 6; ++i) {
        const bool is_linear = i < 3;
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) row[i][axis] = (is_linear ? scale : 1) * matrix[i][axis];
        const int k = static_cast<int>(i % 3);
        row[i][6] = is_linear ? scale * flange[k] : tip.angular[k];
    }
    for (std::size_t column = 0; column < 6; ++column) {
        std::size_t pivot = column;
        for (std::size_t i = column + 1; i < 6; ++i) {
            if (std::abs(row[i][column]) > std::abs(row[pivot][column])) pivot = i;
        }
        if (!(std::abs(row[pivot][column]) > smallest_pivot)) return std::nullopt;
        std::swap(row[column], row[pivot]);
        for (std::size_t i = 0; i < 6; ++i) {
            if (i == column) continue;
            const double factor = row[i][column] / row[column][column];
            for (std::size_t k = column; k < 7; ++k) row[i][k] -= factor * row[column][k];
        }
    }
    Joints speeds{};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        speeds[axis] = row[axis][6] / row[axis][axis];
        if (!std::isfinite(speeds[axis])) return std::nullopt;
    }
    return speeds;
}

}  // namespace qchopper
