// Triangles of the cap that lie on one side of a plane are added up in the order of their heights, from both ends, so
// that the sums of a plane do not depend on the others; those that a plane crosses are clipped. Places become
// available, as planes go by, in the order of their heights; of each row the first and the last one are kept. Per
// normal O(n log n) in the triangles of the cap and its places, and O(1) for each triangle that a plane crosses.

#include "segment/objectives/old_joints.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "segment/mesh/plane_frame.h"
#include "segment/mesh/plane_section.h"
#include "segment/objectives/dowel_columns.h"

namespace qchopper {
namespace {

constexpr double flush = 1e-6;  // of the depth of a hole: as near to the cap a column begins at it

// Those where a dowel stands in the cap whose columns rise along `up` from `height`.
std::vector<OldJoint::Place> places_on(const SolidColumns& columns, const PlaneFrame& frame, Vec3 origin_on_cap,
                                       double cap_height, const ConnectorOptions& options) {
    const double reach = options.clearance() / options.spacing;
    const auto most = static_cast<std::int32_t>(std::floor(reach));
    const double depth = options.depth + options.wall;
    const SolidLines& map = columns.map;
    std::vector<std::uint8_t> is_deep(map.columns * map.rows, 0);
    for (std::size_t line = 0; line < is_deep.size(); ++line) {
        for (const SolidSpan& d : map.at(line)) {
            if (std::abs(d.low - cap_height) <= flush * depth && d.high - d.low >= depth) is_deep[line] = 1;
        }
    }
    const auto count_i = static_cast<std::int32_t>(map.columns);
    const auto count_j = static_cast<std::int32_t>(map.rows);
    const auto is_deep_at = [&](std::int32_t i, std::int32_t j) {
        if (i < 0 || j < 0 || i >= count_i || j >= count_j) return false;
        return is_deep[static_cast<std::size_t>(j) * map.columns + static_cast<std::size_t>(i)] != 0;
    };
    // Not by marked_within(): a line beside the map is not deep, and it is not in the map.
    const auto fits = [&](std::int32_t i, std::int32_t j) {
        for (std::int32_t dj = -most; dj <= most; ++dj) {
            for (std::int32_t di = -most; di <= most; ++di) {
                if (di * di + dj * dj <= reach * reach && !is_deep_at(i + di, j + dj)) return false;
            }
        }
        return true;
    };
    std::vector<OldJoint::Place> places;
    for (std::int32_t j = 0; j < count_j; ++j) {
        for (std::int32_t i = 0; i < count_i; ++i) {
            if (!is_deep_at(i, j) || !fits(i, j)) continue;
            const Point2 flat{(columns.first_i + i) * options.spacing, (columns.first_j + j) * options.spacing};
            places.push_back({flat, origin_on_cap + flat.x * frame.u + flat.y * frame.v});
        }
    }
    return places;
}

// The part of a triangle of the cap on one side of a plane.
void add_clipped(const std::array<OldJoint::Corner, 3>& t, const std::array<double, 3>& h, double offset, bool above,
                 double& area, Extent16& extent) {
    std::array<Point2, 4> part;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if ((h[k] >= offset) == above) part[count++] = t[k].flat;
        if ((h[k] >= offset) == (h[next] >= offset)) continue;
        const double share = (offset - h[k]) / (h[next] - h[k]);
        part[count++] = {t[k].flat.x + share * (t[next].flat.x - t[k].flat.x),
                         t[k].flat.y + share * (t[next].flat.y - t[k].flat.y)};
    }
    for (std::size_t k = 2; k < count; ++k) area += std::abs(orientation(part[0], part[k - 1], part[k])) / 2;
    for (std::size_t k = 0; k < count; ++k) extent.include(part[k]);
}

struct AreaAndExtent {
    double area = 0;
    Extent16 extent;
    void add(const AreaAndExtent& b) {
        area += b.area;
        extent.include(b.extent);
    }
};

// Areas and extents of both sides of every plane.
void part_cap(const OldJoint& joint, Vec3 normal, std::span<const double> offsets,
              std::vector<std::array<AreaAndExtent, 2>>& sides) {
    std::vector<std::pair<double, AreaAndExtent>> by_low;  // whole triangles, by their lowest corner
    std::vector<std::pair<double, AreaAndExtent>> by_high;
    for (const auto& t : joint.triangles) {
        const std::array<double, 3> h{height(normal, t[0].point), height(normal, t[1].point),
                                      height(normal, t[2].point)};
        const auto [low, high] = std::minmax({h[0], h[1], h[2]});
        const auto slab = [&](double at) {
            return static_cast<std::size_t>(std::upper_bound(offsets.begin(), offsets.end(), at) - offsets.begin());
        };
        const std::size_t first = slab(low);
        const std::size_t last = slab(high);
        AreaAndExtent whole;
        add_clipped(t, h, low, true, whole.area, whole.extent);
        by_low.emplace_back(low, whole);
        by_high.emplace_back(high, whole);
        for (std::size_t plane = first; plane < last; ++plane) {
            for (const bool above : {true, false}) {
                AreaAndExtent& side = sides[plane][above ? 0 : 1];
                add_clipped(t, h, offsets[plane], above, side.area, side.extent);
            }
        }
    }
    std::stable_sort(by_low.begin(), by_low.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::stable_sort(by_high.begin(), by_high.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    AreaAndExtent above;
    auto next = by_low.begin();
    for (std::size_t plane = offsets.size(); plane-- > 0;) {
        for (; next != by_low.end() && next->first >= offsets[plane]; ++next) above.add(next->second);
        sides[plane][0].add(above);
    }
    AreaAndExtent below;
    next = by_high.begin();
    for (std::size_t plane = 0; plane < offsets.size(); ++plane) {
        for (; next != by_high.end() && next->first < offsets[plane]; ++next) below.add(next->second);
        sides[plane][1].add(below);
    }
}

// Of each row the first and the last place that are left.
class RowEnds {
 public:
    void add(Point2 p) {
        const auto [row, is_new] = ends_.try_emplace(p.y, p.x, p.x);
        if (is_new) return;
        row->second.first = std::min(row->second.first, p.x);
        row->second.second = std::max(row->second.second, p.x);
    }
    std::vector<Point2> places() const {
        std::vector<Point2> all;
        for (const auto& [y, ends] : ends_) {
            all.push_back({ends.first, y});
            if (ends.second > ends.first) all.push_back({ends.second, y});
        }
        return all;
    }

 private:
    std::map<double, std::pair<double, double>> ends_;
};

}  // namespace

std::vector<OldJoint> old_joints(const Piece& piece, const ConnectorOptions& options) {
    std::vector<OldJoint> joints;
    const TriangleMesh& mesh = *piece.mesh;
    for (const HalfSpace& half_space : piece.half_spaces) {
        OldJoint joint;
        const Vec3 up = half_space.up();
        const PlaneFrame frame = frame_across(up);
        Vec3 origin;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            if (cap_of(mesh, t) != half_space.cut) continue;
            const std::array<Vec3, 3> corner = corners_of(mesh, t);
            if (joint.triangles.empty()) origin = corner[0];
            joint.triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k)
                joint.triangles.back()[k] = {flattened(frame, origin, corner[k]), corner[k]};
        }
        if (joint.triangles.empty()) continue;
        const SolidColumns columns = solid_columns(mesh, up, origin, options.spacing);
        joint.places = places_on(columns, frame, origin, height(up, origin), options);
        joints.push_back(std::move(joint));
    }
    return joints;
}

std::vector<std::array<JointMeasure, 2>> parted(const OldJoint& joint, Vec3 normal, std::span<const double> offsets,
                                                const ConnectorOptions& options) {
    std::vector<std::array<AreaAndExtent, 2>> sides(offsets.size());
    part_cap(joint, normal, offsets, sides);
    std::vector<std::array<JointMeasure, 2>> result(offsets.size());
    for (std::size_t plane = 0; plane < offsets.size(); ++plane) {
        for (std::size_t side = 0; side < 2; ++side) {
            result[plane][side].area_mm2 = sides[plane][side].area;
            result[plane][side].diameter = sides[plane][side].extent.largest();
        }
    }
    std::vector<std::pair<double, Point2>> by_height;
    for (const OldJoint::Place& place : joint.places) by_height.emplace_back(height(normal, place.point), place.flat);
    std::stable_sort(by_height.begin(), by_height.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    const double clearance = options.clearance();
    RowEnds below;
    auto next = by_height.begin();
    for (std::size_t plane = 0; plane < offsets.size(); ++plane) {
        for (; next != by_height.end() && next->first <= offsets[plane] - clearance; ++next) below.add(next->second);
        result[plane][1].places = below.places();
    }
    RowEnds above;
    auto last = by_height.rbegin();
    for (std::size_t plane = offsets.size(); plane-- > 0;) {
        for (; last != by_height.rend() && last->first >= offsets[plane] + clearance; ++last) above.add(last->second);
        result[plane][0].places = above.places();
    }
    return result;
}

}  // namespace qchopper
