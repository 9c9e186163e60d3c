// The tree of one solid is asked for the triangles in the endless column over each triangle of the other; outlines are
// clipped after I. Sutherland and G. Hodgman, "Reentrant polygon clipping" (1974). No solid_lines.h: what lies over
// each other by an area decides, however small beside the cells of a grid.

#include "segment/joint/in_front.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "segment/mesh/plane_frame.h"
#include "segment/mesh/polygon.h"

namespace qchopper {
namespace {

constexpr double min_mm2 = 1e-6;
constexpr double min_mm = 1e-6;

TriangleMesh turned(std::span<const TriangleMesh* const> meshes, Vec3 direction) {
    const PlaneFrame frame = frame_across(direction);
    TriangleMesh all;
    for (const TriangleMesh* mesh : meshes) {
        const auto first = static_cast<std::uint32_t>(all.points.size());
        for (const Vec3& p : mesh->points) all.points.push_back({dot(frame.u, p), dot(frame.v, p), dot(direction, p)});
        for (const Triangle& t : mesh->triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return all;
}

using Polygon = std::vector<Point2>;

Polygon outline_of(const std::array<Vec3, 3>& corners) {
    Polygon outline;
    for (const Vec3& p : corners) outline.push_back({p.x, p.y});
    if (orientation(outline[0], outline[1], outline[2]) < 0) std::swap(outline[1], outline[2]);
    return outline;
}

double area_of(const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) twice += orientation(polygon[0], polygon[i - 1], polygon[i]);
    return twice / 2;
}

// What of the polygon lies on the left of the line from a to b.
Polygon left_of(const Polygon& polygon, Point2 a, Point2 b) {
    Polygon part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 p = polygon[i];
        const Point2 q = polygon[(i + 1) % polygon.size()];
        const double of_p = orientation(a, b, p);
        const double of_q = orientation(a, b, q);
        if (of_p >= 0) part.push_back(p);
        if ((of_p >= 0) == (of_q >= 0)) continue;
        const double share = of_p / (of_p - of_q);
        part.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
    }
    return part;
}

Point2 middle_of(const Polygon& polygon) {
    Point2 sum;
    for (const Point2& p : polygon) sum = {sum.x + p.x, sum.y + p.y};
    const double count = static_cast<double>(polygon.size());
    return {sum.x / count, sum.y / count};
}

// Of the plane of a triangle that is not upright.
double height_at(const std::array<Vec3, 3>& corners, Point2 p) {
    const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    return corners[0].z - (normal.x * (p.x - corners[0].x) + normal.y * (p.y - corners[0].y)) / normal.z;
}

void compare(const std::array<Vec3, 3>& first, const std::array<Vec3, 3>& second, InFront& found) {
    const Polygon clipping = outline_of(second);
    if (area_of(clipping) < min_mm2) return;
    Polygon common = outline_of(first);
    for (std::size_t i = 0; i < 3 && !common.empty(); ++i) common = left_of(common, clipping[i], clipping[(i + 1) % 3]);
    if (common.size() < 3 || area_of(common) < min_mm2) return;
    const Point2 middle = middle_of(common);
    const double difference = height_at(first, middle) - height_at(second, middle);
    if (difference > min_mm) found.first = true;
    if (difference < -min_mm) found.second = true;
}

}  // namespace

TurnedSolid::TurnedSolid(std::span<const TriangleMesh* const> meshes, Vec3 direction)
    : mesh_(turned(meshes, direction)),
      tree_(mesh_),
      low_(std::numeric_limits<double>::infinity()),
      high_(-std::numeric_limits<double>::infinity()) {
    for (const Vec3& p : mesh_.points) {
        low_ = std::min(low_, p.z);
        high_ = std::max(high_, p.z);
    }
}

InFront in_front(const TurnedSolid& first, const TurnedSolid& second) {
    InFront found;
    for (std::size_t t = 0; t < first.mesh().triangles.size() && !(found.first && found.second); ++t) {
        const std::array<Vec3, 3> corners = corners_of(first.mesh(), t);
        if (area_of(outline_of(corners)) < min_mm2) continue;
        FloatBox column = second.tree().box_of(corners);
        column.min[2] = -std::numeric_limits<float>::infinity();
        column.max[2] = std::numeric_limits<float>::infinity();
        second.tree().for_each_near(column, [&](std::uint32_t other) {
            if (!found.first || !found.second) compare(corners, corners_of(second.mesh(), other), found);
        });
    }
    return found;
}

}  // namespace qchopper
