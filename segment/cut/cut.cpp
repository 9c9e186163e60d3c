// Triangles are copied to their half; crossed ones are divided at the points of the section (plane_section.h), which
// both halves share; the caps triangulate its loops (cap.h). One pass over the triangles for each half:
// O(triangles), besides the caps.

#include "segment/cut/cut.h"

#include <algorithm>
#include <cassert>

#include "base/huge_pages.h"
#include "segment/cut/cap.h"
#include "segment/mesh/plane_section.h"

namespace qchopper {
namespace {

// Builds one half: its whole triangles, its parts of crossed triangles, its cap.
class HalfWriter {
 public:
    HalfWriter(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_above, bool above, std::size_t extra)
        : mesh_(mesh) {
        std::uint32_t count = 0;
        half_.number = huge(mesh.points.size(), no_parent);
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            if ((is_above[v] != 0) == above) half_.number[v] = count++;
        }
        reserve_huge(half_.mesh.points, count + extra);
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            if ((is_above[v] != 0) == above) half_.mesh.points.push_back(mesh.points[v]);
        }
        first_cap_point_ = count;
        const std::size_t triangles = 2 * count + 4 * extra;
        reserve_huge(half_.mesh.triangles, triangles);
        reserve_huge(half_.mesh.cap_of, triangles);
        reserve_huge(half_.parent, triangles);
    }

    void add_whole(std::uint32_t t) {
        const Triangle& v = mesh_.triangles[t];
        add({half_.number[v[0]], half_.number[v[1]], half_.number[v[2]]}, cap_of(mesh_, t), t);
    }

    // The part with the apex, or the four-sided part with the other corners.
    void add_part(const SectionTriangle& s, bool above) {
        const Triangle& v = mesh_.triangles[s.triangle];
        const auto [apex, apex_is_above] = s.crossing;
        const std::int32_t cap = cap_of(mesh_, s.triangle);
        const std::uint32_t exit = first_cap_point_ + s.exit_point;
        const std::uint32_t entry = first_cap_point_ + s.entry_point;
        // The cap points on the edges after and before the apex.
        const std::uint32_t after = apex_is_above ? exit : entry;
        const std::uint32_t before = apex_is_above ? entry : exit;
        if (apex_is_above == above) {
            add({half_.number[v[apex]], after, before}, cap, s.triangle);
        } else {
            const std::uint32_t next = half_.number[v[(apex + 1) % 3]];
            const std::uint32_t last = half_.number[v[(apex + 2) % 3]];
            add({after, next, last}, cap, s.triangle);
            add({after, last, before}, cap, s.triangle);
        }
    }

    Half finish(const PlaneSection& section, const CapTriangles& caps, bool above, std::int32_t cut_number) {
        half_.mesh.points.insert(half_.mesh.points.end(), section.points.begin(), section.points.end());
        half_.first_cap_triangle = half_.mesh.triangles.size();
        for (const auto& [a, b, c] : caps.triangles) {
            Triangle t{first_cap_point_ + a, first_cap_point_ + b, first_cap_point_ + c};
            if (above) std::swap(t[1], t[2]);  // the cap of the upper half faces down
            add(t, cut_number, no_parent);
        }
        return std::move(half_);
    }

 private:
    void add(const Triangle& t, std::int32_t cap, std::uint32_t parent) {
        half_.mesh.triangles.push_back(t);
        half_.mesh.cap_of.push_back(cap);
        half_.parent.push_back(parent);
        if (mesh_.ignored.empty()) return;
        half_.mesh.ignored.push_back(parent != no_parent && is_ignored(mesh_, parent) ? 1 : 0);
    }

    const TriangleMesh& mesh_;
    std::uint32_t first_cap_point_ = 0;
    Half half_;
};

struct CappedSection {
    PlaneSection section;
    CapTriangles caps;
    double area_mm2 = 0;
};

std::vector<Point2> flat_points(const std::vector<Vec3>& points, Vec3 normal, Vec3 origin) {
    const PlaneFrame frame = frame_across(normal);
    std::vector<Point2> flat;
    flat.reserve(points.size());
    for (const Vec3& p : points) flat.push_back(flattened(frame, origin, p));
    return flat;
}

std::optional<CappedSection> capped_section(const TriangleMesh& mesh, const Plane& plane,
                                            const std::vector<std::uint8_t>& is_above) {
    CappedSection result;
    result.section = plane_section(mesh, plane, is_above);
    const auto& [triangles, points, loops] = result.section;
    if (triangles.empty()) return std::nullopt;
    const std::vector<Point2> flat = flat_points(points, plane.normal, points.front());
    for (const Loop& loop : loops) result.area_mm2 += signed_area(flat, loop);
    const std::vector<Loop> kept = capped(loops);
    // Nested in the coordinates of the sweep, to the last bit, so that the cut has the regions that the sweep
    // evaluates.
    const std::vector<CapRegion> regions = nest_polygons(flat_points(points, plane.normal, mesh.points.front()), kept);
    result.caps = triangulate_regions(flat, kept, regions);
    return result;
}

}  // namespace

std::optional<CutHalves> cut(const TriangleMesh& mesh, const Plane& plane, std::int32_t cut_number) {
    assert(is_consistent(mesh) && cut_number != no_cap);
    const std::vector<std::uint8_t> is_above = points_above(mesh, plane);
    const std::optional<CappedSection> capped = capped_section(mesh, plane, is_above);
    if (!capped) return std::nullopt;
    const PlaneSection& section = capped->section;
    CutHalves result;
    result.loops = section.loops.size();
    result.forced_regions = capped->caps.forced_regions;
    result.cap_area_mm2 = capped->area_mm2;
    HalfWriter above(mesh, is_above, true, section.points.size());
    HalfWriter below(mesh, is_above, false, section.points.size());
    std::size_t next_crossed = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (next_crossed < section.triangles.size() && section.triangles[next_crossed].triangle == t) {
            const SectionTriangle& s = section.triangles[next_crossed++];
            above.add_part(s, true);
            below.add_part(s, false);
        } else {
            (is_above[mesh.triangles[t][0]] != 0 ? above : below).add_whole(t);
        }
    }
    assert(next_crossed == section.triangles.size());
    result.above = above.finish(section, capped->caps, true, cut_number);
    result.below = below.finish(section, capped->caps, false, cut_number);
    assert(is_consistent(result.above.mesh) && is_consistent(result.below.mesh));
    assert(result.above.parent.size() == result.above.mesh.triangles.size());
    assert(result.below.parent.size() == result.below.mesh.triangles.size());
    assert(result.above.mesh.triangles.size() - result.above.first_cap_triangle == capped->caps.triangles.size());
    return result;
}

std::size_t crossing_regions(const TriangleMesh& mesh, const Plane& plane) {
    const std::optional<CappedSection> capped = capped_section(mesh, plane, points_above(mesh, plane));
    return capped ? capped->caps.forced_regions : 0;
}

}  // namespace qchopper
