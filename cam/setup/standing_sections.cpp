// One pass over the triangles of the lowest third per height. Points below a section are united along the edges below
// it, from height to height, so that each crossed triangle knows whether its part of the surface reaches the base.
// O(heights * triangles of the lowest third + crossings log crossings).

#include "cam/setup/standing_sections.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/footprint.h"

namespace qchopper {
namespace {

constexpr int heights = 12;
constexpr double highest_share = 1.0 / 3;  // of the piece's height
constexpr double contact = 0.1;            // mm; what lies lower touches the spoil layer
constexpr double step_of_stand = 5;        // mm; a stand is so much wider at a time

Point2 minus(Point2 a, Point2 b) {
    return {a.x - b.x, a.y - b.y};
}

// Integrals over a region of 1, x, y, x^2, x y and y^2, and its outline.
struct AreaMoments {
    double area = 0;
    double x = 0;
    double y = 0;
    double xx = 0;
    double xy = 0;
    double yy = 0;
    std::vector<Point2> outline;

    // An edge that runs counter-clockwise around the region: its triangle with the origin.
    void add_edge(Point2 p, Point2 q) {
        const double twice = p.x * q.y - q.x * p.y;
        area += twice / 2;
        x += (p.x + q.x) * twice / 6;
        y += (p.y + q.y) * twice / 6;
        xx += (p.x * p.x + p.x * q.x + q.x * q.x) * twice / 12;
        yy += (p.y * p.y + p.y * q.y + q.y * q.y) * twice / 12;
        xy += (2 * p.x * p.y + p.x * q.y + q.x * p.y + 2 * q.x * q.y) * twice / 24;
        outline.push_back(p);
        outline.push_back(q);
    }
    // A square, small beside the region: its own second moments are left out.
    void add_square(Point2 p, double mm2) {
        area += mm2;
        x += p.x * mm2;
        y += p.y * mm2;
        xx += p.x * p.x * mm2;
        xy += p.x * p.y * mm2;
        yy += p.y * p.y * mm2;
        outline.push_back(p);
    }
    void add(const AreaMoments& other) {
        area += other.area;
        x += other.x;
        y += other.y;
        xx += other.xx;
        xy += other.xy;
        yy += other.yy;
        outline.insert(outline.end(), other.outline.begin(), other.outline.end());
    }
};

// Of a polygon, its corners counter-clockwise: a narrowest strip around it lies along one of its sides (M. E. Houle and
// G. T. Toussaint, "Computing the width of a set", 1988).
double smallest_width(const std::vector<Point2>& hull) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Point2 a = hull[i];
        const Point2 side = minus(hull[(i + 1) % hull.size()], a);
        double most = 0;
        double min_beside = 0;  // less than 0 only where a side is so short that rounding turns it
        for (const Point2 p : hull) {
            const double beside = side.x * (p.y - a.y) - side.y * (p.x - a.x);
            most = std::max(most, beside);
            min_beside = std::min(min_beside, beside);
        }
        least = std::min(least, (most - min_beside) / std::hypot(side.x, side.y));
    }
    return least;
}

StandingSection measured(const AreaMoments& sums, double z) {
    StandingSection section;
    section.z = z;
    const std::vector<Point2> hull = convex_hull(sums.outline);
    if (!(sums.area > 0) || hull.size() < 3) return section;
    const Point2 c{sums.x / sums.area, sums.y / sums.area};
    const double xx = sums.xx - sums.area * c.x * c.x;
    const double xy = sums.xy - sums.area * c.x * c.y;
    const double yy = sums.yy - sums.area * c.y * c.y;
    const double determinant = xx * yy - xy * xy;
    if (!(xx > 0) || !(yy > 0) || !(determinant > 0)) return section;
    double largest = 0;  // |J^-1 p|
    for (const Point2 corner : hull) {
        const Point2 p = minus(corner, c);
        largest = std::max(largest, std::hypot(yy * p.x - xy * p.y, xx * p.y - xy * p.x) / determinant);
        section.reach = std::max(section.reach, std::hypot(p.x, p.y));
    }
    section.area_mm2 = sums.area;
    section.centroid = c;
    section.modulus_mm3 = 1 / largest;
    section.width = smallest_width(hull);
    return section;
}

// The lowest part of a piece as it lies.
class LowPart {
 public:
    LowPart(const TriangleMesh& mesh, const Setup& setup, double top)
        : mesh_(mesh), pose_(setup.piece_in_setup), below_(mesh.points.size()) {
        z_.reserve(mesh.points.size());
        for (const Vec3& p : mesh.points) z_.push_back(dot(pose_.row[2], p) + pose_.shift.z);
        for (std::uint32_t v = 0; v < z_.size(); ++v) {
            if (z_[v] <= contact) touching_.push_back(v);
        }
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto [a, b, c] = mesh.triangles[t];
            if (std::min({z_[a], z_[b], z_[c]}) <= top) triangles_.push_back(t);
        }
    }

    // The flat side on which the piece lies. Its triangles face down, so they run clockwise.
    AreaMoments base() const {
        AreaMoments sums;
        for (const std::uint32_t t : triangles_) {
            const auto [a, b, c] = mesh_.triangles[t];
            if (std::max({z_[a], z_[b], z_[c]}) > contact) continue;
            const std::array<Point2, 3> p{flat(a), flat(b), flat(c)};
            for (std::size_t k = 0; k < 3; ++k) sums.add_edge(p[(k + 1) % 3], p[k]);
        }
        return sums;
    }

    // At a height above those that were asked before.
    AreaMoments section_at(double z) {
        unite_below(z);
        std::map<std::uint32_t, AreaMoments> parts;  // by the part of the surface below
        for (const std::uint32_t t : triangles_) add_crossing(t, z, parts);
        std::vector<std::uint32_t> standing;
        for (const std::uint32_t v : touching_) standing.push_back(below_.root(v));
        std::sort(standing.begin(), standing.end());
        AreaMoments sums;
        for (const auto& [root, part] : parts) {
            // A closed surface below with material outside of it is a cavity, and takes material away.
            if (part.area < 0 || std::binary_search(standing.begin(), standing.end(), root)) sums.add(part);
        }
        return sums;
    }

 private:
    void unite_below(double z) {
        for (const std::uint32_t t : triangles_) {
            const Triangle& corners = mesh_.triangles[t];
            for (std::size_t k = 0; k < 3; ++k) {
                const double upper = std::max(z_[corners[k]], z_[corners[(k + 1) % 3]]);
                if (upper >= united_ && upper < z) below_.unite(corners[k], corners[(k + 1) % 3]);
            }
        }
        united_ = z;
    }

    void add_crossing(std::uint32_t t, double z, std::map<std::uint32_t, AreaMoments>& parts) {
        const Triangle& corners = mesh_.triangles[t];
        Point2 start;
        Point2 end;
        std::uint32_t lower = 0;
        int crossed = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = corners[k];
            const std::uint32_t to = corners[(k + 1) % 3];
            if ((z_[from] >= z) == (z_[to] >= z)) continue;
            const bool runs_up = z_[to] >= z;
            // Seen from above the loop runs from the edge that goes down through the plane to the one that goes up.
            (runs_up ? end : start) = crossing(runs_up ? to : from, runs_up ? from : to, z);
            lower = runs_up ? from : to;
            ++crossed;
        }
        if (crossed == 2) parts[below_.root(lower)].add_edge(start, end);
    }

    Point2 flat(std::uint32_t v) const {
        const Vec3& p = mesh_.points[v];
        return {dot(pose_.row[0], p) + pose_.shift.x, dot(pose_.row[1], p) + pose_.shift.y};
    }

    // From the upper end, so that both triangles at the edge get the same point.
    Point2 crossing(std::uint32_t upper, std::uint32_t lower, double z) const {
        const double f = (z_[upper] - z) / (z_[upper] - z_[lower]);
        const Point2 a = flat(upper);
        const Point2 b = flat(lower);
        return {a.x + f * (b.x - a.x), a.y + f * (b.y - a.y)};
    }

    const TriangleMesh& mesh_;
    const Pose& pose_;
    std::vector<double> z_;                 // per point
    std::vector<std::uint32_t> touching_;   // points
    std::vector<std::uint32_t> triangles_;  // of the lowest part, ascending
    DisjointSets below_;
    double united_ = -std::numeric_limits<double>::infinity();
};

void add_stock(const StockPoints& stock_points, double z, AreaMoments& sums) {
    for (const Point2 p : stock_points.standing_up_to(z)) sums.add_square(p, stock_points.column_mm2());
}

// The force at the top of the piece at which a section breaks.
double breaking_force(const StandingSection& section, double strength, double height) {
    return strength * section.modulus_mm3 / (height - section.z);
}

// Of the spread of the base through the spoil layer (workholding.h).
double joint_force(const StandingSection& base, const Setup& setup, const Workholding& check) {
    if (!(base.reach > 0)) return 0;
    const Box block = setup.block_box();
    const Vec3 low = setup.box.min - block.min;
    const Vec3 high = block.max - setup.box.max;
    const double spread = std::max(0.0, std::min({setup.spoil, low.x, low.y, high.x, high.y}));
    const double k = 1 + spread / base.reach;
    return check.holding.strength * k * k * k * base.modulus_mm3 / (check.height + setup.spoil);
}

// Of the whole block on its underside, the force at its top edge: J of a rectangle, at its corner.
double block_force(Vec3 block, double strength) {
    return strength * block.x * block.y / (6 * std::hypot(1 / block.x, 1 / block.y) * block.z);
}

// Up to a section from which on the piece holds itself; as wide as tape or glue and the slenderness ask, where the
// modulus of a square across its diagonal is a^3 / (6 sqrt 2); and so high that the load spreads over it at 45 degrees.
std::optional<HoldingStand> stand_for(const std::vector<StandingSection>& sections, const Setup& setup,
                                      const Workholding& check) {
    const Holding& holding = check.holding;
    std::size_t lowest = sections.size();
    while (lowest > 1) {
        const StandingSection& section = sections[lowest - 1];
        const bool holds = breaking_force(section, check.foam_strength, check.height) >= holding.cutting_force &&
                           check.height - section.z <= holding.max_slenderness * section.width;
        if (!holds) break;
        --lowest;
    }
    const double moment = holding.cutting_force * (check.height + setup.spoil);
    for (; lowest < sections.size(); ++lowest) {
        const StandingSection& section = sections[lowest];
        const double side = std::max({std::cbrt(6 * std::numbers::sqrt2 * moment / holding.strength),
                                      check.height / holding.max_slenderness, 2 * section.reach});
        if (section.z + setup.spoil < (side - section.width) / 2) continue;
        return HoldingStand{section.z, step_of_stand * std::ceil(side / step_of_stand - 1e-9), section.centroid.x,
                            section.centroid.y};
    }
    return std::nullopt;
}

}  // namespace

std::vector<StandingSection> standing_sections(const TriangleMesh& mesh, const Setup& setup,
                                               const StockPoints* stock_points) {
    assert(!mesh.points.empty());
    const double top = highest_share * setup.box.max.z;
    LowPart part(mesh, setup, top);
    std::vector<StandingSection> sections;
    for (int k = 0; k <= heights; ++k) {
        const double z = top * k / heights;
        AreaMoments sums = k == 0 ? part.base() : part.section_at(z);
        if (stock_points != nullptr) add_stock(*stock_points, z, sums);
        sections.push_back(measured(sums, z));
    }
    return sections;
}

Workholding check_workholding(const std::vector<StandingSection>& sections, const Setup& setup, const Cell& cell) {
    assert(!sections.empty() && cell.machine && setup.block.stock < cell.stock.size());
    Workholding check;
    check.holding = cell.machine->holding;
    check.foam_strength = bending_strength(cell.stock[setup.block.stock]);
    check.height = setup.box.max.z;
    const StandingSection& base = sections.front();
    check.base_mm2 = base.area_mm2;
    check.base_width = base.width;
    check.joint_force =
        std::min(joint_force(base, setup, check), block_force(setup.block.size, check.holding.strength));
    const auto force_of = [&](const StandingSection& s) {
        return breaking_force(s, check.foam_strength, check.height);
    };
    const auto narrowest =
        std::min_element(sections.begin(), sections.end(),
                         [&](const StandingSection& a, const StandingSection& b) { return force_of(a) < force_of(b); });
    check.foam_force = force_of(*narrowest);
    check.narrowest_z = narrowest->z;
    check.narrowest_mm2 = narrowest->area_mm2;
    if (!check.passes()) check.stand = stand_for(sections, setup, check);
    return check;
}

}  // namespace qchopper
