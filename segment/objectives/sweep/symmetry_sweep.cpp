// The rows of a grid are cut to what lies in the section; then all pairs of points.

#include "segment/objectives/sweep/symmetry_sweep.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "segment/objectives/sweep/section_rows.h"

namespace qchopper {

std::vector<Vec3> points_in_section(const PreparedPiece& prepared, const Plane& plane, const SweptSections& sections,
                                    std::size_t index, double area_mm2) {
    std::vector<Vec3> points;
    if (!(area_mm2 > 0)) return points;
    const double spacing = std::sqrt(area_mm2 / section_points);
    const std::vector<RowCrossing> rows = row_crossings(sections.section, sections.regions[index], spacing);
    const PlaneFrame frame = frame_across(plane.normal);
    const Vec3 origin = prepared.origin + (plane.offset - height(plane.normal, prepared.origin)) * plane.normal;
    for (std::size_t i = 0; i + 1 < rows.size(); i += 2) {
        assert(rows[i].row == rows[i + 1].row);
        for (double k = std::ceil(rows[i].x / spacing); k * spacing < rows[i + 1].x; ++k) {
            points.push_back(origin + (k * spacing) * frame.u + (rows[i].row * spacing) * frame.v);
        }
    }
    return points;
}

namespace {

// O(points squared).
double asymmetry_mm(std::span<const Vec3> points, const Plane& symmetry) {
    if (points.empty()) return 0;
    std::vector<double> least(points.size(), std::numeric_limits<double>::infinity());
    for (const Vec3& point : points) {
        const Vec3 q = point - (2 * (height(symmetry.normal, point) - symmetry.offset)) * symmetry.normal;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double x = points[i].x - q.x;
            const double y = points[i].y - q.y;
            const double z = points[i].z - q.z;
            const double square = x * x + y * y + z * z;
            least[i] = square < least[i] ? square : least[i];
        }
    }
    double sum = 0;
    for (const double square : least) sum += square;
    return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace

void add_symmetry(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                  const SweptSections& sections, const Plane& symmetry,
                  std::span<std::optional<CutEvaluation>> evaluations) {
    for (std::size_t j = 0; j < offsets.size(); ++j) {
        if (!evaluations[j]) continue;
        const std::vector<Vec3> points =
            points_in_section(prepared, {normal, offsets[j]}, sections, j, evaluations[j]->cap_area_mm2);
        evaluations[j]->symmetry_mm = asymmetry_mm(points, symmetry);
    }
}

}  // namespace qchopper
