// Sums of area vectors per cut, then pairs of caps. O(points + triangles + caps squared).

#include "segment/search/candidates/cap_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "segment/access/unreachable.h"
#include "segment/mesh/footprint.h"

namespace qchopper {
namespace {

bool is_parallel(Vec3 a, Vec3 b) {
    return norm(cross(a, b)) <= same_direction_rad;
}

bool is_perpendicular(Vec3 a, Vec3 b) {
    return std::abs(dot(a, b)) <= same_direction_rad;
}

void add_once(std::vector<Vec3>& directions, Vec3 direction) {
    const auto is_same = [&](Vec3 d) { return is_parallel(d, direction); };
    if (std::none_of(directions.begin(), directions.end(), is_same)) {
        directions.push_back(canonical({direction, 0}).normal);
    }
}

// The axis across `first` along which the points need the smallest rectangle.
Vec3 along_smallest_rectangle(const std::vector<Vec3>& points, Vec3 first) {
    const auto [e1, e2] = frame_under(first);
    std::vector<Point2> footprint;
    footprint.reserve(points.size());
    for (const Vec3& p : points) footprint.push_back({dot(e1, p), dot(e2, p)});
    const Point2 along = smallest_rectangle(std::move(footprint)).along;
    return normalized(along.x * e1 + along.y * e2);
}

// With the longest extent first and a right-handed frame.
OrientedBox box_of(const std::vector<Vec3>& points, std::array<Vec3, 3> axes) {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<std::pair<double, double>, 3> range;
    range.fill({far, -far});
    for (const Vec3& p : points) {
        for (std::size_t i = 0; i < 3; ++i) {
            range[i].first = std::min(range[i].first, dot(axes[i], p));
            range[i].second = std::max(range[i].second, dot(axes[i], p));
        }
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    const auto length = [&](std::size_t i) { return range[i].second - range[i].first; };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return length(a) > length(b); });
    OrientedBox box;
    for (int i = 0; i < 3; ++i) {
        const std::size_t from = order[static_cast<std::size_t>(i)];
        box.axis[static_cast<std::size_t>(i)] = axes[from];
        box.min[i] = range[from].first;
        box.max[i] = range[from].second;
    }
    if (dot(cross(box.axis[0], box.axis[1]), box.axis[2]) < 0) {
        box.axis[2] = -box.axis[2];
        box.min.z = -std::exchange(box.max.z, -box.min.z);
    }
    return box;
}

}  // namespace

std::vector<Vec3> cap_normals(const Piece& piece) {
    std::vector<OwnedCap> caps = owned_caps(piece);
    std::stable_sort(caps.begin(), caps.end(),
                     [](const OwnedCap& a, const OwnedCap& b) { return a.area_mm2 > b.area_mm2; });
    std::vector<Vec3> normals;
    for (const OwnedCap& cap : caps) add_once(normals, cap.outward);
    return normals;
}

std::optional<OrientedBox> box_along_caps(const Piece& piece) {
    const std::vector<OwnedCap> caps = owned_caps(piece);
    if (caps.empty()) return std::nullopt;
    std::vector<std::pair<Vec3, double>> directions;  // with the area of their caps
    for (const OwnedCap& cap : caps) {
        const auto same = std::find_if(directions.begin(), directions.end(),
                                       [&](const auto& d) { return is_parallel(d.first, cap.outward); });
        if (same == directions.end()) {
            directions.emplace_back(canonical({cap.outward, 0}).normal, cap.area_mm2);
        } else {
            same->second += cap.area_mm2;
        }
    }
    std::stable_sort(directions.begin(), directions.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    const Vec3 first = directions.front().first;
    const auto across = std::find_if(directions.begin() + 1, directions.end(),
                                     [&](const auto& d) { return is_perpendicular(first, d.first); });
    Vec3 second = across == directions.end() ? along_smallest_rectangle(piece.mesh->points, first) : across->first;
    second = normalized(second - dot(second, first) * first);
    const Vec3 third = cross(first, second);
    return box_of(piece.mesh->points, {first, canonical({second, 0}).normal, canonical({third, 0}).normal});
}

OrientedBox box_for_cuts(const Piece& piece, const OrientedBox& own, const CandidateOptions& options) {
    return (options.along_caps ? box_along_caps(piece) : std::nullopt).value_or(own);
}

std::vector<Vec3> normals_along_caps(const Piece& piece) {
    const std::vector<Vec3> caps = cap_normals(piece);
    std::vector<Vec3> normals = caps;
    for (std::size_t a = 0; a < caps.size(); ++a) {
        for (std::size_t b = a + 1; b < caps.size(); ++b) add_once(normals, normalized(cross(caps[a], caps[b])));
    }
    if (const std::optional<OrientedBox> box = box_along_caps(piece)) {
        for (const Vec3& axis : box->axis) add_once(normals, axis);
    }
    return normals;
}

Vec3 snapped(Vec3 normal, const std::vector<Vec3>& caps) {
    for (const Vec3& cap : caps) {
        if (is_parallel(normal, cap)) return dot(normal, cap) < 0 ? -cap : cap;
    }
    for (const Vec3& cap : caps) {
        if (is_perpendicular(normal, cap)) normal = normalized(normal - dot(normal, cap) * cap);
    }
    return normal;
}

bool is_along(Vec3 normal, const std::vector<Vec3>& caps) {
    return std::all_of(caps.begin(), caps.end(),
                       [&](Vec3 cap) { return is_parallel(normal, cap) || is_perpendicular(normal, cap); });
}

}  // namespace qchopper
