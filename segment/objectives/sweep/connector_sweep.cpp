// Sites of all planes come from one set of columns (dowel_columns.h). Those of a plane are told apart by the regions
// that the rows of the grid cross; of each row only the first and the last one of a joint are kept. The farthest two
// are corners of the hull (A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions, 1979).

#include "segment/objectives/sweep/connector_sweep.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "segment/objectives/dowel_columns.h"
#include "segment/objectives/sweep/section_rows.h"

namespace qchopper {
namespace {

// The joints, or regions, of one plane while their places are added row by row.
class PlaneJoints {
 public:
    PlaneJoints(const SweptSections& s, std::size_t plane, const ConnectorOptions& options)
        : s_(s), options_(options), joint_of_loop_(s.section.loops.size() == 0 ? 0 : count_of_loops(plane), none) {
        first_loop_ = s.section.first_loop[plane];
        std::map<std::array<std::uint32_t, 2>, std::size_t> known;
        for (const SectionRegion& region : s.regions[plane]) {
            if (region.area_mm2 < min_joint_mm2) continue;
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
        if (!joints_.empty()) rows_ = row_crossings(s.section, s.regions[plane], options.spacing);
    }

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

    const std::vector<JointMeasure>& joints() const { return joints_; }

 private:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::size_t count_of_loops(std::size_t plane) const {
        return s_.section.first_loop[plane + 1] - s_.section.first_loop[plane];
    }

    void include(const SectionLoop& loop, Extent16& extent) const {
        for (const Point2 p : s_.section.points(loop)) extent.include(p);
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
    std::vector<std::vector<std::array<JointMeasure, 2>>> old;
    for (const OldJoint& joint : prepared.old_joints) old.push_back(parted(joint, normal, offsets, options));
    for (std::size_t plane = 0; plane < offsets.size(); ++plane) {
        if (!evaluations[plane]) continue;
        PlaneJoints joints(sections, plane, options);
        for (const std::uint32_t k : at_plane[plane]) joints.add(sites[k].i, sites[k].j);
        std::vector<JointMeasure> all = joints.joints();
        for (const auto& sides : old) {
            for (const JointMeasure& side : sides[plane]) {
                if (side.area_mm2 >= min_joint_mm2) all.push_back(side);
            }
        }
        evaluations[plane]->connector = connector_of(all, options);
    }
}

}  // namespace qchopper
