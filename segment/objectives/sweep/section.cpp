// Every crossing is linked to the one in the triangle across its exit edge; the cycles of these links are the loops.
// O(crossings + l log l) for l loops, and the nesting of loops per plane. Memory 12 bytes per crossing, and for the
// time of linking 4 per triangle.

#include "segment/objectives/sweep/section.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <numeric>
#include <utility>

#include "segment/mesh/polygon_nesting.h"

namespace qchopper {
namespace {

// Share of the triangle's area at its apex: the product of the shares of the two cut edges.
double apex_share(const CrossedTriangle& s, std::uint32_t apex, double offset) {
    const double h = s.height[apex];
    const double next = s.height[(apex + 1) % 3];
    const double last = s.height[(apex + 2) % 3];
    return (h - offset) * (h - offset) / ((h - next) * (h - last));
}

// A sequence of simple loops, each with one random access to memory per step, so that the processor overlaps many of
// them.
class SectionFinder {
 public:
    SectionFinder(const PreparedPiece& prepared, const Slabs& slabs, std::span<const double> offsets)
        : p_(prepared), slabs_(slabs), offsets_(offsets) {}

    Section run() {
        link_crossings();
        trace_loops();
        add_parts();
        order_loops();
        return std::move(out_);
    }

 private:
    void link_crossings() {
        const std::size_t crossings = slabs_.exit.size();
        std::vector<std::uint32_t> across(crossings);  // the triangle that the surface enters
        for (std::size_t i = 0; i < crossings; ++i) across[i] = p_.edges.twin[slabs_.exit[i]] / 3;
        // Only entries of crossed triangles are read; the others stay uninitialised.
        const auto place_of = std::make_unique_for_overwrite<std::uint32_t[]>(p_.piece->mesh->triangles.size());
        const std::vector<CrossedTriangle>& all = slabs_.crossed;
        for (std::uint32_t i = 0; i < all.size(); ++i) place_of[all[i].triangle] = i;
        for (std::uint32_t& triangle : across) triangle = place_of[triangle];
        next_.resize(crossings);
        std::uint32_t i = 0;
        for (const CrossedTriangle& s : all) {
            for (std::size_t plane = s.low; plane < s.high; ++plane, ++i) {
                const CrossedTriangle& other = all[across[i]];
                assert(plane >= other.low && plane < other.high);
                next_[i] = static_cast<std::uint32_t>(other.first_crossing + (plane - other.low));
            }
        }
    }

    void trace_loops() {
        Cycles found = cycles(next_);
        loop_of_ = std::move(found.cycle_of);
        out_.order = std::move(found.order);
        out_.point.reserve(out_.order.size());
        for (const std::uint32_t i : out_.order) out_.point.push_back(slabs_.point[i]);
        std::uint32_t place = 0;
        out_.loops.reserve(found.cycles.size());
        auto s = slabs_.crossed.begin();
        for (const auto& [first, size] : found.cycles) {
            while (first - s->first_crossing >= std::uint32_t{s->high} - s->low) ++s;
            SectionLoop loop;
            loop.plane = static_cast<std::uint16_t>(s->low + (first - s->first_crossing));
            loop.points = size;
            loop.first = std::exchange(place, place + size);
            const std::uint32_t exit = crossing(*s, loop.plane).exit();
            loop.component_above = s->component[exit];
            loop.component_below = s->component[(exit + 1) % 3];
            out_.loops.push_back(loop);
        }
    }

    // The parts of the crossed triangles, and the areas within the loops.
    void add_parts() {
        for (SumTable* table : {&above_, &below_}) *table = SumTable(out_.loops.size(), p_.up.size());
        std::uint32_t i = 0;
        for (const CrossedTriangle& s : slabs_.crossed) {
            for (std::size_t plane = s.low; plane < s.high; ++plane, ++i) {
                SectionLoop& loop = out_.loops[loop_of_[i]];
                const auto [apex, apex_is_above] = crossing(s, plane);
                const double share = apex_share(s, apex, offsets_[plane]);
                add_part(apex_is_above ? above_ : below_, loop_of_[i], p_, s, share, 1);
                add_part(apex_is_above ? below_ : above_, loop_of_[i], p_, s, 1 - share, 2);
                // Half the shoelace; the surface is followed clockwise.
                const Point2 origin = out_.point[loop.first];
                loop.area_mm2 -= orientation(origin, slabs_.point[i], slabs_.point[next_[i]]) / 2;
            }
        }
    }

    void order_loops() {
        std::vector<std::uint32_t> order(out_.loops.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return out_.loops[a].plane < out_.loops[b].plane; });
        out_.above = SumTable(order.size(), p_.up.size());
        out_.below = SumTable(order.size(), p_.up.size());
        std::vector<SectionLoop> sorted;
        sorted.reserve(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            sorted.push_back(out_.loops[order[i]]);
            out_.above.add(i, above_, order[i]);
            out_.below.add(i, below_, order[i]);
        }
        out_.loops = std::move(sorted);
        out_.first_loop.assign(offsets_.size() + 1, 0);
        for (const SectionLoop& loop : out_.loops) ++out_.first_loop[loop.plane + 1U];
        for (std::size_t j = 0; j < offsets_.size(); ++j) out_.first_loop[j + 1] += out_.first_loop[j];
    }

    const PreparedPiece& p_;
    const Slabs& slabs_;
    std::span<const double> offsets_;
    std::vector<std::uint32_t> next_;     // per crossing: the one that follows on its loop
    std::vector<std::uint32_t> loop_of_;  // per crossing
    SumTable above_;                      // per loop, not yet in the order of the planes
    SumTable below_;
    Section out_;
};

}  // namespace

Section find_section(const PreparedPiece& prepared, const Slabs& slabs, std::span<const double> offsets) {
    return SectionFinder(prepared, slabs, offsets).run();
}

std::vector<SectionRegion> regions(const Section& section, std::size_t plane) {
    std::vector<std::size_t> kept;  // loops of two points enclose no area and get no cap (cap.cpp)
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
            for (const Point2 p : section.points(loop)) {
                loops[k].push_back(static_cast<std::uint32_t>(points.size()));
                points.push_back(p);
            }
            std::reverse(loops[k].begin(), loops[k].end());
        }
        nested = nest_polygons(points, loops);
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
