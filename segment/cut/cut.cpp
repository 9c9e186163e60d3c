#include "segment/cut/cut.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "base/error.h"
#include "base/huge_pages.h"
#include "segment/cut/cap.h"
#include "segment/mesh/plane_frame.h"

namespace qchopper {
namespace {

// A triangle that the plane crosses: the surface leaves it downwards through one edge and enters through another.
struct Straddler {
    std::uint32_t triangle;
    std::uint32_t lone;  // corner (0..2) that is alone on its side
    bool lone_is_above;
    std::uint32_t exit_point = 0;   // cap point on the edge that runs from above to below
    std::uint32_t entry_point = 0;  // cap point on the edge that runs from below to above
};

// One crossing of the plane by an edge, named by the end above and the end below: the same from both triangles.
struct Crossing {
    std::uint64_t edge;
    std::uint32_t straddler;
    bool operator<(const Crossing& b) const { return edge != b.edge ? edge < b.edge : straddler < b.straddler; }
};

std::uint64_t edge_name(std::uint32_t above, std::uint32_t below) {
    return (static_cast<std::uint64_t>(above) << 32) | below;
}

struct Section {
    std::vector<Straddler> straddlers;
    std::vector<Vec3> points;         // in space, mm
    std::vector<std::uint32_t> next;  // per straddler: the one that the surface enters next
};

std::vector<Straddler> find_straddlers(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_above) {
    std::vector<Straddler> straddlers;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& v = mesh.triangles[t];
        const int above = is_above[v[0]] + is_above[v[1]] + is_above[v[2]];
        if (above == 0 || above == 3) continue;
        const bool lone_is_above = above == 1;
        std::uint32_t lone = 0;
        while ((is_above[v[lone]] != 0) != lone_is_above) ++lone;
        assert(lone < 3);
        straddlers.push_back({t, lone, lone_is_above});
    }
    return straddlers;
}

[[noreturn]] void throw_open(Vec3 at) {
    const auto text = [](double x) { return std::to_string(x); };
    throw InputError(InputFault::mesh,
                     "the mesh is open where the cut passes, near " + text(at.x) + " " + text(at.y) + " " + text(at.z),
                     "repair the scan first");
}

// Pairs the two triangles at each crossed edge and computes its point once, from the upper end to the lower.
Section find_section(const TriangleMesh& mesh, const Plane& plane, std::vector<Straddler> straddlers) {
    Section section;
    section.straddlers = std::move(straddlers);
    const std::size_t count = section.straddlers.size();
    std::vector<Crossing> exits(count);
    std::vector<Crossing> entries(count);
    for (std::uint32_t s = 0; s < count; ++s) {
        const Straddler& straddler = section.straddlers[s];
        const Triangle& v = mesh.triangles[straddler.triangle];
        const std::uint32_t lone = v[straddler.lone];
        const std::uint32_t next = v[(straddler.lone + 1) % 3];
        const std::uint32_t last = v[(straddler.lone + 2) % 3];
        exits[s] = {straddler.lone_is_above ? edge_name(lone, next) : edge_name(last, lone), s};
        entries[s] = {straddler.lone_is_above ? edge_name(lone, last) : edge_name(next, lone), s};
    }
    std::sort(exits.begin(), exits.end());
    std::sort(entries.begin(), entries.end());
    section.points.resize(count);
    section.next.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 upper = mesh.points[exits[i].edge >> 32];
        const Vec3 lower = mesh.points[exits[i].edge & 0xFFFFFFFFU];
        if (exits[i].edge != entries[i].edge) throw_open(upper);
        const double from = height(plane.normal, upper);
        const double to = height(plane.normal, lower);
        section.points[i] = upper + ((from - plane.offset) / (from - to)) * (lower - upper);
        section.straddlers[exits[i].straddler].exit_point = i;
        section.straddlers[entries[i].straddler].entry_point = i;
        section.next[exits[i].straddler] = entries[i].straddler;
    }
    return section;
}

// The loops of the section, counter-clockwise around material seen against the normal. The surface is followed from
// above to below, which runs clockwise: hence the reversal.
std::vector<Loop> trace_loops(const Section& section) {
    std::vector<Loop> loops;
    std::vector<bool> done(section.straddlers.size(), false);
    for (std::uint32_t start = 0; start < section.straddlers.size(); ++start) {
        if (done[start]) continue;
        Loop loop;
        for (std::uint32_t s = start; !done[s]; s = section.next[s]) {
            done[s] = true;
            loop.push_back(section.straddlers[s].exit_point);
        }
        assert(!loop.empty());
        std::reverse(loop.begin(), loop.end());
        loops.push_back(std::move(loop));
    }
    return loops;
}

std::vector<Point2> flattened(const std::vector<Vec3>& points, Vec3 normal, Vec3 origin) {
    assert(!points.empty());
    const auto [u, v] = frame_across(normal);
    std::vector<Point2> flat;
    flat.reserve(points.size());
    for (const Vec3& p : points) flat.push_back({dot(u, p - origin), dot(v, p - origin)});
    return flat;
}

// Writes one half: its whole triangles, its parts of crossed triangles, its cap.
class HalfWriter {
 public:
    HalfWriter(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_above, bool above, std::size_t extra)
        : mesh_(mesh), number_(huge<std::uint32_t>(mesh.points.size())) {
        std::uint32_t count = 0;
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            if ((is_above[v] != 0) == above) number_[v] = count++;
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

    void whole(std::uint32_t t) {
        const Triangle& v = mesh_.triangles[t];
        add({number_[v[0]], number_[v[1]], number_[v[2]]}, cap_of(mesh_, t), t);
    }

    // The corner that is alone, or the four-sided rest.
    void part(const Straddler& s, bool above) {
        const Triangle& v = mesh_.triangles[s.triangle];
        const std::int32_t cap = cap_of(mesh_, s.triangle);
        const std::uint32_t exit = first_cap_point_ + s.exit_point;
        const std::uint32_t entry = first_cap_point_ + s.entry_point;
        // The cap points on the edges after and before the lone corner.
        const std::uint32_t after = s.lone_is_above ? exit : entry;
        const std::uint32_t before = s.lone_is_above ? entry : exit;
        if (s.lone_is_above == above) {
            add({number_[v[s.lone]], after, before}, cap, s.triangle);
        } else {
            const std::uint32_t next = number_[v[(s.lone + 1) % 3]];
            const std::uint32_t last = number_[v[(s.lone + 2) % 3]];
            add({after, next, last}, cap, s.triangle);
            add({after, last, before}, cap, s.triangle);
        }
    }

    Half finish(const Section& section, const CapTriangles& caps, bool above, std::int32_t cut_number) {
        half_.mesh.points.insert(half_.mesh.points.end(), section.points.begin(), section.points.end());
        half_.first_cap_triangle = half_.mesh.triangles.size();
        for (const auto& [a, b, c] : caps.triangles) {
            Triangle t{first_cap_point_ + a, first_cap_point_ + b, first_cap_point_ + c};
            if (above) std::swap(t[1], t[2]);  // the upper half's cap looks down
            add(t, cut_number, no_parent);
        }
        return std::move(half_);
    }

 private:
    void add(const Triangle& t, std::int32_t cap, std::uint32_t parent) {
        half_.mesh.triangles.push_back(t);
        half_.mesh.cap_of.push_back(cap);
        half_.parent.push_back(parent);
    }

    const TriangleMesh& mesh_;
    std::vector<std::uint32_t> number_;
    std::uint32_t first_cap_point_ = 0;
    Half half_;
};

std::vector<std::uint8_t> points_above(const TriangleMesh& mesh, const Plane& plane) {
    std::vector<std::uint8_t> is_above(mesh.points.size());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        is_above[v] = height(plane.normal, mesh.points[v]) >= plane.offset ? 1 : 0;
    }
    return is_above;
}

struct CappedSection {
    Section section;
    CapTriangles caps;
    std::size_t loops = 0;
    double area_mm2 = 0;
};

std::optional<CappedSection> capped_section(const TriangleMesh& mesh, const Plane& plane,
                                            const std::vector<std::uint8_t>& is_above) {
    std::vector<Straddler> straddlers = find_straddlers(mesh, is_above);
    if (straddlers.empty()) return std::nullopt;
    CappedSection result;
    result.section = find_section(mesh, plane, std::move(straddlers));
    const std::vector<Vec3>& points = result.section.points;
    std::vector<Loop> loops = trace_loops(result.section);
    result.loops = loops.size();
    const std::vector<Point2> flat = flattened(points, plane.normal, points.front());
    for (const Loop& loop : loops) result.area_mm2 += signed_area(flat, loop);
    loops = capped(std::move(loops));
    // Nested in the coordinates of the sweep, to the last bit: what it predicts is what the cut makes.
    const std::vector<CapRegion> regions = nest(flattened(points, plane.normal, mesh.points.front()), loops);
    result.caps = triangulate_regions(flat, loops, regions);
    return result;
}

}  // namespace

std::optional<CutHalves> cut(const TriangleMesh& mesh, const Plane& plane, std::int32_t cut_number) {
    assert(is_consistent(mesh) && cut_number != no_cap);
    const std::vector<std::uint8_t> is_above = points_above(mesh, plane);
    const std::optional<CappedSection> capped = capped_section(mesh, plane, is_above);
    if (!capped) return std::nullopt;
    const Section& section = capped->section;
    CutHalves result;
    result.loops = capped->loops;
    result.forced_regions = capped->caps.forced_regions;
    result.cap_area_mm2 = capped->area_mm2;
    HalfWriter above(mesh, is_above, true, section.points.size());
    HalfWriter below(mesh, is_above, false, section.points.size());
    std::size_t next_straddler = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (next_straddler < section.straddlers.size() && section.straddlers[next_straddler].triangle == t) {
            const Straddler& s = section.straddlers[next_straddler++];
            above.part(s, true);
            below.part(s, false);
        } else {
            (is_above[mesh.triangles[t][0]] != 0 ? above : below).whole(t);
        }
    }
    assert(next_straddler == section.straddlers.size());
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
