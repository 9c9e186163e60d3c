// Range scans of a known surface, as a scanner takes them that looks along -z of its own frame: made by casting rays,
// with noise and places where nothing was taken.

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "base/pose.h"
#include "segment/io/read_range_scan.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/rays.h"

namespace qchopper::views {

inline Pose turned_about(Vec3 axis, double angle, Vec3 shift = {}) {
    const Vec3 k = normalized(axis);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const Vec3 x = c * Vec3{1, 0, 0} + s * cross(k, {1, 0, 0}) + (1 - c) * k.x * k;
    const Vec3 y = c * Vec3{0, 1, 0} + s * cross(k, {0, 1, 0}) + (1 - c) * k.y * k;
    const Vec3 z = c * Vec3{0, 0, 1} + s * cross(k, {0, 0, 1}) + (1 - c) * k.z * k;
    return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, shift};
}

// Poses of scans in the frame of the surface: eight around it, one from above and one from below.
inline std::vector<Pose> ten_poses() {
    std::vector<Pose> poses;
    poses.reserve(10);
    for (int i = 0; i < 8; ++i) poses.push_back(turned_about({0, 1, 0}, i * std::numbers::pi / 4));
    poses.push_back(turned_about({1, 0, 0}, std::numbers::pi / 2));
    poses.push_back(turned_about({1, 0, 0}, -std::numbers::pi / 2));
    return poses;
}

struct ViewOptions {
    double spacing = 1;
    double noise = 0.1;     // standard deviation, along the ray
    double missing = 0.02;  // share of places where nothing was taken
    unsigned seed = 1;
};

// What is seen of the surface from a pose.
inline RangeScan view_of(const TriangleMesh& surface, const RayTree& tree, const Pose& scan_in_surface,
                         const ViewOptions& options) {
    TriangleMesh seen = surface;
    for (Vec3& p : seen.points) p = apply_inverse(scan_in_surface, p);
    const Box box = bounds(seen);
    std::mt19937 random(options.seed);
    std::normal_distribution<double> noise(0, options.noise);
    std::uniform_real_distribution<double> share(0, 1);
    RangeScan scan;
    scan.columns = static_cast<std::size_t>(box.size().x / options.spacing) + 1;
    scan.rows = static_cast<std::size_t>(box.size().y / options.spacing) + 1;
    for (std::size_t row = 0; row < scan.rows; ++row) {
        for (std::size_t column = 0; column < scan.columns; ++column) {
            const Vec3 from{box.min.x + (static_cast<double>(column) + 0.37) * options.spacing,
                            box.min.y + (static_cast<double>(row) + 0.41) * options.spacing, box.max.z + 1};
            const auto hit = tree.first_hit(apply(scan_in_surface, from), rotate(scan_in_surface, {0, 0, -1}));
            const bool is_taken = share(random) >= options.missing;
            const double error = noise(random);
            scan.grid.push_back(RangeScan::no_point);
            if (!hit || !is_taken) continue;
            scan.grid.back() = static_cast<std::uint32_t>(scan.points.size());
            scan.points.push_back(from - (hit->distance + error) * Vec3{0, 0, 1});
        }
    }
    return scan;
}

// As Stanford writes it, in ASCII.
inline std::string ply_of(const RangeScan& scan) {
    std::string text = "ply\nformat ascii 1.0\nobj_info num_cols " + std::to_string(scan.columns) +
                       "\nobj_info num_rows " + std::to_string(scan.rows) + "\nelement vertex " +
                       std::to_string(scan.points.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\nelement range_grid " +
                       std::to_string(scan.grid.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3& p : scan.points) {
        text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    }
    for (const std::uint32_t point : scan.grid) {
        text += point == RangeScan::no_point ? "0\n" : "1 " + std::to_string(point) + "\n";
    }
    return text;
}

// The quaternion qi qj qk qr of a rotation, the real part not negative.
inline std::array<double, 4> quaternion(const Pose& pose) {
    const auto& r = pose.row;
    const double trace = r[0].x + r[1].y + r[2].z;
    std::array<double, 4> q{std::sqrt(std::max(0.0, 1 + r[0].x - r[1].y - r[2].z)) / 2,
                            std::sqrt(std::max(0.0, 1 - r[0].x + r[1].y - r[2].z)) / 2,
                            std::sqrt(std::max(0.0, 1 - r[0].x - r[1].y + r[2].z)) / 2,
                            std::sqrt(std::max(0.0, 1 + trace)) / 2};
    if (q[3] > 1e-6) {
        q[0] = std::copysign(q[0], r[2].y - r[1].z);
        q[1] = std::copysign(q[1], r[0].z - r[2].x);
        q[2] = std::copysign(q[2], r[1].x - r[0].y);
    } else {  // half a turn: the axis, up to its sign
        q[1] = std::copysign(q[1], r[0].y * q[0]);
        q[2] = std::copysign(q[2], (q[0] != 0 ? r[0].z : r[1].z) * (q[0] != 0 ? q[0] : q[1]));
    }
    return q;
}

// A line of a list of scans; `sign` is that of the real part as it is written.
inline std::string list_line(const std::string& file, const Pose& pose, double sign = 1) {
    const std::array<double, 4> q = quaternion(pose);
    std::string line = "bmesh " + file;
    for (const double value : {pose.shift.x, pose.shift.y, pose.shift.z, q[0], q[1], q[2], sign * q[3]}) {
        line += " " + std::to_string(value);
    }
    return line + "\n";
}

// The angle of a rotation, in radians.
inline double angle_of(const Pose& pose) {
    const double trace = pose.row[0].x + pose.row[1].y + pose.row[2].z;
    return std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0));
}

}  // namespace qchopper::views
