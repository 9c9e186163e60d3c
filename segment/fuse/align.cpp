// A tree of triangles per scan; each round costs points_per_scan queries per pair of scans whose boxes meet, and one
// system of 6 equations per scan.

#include "segment/fuse/align.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/parallel.h"
#include "segment/fuse/median.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_tree.h"

namespace qchopper {
namespace {

constexpr double same_side = 0.7;          // least cosine between the normals of a pair
constexpr double first_share = 0.08;       // of the diagonal of a scan: how far pairs may be apart in the first round
constexpr double least_spacings = 3;       // and at least in the last
constexpr double spread_per_residual = 6;  // how far pairs may be apart in the next round, in medians
constexpr double still_share = 1e-3;       // of the spacing: rounds end when no scan moves by more
constexpr double tukey = 4.685 * 1.4826;   // times the median: from there on a pair has no weight (Huber 1981)

using Vector6 = Eigen::Matrix<double, 6, 1>;

struct PairingPoint {
    Vec3 point;
    Vec3 normal;
};

// What is asked of a scan again and again, in its own frame.
struct Known {
    const ScanSurface& surface;
    TriangleTree tree;
    Box box;
    std::vector<PairingPoint> samples;
};

std::vector<PairingPoint> samples_of(const ScanSurface& surface, std::size_t wanted) {
    std::vector<std::uint32_t> usable;
    for (std::uint32_t i = 0; i < surface.mesh.points.size(); ++i) {
        if (surface.border[i] == 0 && norm(surface.normals[i]) > 0) usable.push_back(i);
    }
    std::vector<PairingPoint> samples;
    const double step = std::max(1.0, static_cast<double>(usable.size()) / static_cast<double>(wanted));
    for (double at = 0; at < static_cast<double>(usable.size()); at += step) {
        const std::uint32_t i = usable[static_cast<std::size_t>(at)];
        samples.push_back({surface.mesh.points[i], surface.normals[i]});
    }
    return samples;
}

std::vector<Known> known_of(std::span<const ScanSurface> surfaces, std::size_t points_per_scan) {
    std::vector<Known> all;
    for (const ScanSurface& surface : surfaces) {
        all.push_back(
            {surface, TriangleTree(surface.mesh), bounds(surface.mesh), samples_of(surface, points_per_scan)});
    }
    return all;
}

bool is_near(const Box& box, Vec3 p, double limit) {
    for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] < box.min[axis] - limit || p[axis] > box.max[axis] + limit) return false;
    }
    return true;
}

// A point of one scan and the plane at the nearest point of another, in the common frame.
struct Pair {
    std::size_t from = 0;
    std::size_t to = 0;
    Vec3 point;
    Vec3 foot;
    Vec3 normal;  // of `to` at the foot
    double residual() const { return dot(normal, point - foot); }
};

// The pairs of a sample of scan `i` with scan `j`; nothing if it is too far, at a border or turned away.
std::optional<Pair> paired(const std::vector<Known>& all, std::span<const Pose> poses, std::size_t i, std::size_t j,
                           const PairingPoint& sample, double limit) {
    const Known& other = all[j];
    const Vec3 point = apply(poses[i], sample.point);
    const Vec3 there = apply_inverse(poses[j], point);
    if (!is_near(other.box, there, limit)) return {};
    if (!other.tree.is_any_nearer(other.surface.mesh, there, limit)) return {};
    const TriangleTree::Nearest nearest = other.tree.nearest(other.surface.mesh, there);
    Vec3 normal;
    for (const std::uint32_t corner : other.surface.mesh.triangles[nearest.triangle]) {
        if (other.surface.border[corner] != 0) return {};
        normal = normal + other.surface.normals[corner];
    }
    normal = rotate(poses[j], normalized(normal));
    if (dot(normal, rotate(poses[i], sample.normal)) < same_side) return {};
    return Pair{i, j, point, apply(poses[j], nearest.point), normal};
}

std::vector<Pair> pairs_of(const std::vector<Known>& all, std::span<const Pose> poses, double limit,
                           const Context& context) {
    std::vector<std::vector<Pair>> of_scan(all.size());
    parallel_for(0, all.size(), [&](std::size_t i) {
        for (std::size_t j = 0; j < all.size(); ++j) {
            context.check_cancelled();
            if (i == j || all[j].surface.mesh.triangles.empty()) continue;
            for (const PairingPoint& sample : all[i].samples) {
                if (const std::optional<Pair> pair = paired(all, poses, i, j, sample, limit)) {
                    of_scan[i].push_back(*pair);
                }
            }
        }
    });
    std::vector<Pair> pairs;
    for (const std::vector<Pair>& own : of_scan) pairs.insert(pairs.end(), own.begin(), own.end());
    return pairs;
}

double median_residual(const std::vector<Pair>& pairs) {
    std::vector<double> sizes;
    sizes.reserve(pairs.size());
    for (const Pair& pair : pairs) sizes.push_back(std::abs(pair.residual()));
    return median(std::move(sizes));
}

Vector6 derivative(Vec3 at, Vec3 normal) {
    const Vec3 turn = cross(at, normal);
    Vector6 row;
    row << turn.x, turn.y, turn.z, normal.x, normal.y, normal.z;
    return row;
}

// A turn by the length of `turn` about it, then a shift.
Pose motion_of(const Vector6& step) {
    const Vec3 turn{step[0], step[1], step[2]};
    const double angle = norm(turn);
    const Vec3 k = normalized(turn);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const auto row = [&](int i, Vec3 cross_row) {
        Vec3 e;
        e[i] = c;
        return e + s * cross_row + (1 - c) * k[i] * k;
    };
    return {{row(0, {0, -k.z, k.y}), row(1, {k.z, 0, -k.x}), row(2, {-k.y, k.x, 0})}, {step[3], step[4], step[5]}};
}

// The motions of all scans but the first that make the weighted squares least, to first order, about `centre`, so that
// the equations do not depend on where the frame lies.
std::vector<Vector6> least_squares(const std::vector<Pair>& pairs, std::size_t scans, Vec3 centre) {
    const auto size = static_cast<Eigen::Index>(6 * scans);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
    const double scale = std::max(tukey * median_residual(pairs), std::numeric_limits<double>::min());
    for (const Pair& pair : pairs) {
        const double share = pair.residual() / scale;
        if (std::abs(share) >= 1) continue;
        const double weight = (1 - share * share) * (1 - share * share);
        const Vector6 own = derivative(pair.point - centre, pair.normal);
        const Vector6 other = -derivative(pair.foot - centre, pair.normal);
        const auto i = static_cast<Eigen::Index>(6 * pair.from);
        const auto j = static_cast<Eigen::Index>(6 * pair.to);
        matrix.block<6, 6>(i, i) += weight * own * own.transpose();
        matrix.block<6, 6>(j, j) += weight * other * other.transpose();
        matrix.block<6, 6>(i, j) += weight * own * other.transpose();
        matrix.block<6, 6>(j, i) += weight * other * own.transpose();
        right.segment<6>(i) -= weight * pair.residual() * own;
        right.segment<6>(j) -= weight * pair.residual() * other;
    }
    // A small pull to no motion, for scans without pairs and for what pairs leave free, as a plane leaves its shifts.
    matrix.diagonal().array() += 1e-6 * std::max(matrix.trace() / static_cast<double>(size), 1e-30);
    const Eigen::Index free = size - 6;
    std::vector<Vector6> steps(scans, Vector6::Zero());
    const Eigen::VectorXd solved = matrix.bottomRightCorner(free, free).ldlt().solve(right.tail(free));
    for (std::size_t i = 1; i < scans; ++i) steps[i] = solved.segment<6>(static_cast<Eigen::Index>(6 * i - 6));
    return steps;
}

// How far the corners of a box move at most.
double largest_move(const Box& box, const Pose& before, const Pose& after) {
    double move = 0;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner{(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                          (i & 4) != 0 ? box.max.z : box.min.z};
        move = std::max(move, norm(apply(after, corner) - apply(before, corner)));
    }
    return move;
}

double first_limit(const std::vector<Known>& all, double least) {
    std::vector<double> diagonals;
    diagonals.reserve(all.size());
    for (const Known& known : all) diagonals.push_back(norm(known.box.size()));
    return std::max(least, first_share * median(std::move(diagonals)));
}

}  // namespace

double apart(std::span<const ScanSurface> surfaces, std::span<const Pose> poses, double limit, const Context& context) {
    constexpr std::size_t few = 200;
    const std::vector<Known> all = known_of(surfaces, few);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        context.check_cancelled();
        for (const PairingPoint& sample : all[i].samples) {
            double least = limit;
            for (std::size_t j = 0; j < all.size(); ++j) {
                if (const auto pair = i == j ? std::nullopt : paired(all, poses, i, j, sample, limit)) {
                    least = std::min(least, norm(pair->point - pair->foot));
                }
            }
            sum += least;
            ++count;
        }
    }
    return count == 0 ? std::numeric_limits<double>::infinity() : sum / static_cast<double>(count);
}

Alignment align(std::span<const ScanSurface> surfaces, std::span<const Pose> poses, const AlignOptions& options,
                const Context& context) {
    const std::vector<Known> all = known_of(surfaces, options.points_per_scan);
    std::vector<Pose> now(poses.begin(), poses.end());
    const double least = least_spacings * options.spacing;
    double limit = first_limit(all, least);
    Alignment alignment;
    std::vector<Pair> pairs = pairs_of(all, now, limit, context);
    while (alignment.rounds < options.max_rounds && !pairs.empty()) {
        context.progress("rounds of alignment", static_cast<std::size_t>(alignment.rounds), 0);
        ++alignment.rounds;
        Vec3 centre;
        for (const Pair& pair : pairs) centre = centre + (1.0 / static_cast<double>(pairs.size())) * pair.point;
        const std::vector<Vector6> steps = least_squares(pairs, all.size(), centre);
        double move = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Pose motion = motion_of(steps[i]);
            const Pose about{motion.row, motion.shift + centre - rotate(motion, centre)};
            const Pose next = about * now[i];
            move = std::max(move, largest_move(all[i].box, now[i], next));
            now[i] = next;
        }
        const double next_limit = std::max(least, std::min(limit, spread_per_residual * median_residual(pairs)));
        const bool is_last = move <= still_share * options.spacing && next_limit >= limit;
        limit = next_limit;
        pairs = pairs_of(all, now, limit, context);
        if (is_last) break;
    }
    alignment.residual = median_residual(pairs);
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::vector<Pair> own;
        std::ranges::copy_if(pairs, std::back_inserter(own), [&](const Pair& p) { return p.from == i || p.to == i; });
        alignment.scans.push_back({now[i], own.size(), median_residual(own)});
    }
    return alignment;
}

}  // namespace qchopper
