// Sites of all planes come from one set of columns (dowel_columns.h). Those of a plane are told apart by the regions
// that the rows of the grid cross; of each row only the first and the last one of a joint are kept. The farthest two
// are corners of the hull (A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions, 1979).

#include "segment/score/connector_sweep.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

#include "segment/score/section_rows.h"

namespace qchopper {
namespace {

constexpr double least_diameters_apart = 3;
constexpr double tolerated_ratio = 10;  // T_C
constexpr double largest_ratio = 100;

// The corners of the hull, counter-clockwise. `points` ascend in y; those of equal y in x.
std::vector<Point2> hull_of(std::span<const Point2> points) {
    std::vector<Point2> hull;
    const auto add = [&](Point2 p, std::size_t least) {
        while (hull.size() >= least + 2 && orientation(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
        hull.push_back(p);
    };
    for (const Point2 p : points) add(p, 0);
    const std::size_t least = hull.empty() ? 0 : hull.size() - 1;
    for (std::size_t i = points.size(); i-- > 0;) add(points[i], least);
    if (hull.size() > 1) hull.pop_back();  // the first one again
    return hull;
}

double distance(Point2 a, Point2 b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

double farthest_two(std::span<const Point2> places) {
    const std::vector<Point2> hull = hull_of(places);
    double farthest = 0;
    for (std::size_t a = 0; a < hull.size(); ++a) {
        for (std::size_t b = a + 1; b < hull.size(); ++b) farthest = std::max(farthest, distance(hull[a], hull[b]));
    }
    return farthest;
}

// The area of the hull of discs of this radius.
double disc_hull_mm2(std::span<const Point2> places, double radius) {
    const std::vector<Point2> hull = hull_of(places);
    if (hull.empty()) return 0;
    double area = std::numbers::pi * radius * radius;
    for (std::size_t a = 0; a < hull.size(); ++a) {
        const Point2 p = hull[a];
        const Point2 q = hull[(a + 1) % hull.size()];
        area += (p.x * q.y - p.y * q.x) / 2 + radius * distance(p, q);
    }
    return area;
}

// The joints, or regions, of one plane while their places are added row by row.
class PlaneJoints {
 public:
    PlaneJoints(const SweptSections& s, std::size_t plane, const ConnectorOptions& options)
        : s_(s), options_(options), joint_of_loop_(s.section.loops.size() == 0 ? 0 : count_of_loops(plane), none) {
        first_loop_ = s.section.first_loop[plane];
        std::map<std::array<std::uint32_t, 2>, std::size_t> known;
        for (const SectionRegion& region : s.regions[plane]) {
            if (region.area_mm2 < least_joint_mm2) continue;
            const std::array<std::uint32_t, 2> solids = options.form == ConnectorForm::spread
                                                            ? region.solid
                                                            : std::array{static_cast<std::uint32_t>(known.size()), 0U};
            const std::size_t joint = known.emplace(solids, joints_.size()).first->second;
            if (joint == joints_.size()) {
                joints_.emplace_back();
                extents_.emplace_back();
            }
            joints_[joint].area_mm2 += region.area_mm2;
            for (const std::size_t l : region.loops) joint_of_loop_[l - first_loop_] = joint;
            include(s.section.loops[region.loops.front()], extents_[joint]);
        }
        for (std::size_t k = 0; k < joints_.size(); ++k) joints_[k].diameter = extents_[k].largest();
        if (!joints_.empty()) rows_ = row_crossings(s.slabs, s.section, s.regions[plane], options.spacing);
    }

    bool is_empty() const { return joints_.empty(); }

    // Sites row by row, ascending in x.
    void add(std::int32_t i, std::int32_t j) {
        const Point2 at{i * options_.spacing, j * options_.spacing};
        while (next_ < rows_.size() && (rows_[next_].row < j || (rows_[next_].row == j && rows_[next_].x <= at.x)))
            ++next_;
        // In material an odd number of crossings of the row lies before the site.
        if (next_ == 0 || rows_[next_ - 1].row != j) return;
        const std::size_t joint = joint_of_loop_[rows_[next_ - 1].loop - first_loop_];
        if (joint == none) return;
        std::vector<Point2>& places = joints_[joint].places;
        const std::size_t n = places.size();
        if (n >= 2 && places[n - 1].y == at.y && places[n - 2].y == at.y)
            places.back() = at;
        else
            places.push_back(at);
    }

    double value() const { return connector_of(joints_, options_); }

 private:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::size_t count_of_loops(std::size_t plane) const {
        return s_.section.first_loop[plane + 1] - s_.section.first_loop[plane];
    }

    void include(const SectionLoop& loop, Extent16& extent) const {
        std::uint32_t i = loop.first_crossing;
        for (std::uint32_t n = 0; n < loop.points; ++n, i = s_.section.next[i]) extent.include(s_.slabs.point[i]);
    }

    const SweptSections& s_;
    const ConnectorOptions& options_;
    std::vector<std::size_t> joint_of_loop_;
    std::size_t first_loop_ = 0;
    std::vector<JointMeasure> joints_;
    std::vector<Extent16> extents_;
    std::vector<RowCrossing> rows_;
    std::size_t next_ = 0;
};

}  // namespace

void Extent16::include(Point2 p) {
    static const std::array<Point2, count> directions = [] {
        std::array<Point2, count> all;
        for (std::size_t k = 0; k < count; ++k) {
            const double angle = std::numbers::pi * static_cast<double>(k) / count;
            all[k] = {std::cos(angle), std::sin(angle)};
        }
        return all;
    }();
    for (std::size_t k = 0; k < count; ++k) {
        const double along = directions[k].x * p.x + directions[k].y * p.y;
        low_[k] = along < low_[k] ? along : low_[k];
        high_[k] = along > high_[k] ? along : high_[k];
    }
}

double Extent16::largest() const {
    double largest = 0;
    for (std::size_t k = 0; k < count; ++k) largest = std::max(largest, high_[k] - low_[k]);
    return largest;
}

double connector_of(std::span<const JointMeasure> joints, const ConnectorOptions& options) {
    double value = 0;
    double area = 0;
    for (const JointMeasure& joint : joints) {
        if (options.form == ConnectorForm::ratio) {
            const double held = disc_hull_mm2(joint.places, options.diameter / 2);
            value = std::max(value, held > 0 ? joint.area_mm2 / held - tolerated_ratio : largest_ratio);
            continue;
        }
        const double s = farthest_two(joint.places);
        value += joint.area_mm2 *
                 (s < least_diameters_apart * options.diameter ? 1 : std::max(0.0, 1 - 2 * s / joint.diameter));
        area += joint.area_mm2;
    }
    if (options.form == ConnectorForm::ratio) return std::min(value, largest_ratio);
    return area > 0 ? value / area : 0;
}

void add_connector(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                   const SweptSections& sections, const ConnectorOptions& options,
                   std::span<std::optional<CutEvaluation>> evaluations) {
    assert(evaluations.size() == offsets.size());
    const std::vector<DowelSite> sites =
        dowel_sites(solid_columns(*prepared.piece->mesh, normal, prepared.origin, options.spacing), options);
    std::vector<std::vector<std::uint32_t>> at_plane(offsets.size());
    for (std::uint32_t k = 0; k < sites.size(); ++k) {
        const auto from = std::lower_bound(offsets.begin(), offsets.end(), sites[k].offsets.low);
        for (auto o = from; o != offsets.end() && *o <= sites[k].offsets.high; ++o) {
            at_plane[static_cast<std::size_t>(o - offsets.begin())].push_back(k);
        }
    }
    for (std::size_t plane = 0; plane < offsets.size(); ++plane) {
        if (!evaluations[plane]) continue;
        PlaneJoints joints(sections, plane, options);
        if (joints.is_empty()) continue;
        for (const std::uint32_t k : at_plane[plane]) joints.add(sites[k].i, sites[k].j);
        evaluations[plane]->connector = joints.value();
    }
}

}  // namespace qchopper
