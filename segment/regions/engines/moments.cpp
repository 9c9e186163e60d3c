#include "segment/regions/engines/moments.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstddef>

namespace qchopper {

void PointMoments::add_triangle(const std::array<Vec3, 3>& corner, double area) {
    const Vec3 total = corner[0] + corner[1] + corner[2];
    weight += area;
    sum = sum + (area / 3) * total;
    for (const Vec3& p : corner) add_product(products, p, area / 12);
    add_product(products, total, area / 12);
}

void PointMoments::add_edge(Vec3 a, Vec3 b) {
    const double length = norm(b - a);
    weight += length;
    sum = sum + (length / 2) * (a + b);
    for (const Vec3& p : {a, b, a + b}) add_product(products, p, length / 6);
}

void PointMoments::add(const PointMoments& other) {
    weight += other.weight;
    sum = sum + other.sum;
    for (std::size_t i = 0; i < products.size(); ++i) products[i] += other.products[i];
}

Symmetric3 PointMoments::covariance() const {
    if (!(weight > 0)) return {};
    Symmetric3 mean = products;
    for (double& m : mean) m /= weight;
    add_product(mean, centre(), -1);
    return mean;
}

PrincipalAxes principal_axes(const Symmetric3& m) {
    Eigen::Matrix3d matrix;
    matrix << m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    PrincipalAxes axes;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d v = solver.eigenvectors().col(k);
        axes.direction[static_cast<std::size_t>(k)] = {v.x(), v.y(), v.z()};
        axes.square[static_cast<std::size_t>(k)] = std::max(0.0, solver.eigenvalues()[k]);
    }
    return axes;
}

}  // namespace qchopper
