#include "segment/score/section.h"

#include <algorithm>
#include <cassert>
#include <memory>

#include "segment/mesh/frame.h"

namespace qchopper {
namespace {

// How one plane crosses one straddler.
struct Crossing {
    std::size_t lone;  // the corner that is alone on its side
    bool lone_is_above;
    std::size_t upper;  // ends of the edge through which the surface leaves downwards
    std::size_t lower;
    std::size_t exit_edge;
};

Crossing crossing(const Straddler& s, std::size_t plane) {
    const bool above[3] = {s.slab[0] > plane, s.slab[1] > plane, s.slab[2] > plane};
    Crossing c{};
    c.lone_is_above = above[0] + above[1] + above[2] == 1;
    while (above[c.lone] != c.lone_is_above) ++c.lone;
    c.exit_edge = c.lone_is_above ? c.lone : (c.lone + 2) % 3;
    c.upper = c.exit_edge;
    c.lower = (c.exit_edge + 1) % 3;
    return c;
}

// Share of the triangle's area at its lone corner: the product of the shares of the two cut edges.
double lone_share(const Straddler& s, const Crossing& c, double offset) {
    const double h = s.height[c.lone];
    const double next = s.height[(c.lone + 1) % 3];
    const double last = s.height[(c.lone + 2) % 3];
    return (h - offset) / (h - next) * ((h - offset) / (h - last));
}

class Finder {
 public:
    Finder(const PreparedPiece& prepared, const Slabs& slabs, Vec3 normal, std::span<const double> offsets)
        : p_(prepared), mesh_(*prepared.piece->mesh), slabs_(slabs), offsets_(offsets), frame_(frame_across(normal)) {}

    Section run() {
        link_records();
        trace_loops();
        order_loops();
        return std::move(out_);
    }

 private:
    void link_records() {
        // Only straddlers are ever looked up: what the rest holds does not matter.
        const auto straddler_of = std::make_unique_for_overwrite<std::uint32_t[]>(mesh_.triangles.size());
        for (std::uint32_t i = 0; i < slabs_.straddlers.size(); ++i) straddler_of[slabs_.straddlers[i].triangle] = i;
        out_.next.resize(slabs_.records);
        out_.point.resize(slabs_.records);
        straddler_of_record_.resize(slabs_.records);
        for (std::uint32_t i = 0; i < slabs_.straddlers.size(); ++i) {
            const Straddler& s = slabs_.straddlers[i];
            for (std::size_t plane = s.low; plane < s.high; ++plane) {
                const auto record = static_cast<std::uint32_t>(s.first_record + (plane - s.low));
                const Crossing c = crossing(s, plane);
                const std::uint32_t twin = p_.edges.twin[3 * s.triangle + c.exit_edge];
                const Straddler& other = slabs_.straddlers[straddler_of[twin / 3]];
                assert(plane >= other.low && plane < other.high);
                out_.next[record] = static_cast<std::uint32_t>(other.first_record + (plane - other.low));
                out_.point[record] = flat_point(s, c, offsets_[plane]);
                straddler_of_record_[record] = i;
            }
        }
    }

    Point2 flat_point(const Straddler& s, const Crossing& c, double offset) const {
        const Triangle& corner = mesh_.triangles[s.triangle];
        const Vec3 upper = mesh_.points[corner[c.upper]];
        const Vec3 lower = mesh_.points[corner[c.lower]];
        const double share = (s.height[c.upper] - offset) / (s.height[c.upper] - s.height[c.lower]);
        const Vec3 p = upper + share * (lower - upper) - p_.origin;
        return {dot(frame_.u, p), dot(frame_.v, p)};
    }

    void trace_loops() {
        std::vector<bool> done(slabs_.records, false);
        const std::size_t width = slabs_.layout.width();
        for (std::uint32_t start = 0; start < slabs_.records; ++start) {
            if (done[start]) continue;
            SectionLoop loop;
            const Straddler& first = slabs_.straddlers[straddler_of_record_[start]];
            loop.plane = static_cast<std::uint16_t>(first.low + (start - first.first_record));
            loop.first_record = start;
            above_.resize(above_.size() + width, 0.0);
            below_.resize(below_.size() + width, 0.0);
            const std::span<double> above(above_.data() + above_.size() - width, width);
            const std::span<double> below(below_.data() + below_.size() - width, width);
            const Point2 origin = out_.point[start];
            double twice_area = 0;
            for (std::uint32_t r = start; !done[r]; r = out_.next[r]) {
                done[r] = true;
                ++loop.points;
                const Point2 a = out_.point[r];
                const Point2 b = out_.point[out_.next[r]];
                twice_area += (a.x - origin.x) * (b.y - origin.y) - (b.x - origin.x) * (a.y - origin.y);
                add_parts(slabs_.straddlers[straddler_of_record_[r]], loop, above, below);
            }
            loop.area_mm2 = -twice_area / 2;  // the surface is followed clockwise
            out_.loops.push_back(loop);
        }
    }

    void add_parts(const Straddler& s, SectionLoop& loop, std::span<double> above, std::span<double> below) const {
        const Crossing c = crossing(s, loop.plane);
        const double share = lone_share(s, c, offsets_[loop.plane]);
        add_part(c.lone_is_above ? above : below, p_, s, share, 1);
        add_part(c.lone_is_above ? below : above, p_, s, 1 - share, 2);
        loop.node_above = s.node[c.upper];
        loop.node_below = s.node[c.lower];
    }

    void order_loops() {
        std::vector<std::size_t> order(out_.loops.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return out_.loops[a].plane < out_.loops[b].plane; });
        const std::size_t width = slabs_.layout.width();
        out_.above = SumTable(order.size(), width);
        out_.below = SumTable(order.size(), width);
        std::vector<SectionLoop> sorted;
        sorted.reserve(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            sorted.push_back(out_.loops[order[i]]);
            add(out_.above.row(i), {above_.data() + order[i] * width, width});
            add(out_.below.row(i), {below_.data() + order[i] * width, width});
        }
        out_.loops = std::move(sorted);
        out_.first_loop.assign(offsets_.size() + 1, 0);
        for (const SectionLoop& loop : out_.loops) ++out_.first_loop[loop.plane + 1U];
        for (std::size_t j = 0; j < offsets_.size(); ++j) out_.first_loop[j + 1] += out_.first_loop[j];
    }

    const PreparedPiece& p_;
    const TriangleMesh& mesh_;
    const Slabs& slabs_;
    std::span<const double> offsets_;
    PlaneFrame frame_;
    std::vector<std::uint32_t> straddler_of_record_;
    std::vector<double> above_;
    std::vector<double> below_;
    Section out_;
};

}  // namespace

Section find_section(const PreparedPiece& prepared, const Slabs& slabs, Vec3 normal, std::span<const double> offsets) {
    return Finder(prepared, slabs, normal, offsets).run();
}

std::vector<SectionRegion> regions(const Section& section, std::size_t plane) {
    std::vector<std::size_t> kept;  // loops of two points close by themselves and take no cap (cap.cpp)
    for (std::size_t i = section.first_loop[plane]; i < section.first_loop[plane + 1]; ++i) {
        if (section.loops[i].points > 2) kept.push_back(i);
    }
    std::vector<CapRegion> nested;
    if (kept.size() == 1) {
        nested.push_back({0, {}, true});
    } else if (kept.size() > 1) {
        std::vector<Point2> points;
        std::vector<Loop> loops(kept.size());
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const SectionLoop& loop = section.loops[kept[k]];
            std::uint32_t record = loop.first_record;
            for (std::uint32_t n = 0; n < loop.points; ++n, record = section.next[record]) {
                loops[k].push_back(static_cast<std::uint32_t>(points.size()));
                points.push_back(section.point[record]);
            }
            std::reverse(loops[k].begin(), loops[k].end());
        }
        nested = nest(points, loops);
    }
    std::vector<SectionRegion> result;
    for (const CapRegion& region : nested) {
        SectionRegion r;
        r.loops.push_back(kept[region.outer]);
        for (const std::size_t hole : region.holes) r.loops.push_back(kept[hole]);
        double points = 0;
        for (const std::size_t loop : r.loops) {
            points += section.loops[loop].points;
            r.area_mm2 += section.loops[loop].area_mm2;
        }
        r.triangles = points + 2 * static_cast<double>(r.loops.size()) - 4;
        result.push_back(std::move(r));
    }
    return result;
}

}  // namespace qchopper
