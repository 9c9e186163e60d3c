// Triangles are projected along the normal; a line belongs to those triangles of which it crosses an odd number of
// edges, each decided by the same bits for both of its triangles, so that every line enters the solid as often as it
// leaves it. Heights of a line are sorted and taken in pairs. Sites: the ranges of the lines around one are
// intersected.

#include "segment/objectives/dowel_columns.h"

#include <algorithm>
#include <cmath>

#include "segment/mesh/plane_frame.h"
#include "segment/mesh/polygon.h"

namespace qchopper {
namespace {

struct Projected {
    double x;
    double y;
    double h;
};

struct ColumnHit {
    std::uint32_t column;
    double height;
};

// Whether a line at `at` lies before the edge. The edge's ends in the order of their numbers, for equal bits.
bool is_before_edge(Point2 at, const Projected& a, const Projected& b) {
    return (a.y > at.y) != (b.y > at.y) && at.x < (b.x - a.x) * (at.y - a.y) / (b.y - a.y) + a.x;
}

// The height of the triangle over a point of its projection, within that of its corners.
double height_at(Point2 at, const std::array<Projected, 3>& c) {
    const double ux = c[1].x - c[0].x;
    const double uy = c[1].y - c[0].y;
    const double vx = c[2].x - c[0].x;
    const double vy = c[2].y - c[0].y;
    const double area = ux * vy - uy * vx;
    const auto [low, high] = std::minmax({c[0].h, c[1].h, c[2].h});
    if (area == 0) return (low + high) / 2;
    const double px = at.x - c[0].x;
    const double py = at.y - c[0].y;
    const double s = (px * vy - py * vx) / area;
    const double t = (ux * py - uy * px) / area;
    return std::clamp(c[0].h + s * (c[1].h - c[0].h) + t * (c[2].h - c[0].h), low, high);
}

class ColumnFinder {
 public:
    ColumnFinder(const TriangleMesh& mesh, Vec3 normal, Vec3 origin, double spacing) : mesh_(mesh), spacing_(spacing) {
        const PlaneFrame frame = frame_across(normal);
        points_.reserve(mesh.points.size());
        for (const Vec3& p : mesh.points) {
            points_.push_back({dot(frame.u, p - origin), dot(frame.v, p - origin), height(normal, p)});
        }
    }

    SolidColumns run() {
        find_grid();
        for (const Triangle& t : mesh_.triangles) add_triangle(t);
        std::sort(hits_.begin(), hits_.end(), [](const ColumnHit& a, const ColumnHit& b) {
            return a.column != b.column ? a.column < b.column : a.height < b.height;
        });
        pair_hits();
        return std::move(out_);
    }

 private:
    std::int32_t ceiling(double x) const { return static_cast<std::int32_t>(std::ceil(x / spacing_)); }
    std::int32_t floor(double x) const { return static_cast<std::int32_t>(std::floor(x / spacing_)); }

    void find_grid() {
        Rectangle2 all;
        for (const Projected& p : points_) all.include({p.x, p.y});
        if (points_.empty()) return;
        out_.first_i = ceiling(all.min.x);
        out_.first_j = ceiling(all.min.y);
        out_.count_i = std::max(0, floor(all.max.x) - out_.first_i + 1);
        out_.count_j = std::max(0, floor(all.max.y) - out_.first_j + 1);
    }

    void add_triangle(const Triangle& t) {
        const std::array<Projected, 3> c{points_[t[0]], points_[t[1]], points_[t[2]]};
        const auto [low_x, high_x] = std::minmax({c[0].x, c[1].x, c[2].x});
        const std::int32_t first_i = ceiling(low_x);
        const std::int32_t last_i = floor(high_x);
        if (first_i > last_i) return;
        const auto [low_y, high_y] = std::minmax({c[0].y, c[1].y, c[2].y});
        const std::int32_t last_j = floor(high_y);
        for (std::int32_t j = ceiling(low_y); j <= last_j; ++j) {
            for (std::int32_t i = first_i; i <= last_i; ++i) {
                const Point2 at{i * spacing_, j * spacing_};
                bool is_inside = false;
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::size_t next = (k + 1) % 3;
                    const bool is_in_order = t[k] < t[next];
                    is_inside ^= is_before_edge(at, is_in_order ? c[k] : c[next], is_in_order ? c[next] : c[k]);
                }
                if (is_inside) hits_.push_back({column(i, j), height_at(at, c)});
            }
        }
    }

    std::uint32_t column(std::int32_t i, std::int32_t j) const {
        return static_cast<std::uint32_t>(out_.index(i - out_.first_i, j - out_.first_j));
    }

    void pair_hits() {
        const auto count = static_cast<std::size_t>(out_.count_i) * static_cast<std::size_t>(out_.count_j);
        out_.first.reserve(count + 1);
        std::size_t next = 0;
        for (std::uint32_t c = 0; c < count; ++c) {
            out_.first.push_back(static_cast<std::uint32_t>(out_.solid.size()));
            for (; next + 1 < hits_.size() && hits_[next].column == c && hits_[next + 1].column == c; next += 2) {
                if (hits_[next].height < hits_[next + 1].height)
                    out_.solid.push_back({hits_[next].height, hits_[next + 1].height});
            }
        }
        out_.first.push_back(static_cast<std::uint32_t>(out_.solid.size()));
    }

    const TriangleMesh& mesh_;
    double spacing_;
    std::vector<Projected> points_;
    std::vector<ColumnHit> hits_;
    SolidColumns out_;
};

std::span<const HeightRange> solid_at(const SolidColumns& columns, std::int32_t i, std::int32_t j) {
    if (i < 0 || j < 0 || i >= columns.count_i || j >= columns.count_j) return {};
    const std::size_t c = columns.index(i, j);
    return std::span(columns.solid).subspan(columns.first[c], columns.first[c + 1] - columns.first[c]);
}

void intersect(std::vector<HeightRange>& ranges, std::span<const HeightRange> others,
               std::vector<HeightRange>& scratch) {
    scratch.clear();
    std::size_t k = 0;
    for (const HeightRange& r : ranges) {
        while (k < others.size() && others[k].high < r.low) ++k;
        for (std::size_t o = k; o < others.size() && others[o].low <= r.high; ++o) {
            scratch.push_back({std::max(r.low, others[o].low), std::min(r.high, others[o].high)});
        }
    }
    ranges.swap(scratch);
}

}  // namespace

SolidColumns solid_columns(const TriangleMesh& mesh, Vec3 normal, Vec3 origin, double spacing) {
    return ColumnFinder(mesh, normal, origin, spacing).run();
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
    std::vector<HeightRange> ranges;
    std::vector<HeightRange> scratch;
    for (std::int32_t j = 0; j < columns.count_j; ++j) {
        for (std::int32_t i = 0; i < columns.count_i; ++i) {
            ranges.clear();
            for (const HeightRange& r : solid_at(columns, i, j)) {
                if (r.high - r.low >= 2 * shorter) ranges.push_back(r);
            }
            for (const auto& [di, dj] : around) {
                if (ranges.empty()) break;
                intersect(ranges, solid_at(columns, i + di, j + dj), scratch);
            }
            for (const HeightRange& r : ranges) {
                if (r.high - r.low >= 2 * shorter)
                    sites.push_back({columns.first_i + i, columns.first_j + j, {r.low + shorter, r.high - shorter}});
            }
        }
    }
    return sites;
}

}  // namespace qchopper
