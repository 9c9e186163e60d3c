// Sites: the spans of the lines around one are intersected. O(lines x lines within the clearance).

#include "segment/objectives/dowel_columns.h"

#include <algorithm>
#include <cmath>

#include "segment/mesh/plane.h"
#include "segment/mesh/plane_frame.h"

namespace qchopper {
namespace {

// Lines at whole multiples of a spacing.
struct SpacedLines {
    double spacing = 1;
    std::int32_t first_i = 0;
    std::int32_t first_j = 0;
    std::size_t columns = 0;
    std::size_t rows = 0;

    SpacedLines(std::span<const Vec3> points, double distance) : spacing(distance) {
        if (points.empty()) return;
        Rectangle2 all;
        for (const Vec3& p : points) all.include({p.x, p.y});
        first_i = ceiling(all.min.x);
        first_j = ceiling(all.min.y);
        columns = columns_within(all.min.x, all.max.x).end;
        rows = rows_within(all.min.y, all.max.y).end;
    }
    CellSpan columns_within(double low, double high) const { return within(low, high, first_i); }
    CellSpan rows_within(double low, double high) const { return within(low, high, first_j); }
    Point2 at(std::size_t column, std::size_t row) const {
        return {(first_i + static_cast<std::int32_t>(column)) * spacing,
                (first_j + static_cast<std::int32_t>(row)) * spacing};
    }

 private:
    std::int32_t ceiling(double x) const { return static_cast<std::int32_t>(std::ceil(x / spacing)); }
    CellSpan within(double low, double high, std::int32_t first) const {
        const auto floor = static_cast<std::int32_t>(std::floor(high / spacing));
        return {static_cast<std::size_t>(ceiling(low) - first), static_cast<std::size_t>(floor + 1 - first)};
    }
};

std::span<const SolidSpan> solid_at(const SolidLines& map, std::int32_t column, std::int32_t row) {
    const auto c = static_cast<std::size_t>(column);  // less than 0: larger than any
    const auto r = static_cast<std::size_t>(row);
    return c < map.columns && r < map.rows ? map.at(c, r) : std::span<const SolidSpan>();
}

void intersect(std::vector<SolidSpan>& ranges, std::span<const SolidSpan> others, std::vector<SolidSpan>& scratch) {
    scratch.clear();
    std::size_t k = 0;
    for (const SolidSpan& r : ranges) {
        while (k < others.size() && others[k].high < r.low) ++k;
        for (std::size_t o = k; o < others.size() && others[o].low <= r.high; ++o) {
            scratch.push_back({std::max(r.low, others[o].low), std::min(r.high, others[o].high)});
        }
    }
    ranges.swap(scratch);
}

}  // namespace

SolidColumns solid_columns(const TriangleMesh& mesh, Vec3 normal, Vec3 origin, double spacing) {
    const PlaneFrame frame = frame_across(normal);
    std::vector<Vec3> points;
    points.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) {
        points.push_back({dot(frame.u, p - origin), dot(frame.v, p - origin), height(normal, p)});
    }
    const SpacedLines lines(points, spacing);
    return {lines.first_i, lines.first_j, solid_lines(points, mesh.triangles, lines)};
}

std::vector<DowelSite> dowel_sites(const SolidColumns& columns, const ConnectorOptions& dowel) {
    const double reach = dowel.clearance() / dowel.spacing;
    const auto most = static_cast<std::int32_t>(std::floor(reach));
    std::vector<std::array<std::int32_t, 2>> around;
    for (std::int32_t j = -most; j <= most; ++j) {
        for (std::int32_t i = -most; i <= most; ++i) {
            if (i * i + j * j <= reach * reach && (i != 0 || j != 0)) around.push_back({i, j});
        }
    }
    const double shorter = dowel.depth + dowel.wall;
    std::vector<DowelSite> sites;
    std::vector<SolidSpan> ranges;
    std::vector<SolidSpan> scratch;
    for (std::int32_t j = 0; j < static_cast<std::int32_t>(columns.map.rows); ++j) {
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(columns.map.columns); ++i) {
            ranges.clear();
            for (const SolidSpan& r : solid_at(columns.map, i, j)) {
                if (r.high - r.low >= 2 * shorter) ranges.push_back(r);
            }
            for (const auto& [di, dj] : around) {
                if (ranges.empty()) break;
                intersect(ranges, solid_at(columns.map, i + di, j + dj), scratch);
            }
            for (const SolidSpan& r : ranges) {
                if (r.high - r.low >= 2 * shorter)
                    sites.push_back({columns.first_i + i, columns.first_j + j, {r.low + shorter, r.high - shorter}});
            }
        }
    }
    return sites;
}

}  // namespace qchopper
