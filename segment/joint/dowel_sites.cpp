// The triangle tree proposes triangles in the box around the axis, and each is measured. O(triangles near the axis) a
// site.

#include "segment/joint/dowel_sites.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

// The abscissae at which a row crosses the loops of the regions, ascending: inside between the first and second, ...
std::vector<std::vector<double>> crossings_of_rows(const FlatRegion& contact, const Rectangle2& box, double spacing,
                                                   std::size_t rows) {
    std::vector<std::vector<double>> crossings(rows);
    const auto add = [&](const Loop& loop) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Point2 a = contact.points[loop[i]];
            const Point2 b = contact.points[loop[(i + 1) % loop.size()]];
            const double first = std::ceil((std::min(a.y, b.y) - box.min.y) / spacing - 0.5);
            for (auto row = static_cast<std::size_t>(std::max(0.0, first)); row < rows; ++row) {
                const double y = box.min.y + (static_cast<double>(row) + 0.5) * spacing;
                if (y > std::max(a.y, b.y)) break;
                if ((a.y > y) != (b.y > y)) crossings[row].push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
            }
        }
    };
    for (const CapRegion& region : contact.regions) {
        add(contact.loops[region.outer]);
        for (const std::size_t hole : region.holes) add(contact.loops[hole]);
    }
    for (std::vector<double>& row : crossings) std::sort(row.begin(), row.end());
    return crossings;
}

Rectangle2 box_of(const FlatRegion& contact) {
    Rectangle2 box;
    for (const CapRegion& region : contact.regions) {
        for (const std::uint32_t p : contact.loops[region.outer]) box.include(contact.points[p]);
    }
    return box;
}

}  // namespace

bool PieceSurface::is_clear(const Axis& axis, double distance, std::int32_t cut) const {
    FloatBox box = tree_.box_of({axis.begin, axis.end, axis.begin});
    const auto reach = std::nextafter(static_cast<float>(distance), std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < 3; ++i) {
        box.min[i] = std::nextafter(box.min[i] - reach, -std::numeric_limits<float>::infinity());
        box.max[i] = std::nextafter(box.max[i] + reach, std::numeric_limits<float>::infinity());
    }
    bool clear = true;
    tree_.for_each_near(box, [&](std::uint32_t t) {
        if (clear && cap_of(mesh_, t) != cut) clear = distance_between(axis, corners_of(mesh_, t)) >= distance;
    });
    return clear;
}

namespace {

// Whether a dowel at a point of the contact's plane is clear in both pieces.
bool is_clear(const ContactSides& sides, Vec3 point, const DowelSize& size) {
    const Vec3 depth = size.depth * sides.plane.normal;
    return sides.above.is_clear({point, point + depth}, size.clearance(), sides.cut) &&
           sides.below.is_clear({point, point - depth}, size.clearance(), sides.cut);
}

}  // namespace

std::vector<Point2> grid_points(const FlatRegion& contact, std::size_t most) {
    std::vector<Point2> points;
    if (contact.empty() || most == 0) return points;
    const double spacing = std::max(1.0, std::sqrt(contact.area_mm2 / static_cast<double>(most)));
    const Rectangle2 box = box_of(contact);
    const auto rows = static_cast<std::size_t>(std::ceil((box.max.y - box.min.y) / spacing));
    const std::vector<std::vector<double>> crossings = crossings_of_rows(contact, box, spacing, rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const double y = box.min.y + (static_cast<double>(row) + 0.5) * spacing;
        for (std::size_t i = 0; i + 1 < crossings[row].size(); i += 2) {
            const double first = std::ceil((crossings[row][i] - box.min.x) / spacing - 0.5);
            for (double column = first;; ++column) {
                const double x = box.min.x + (column + 0.5) * spacing;
                if (x > crossings[row][i + 1]) break;
                points.push_back({x, y});
            }
        }
    }
    return points;
}

std::vector<Point2> clear_sites(const ContactSides& sides, std::span<const Point2> points, const DowelSize& size) {
    std::vector<Point2> clear;
    for (const Point2& p : points) {
        if (is_clear(sides, from_plane(sides.plane, p), size)) clear.push_back(p);
    }
    return clear;
}

}  // namespace qchopper
