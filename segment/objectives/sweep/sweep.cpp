// The offsets divide the mesh into slabs (slabs.h). Above and below a plane, parts are merges of slab components,
// joined by the cap regions of the plane's loops (section.h) and by the links of uncut cavities: a planar cut makes no
// new cavity, so nothing else joins the surfaces of one solid. Merges go from the far ends towards the planes, with
// disjoint sets. O(points + triangles + crossings) for offsets about evenly spaced; besides, per plane, the nesting of
// its loops (polygon_nesting.h) and a pass over the merged components.

#include "segment/objectives/sweep/sweep.h"

#include <algorithm>
#include <cassert>

#include "segment/cut/half_solids.h"
#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/objectives/sweep/binary_fragility.h"
#include "segment/objectives/sweep/connector_sweep.h"
#include "segment/objectives/sweep/fragility_sweep.h"
#include "segment/objectives/sweep/section.h"
#include "segment/objectives/sweep/section_measures.h"
#include "segment/objectives/sweep/slabs.h"
#include "segment/objectives/sweep/symmetry_sweep.h"

namespace qchopper {
namespace {

struct GraphEdge {
    std::uint32_t a;
    std::uint32_t b;
};

// One side of all planes: components are added slab by slab, from the far end towards the planes, and merged. Between
// two slabs lies a plane, for which the parts merged so far are evaluated.
class SweepSide {
 public:
    SweepSide(const PreparedPiece& prepared, const Slabs& slabs, const Section& section, Vec3 normal,
              std::span<const double> offsets, std::span<const CavityLink> links, bool above)
        : p_(prepared),
          slabs_(slabs),
          section_(section),
          normal_(normal),
          offsets_(offsets),
          above_(above),
          planes_(offsets.size()),
          sets_(slabs.components()),
          sums_(slabs.inside),
          edges_at_(planes_ + 1),
          components_at_(planes_ + 1) {
        for (std::uint32_t c = 0; c < slabs.components(); ++c) {
            components_at_[slabs.component_slab[c]].push_back(c);
            sums_.add(c, above ? slabs.above : slabs.below, c);
        }
        for (const auto& [a, b] : slabs.connections) add_edge(a, b);
        for (const CavityLink& link : links) {
            add_edge(slabs.component_of[link.vertex],
                     slabs.component_of[far_corner(*prepared.piece->mesh, link, normal, above)]);
        }
    }

    // Adds this side's solids to the evaluations of all planes that have loops.
    void run(std::vector<std::optional<CutEvaluation>>& evaluations, std::vector<std::vector<SectionRegion>>& regions) {
        for (std::size_t step = 0; step < planes_; ++step) {
            const std::size_t slab = above_ ? planes_ - step : step;
            const std::size_t plane = above_ ? slab - 1 : slab;
            add_slab(slab);
            if (evaluations[plane]) add_solids(plane, regions[plane], *evaluations[plane]);
        }
    }

 private:
    // An edge merges its ends when the slab of the end nearer to the planes is added.
    void add_edge(std::uint32_t a, std::uint32_t b) {
        if (a == b) return;
        const std::uint16_t slab_a = slabs_.component_slab[a];
        const std::uint16_t slab_b = slabs_.component_slab[b];
        std::vector<GraphEdge>& edges = edges_at_[above_ ? std::min(slab_a, slab_b) : std::max(slab_a, slab_b)];
        edges.push_back({a, b});
    }

    void add_slab(std::size_t slab) {
        live_.insert(live_.end(), components_at_[slab].begin(), components_at_[slab].end());
        for (const GraphEdge& edge : edges_at_[slab]) {
            const std::uint32_t a = sets_.root(edge.a);
            const std::uint32_t b = sets_.root(edge.b);
            if (a == b) continue;
            sums_.add(std::min(a, b), sums_, std::max(a, b));
            sets_.unite(a, b);
        }
        std::erase_if(live_, [&](std::uint32_t c) { return sets_.root(c) != c; });
    }

    void add_solids(std::size_t plane, std::vector<SectionRegion>& regions, CutEvaluation& evaluation) {
        const std::size_t first = section_.first_loop[plane];
        const std::size_t count = section_.first_loop[plane + 1] - first;
        assert(count > 0);
        // Loops belong to one part if they share a cap region or a merged component.
        DisjointSets part(count);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> roots;  // merged component, loop
        for (std::uint32_t i = 0; i < count; ++i) {
            const SectionLoop& loop = section_.loops[first + i];
            roots.emplace_back(sets_.root(above_ ? loop.component_above : loop.component_below), i);
        }
        std::sort(roots.begin(), roots.end());
        for (std::size_t i = 1; i < roots.size(); ++i) {
            if (roots[i].first == roots[i - 1].first) part.unite(roots[i].second, roots[i - 1].second);
        }
        for (const SectionRegion& region : regions) {
            for (const std::size_t loop : region.loops) {
                part.unite(static_cast<std::uint32_t>(region.loops.front() - first),
                           static_cast<std::uint32_t>(loop - first));
            }
        }
        SumTable sums(count, sums_.half_spaces(), sums_.has_boxes());
        std::vector<bool> has_cap(count, false);
        for (std::uint32_t i = 0; i < count; ++i) {
            sums.add(part.root(i), above_ ? section_.above : section_.below, first + i);
        }
        for (std::size_t i = 0; i < roots.size(); ++i) {
            if (i > 0 && roots[i].first == roots[i - 1].first) continue;
            sums.add(part.root(roots[i].second), sums_, roots[i].first);
        }
        for (const SectionRegion& region : regions) {
            const std::uint32_t owner = part.root(static_cast<std::uint32_t>(region.loops.front() - first));
            add_cap(sums, owner, region, plane);
            if (region.triangles > 0) has_cap[owner] = true;
        }
        std::vector<std::uint32_t> solid_of(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (part.root(i) != i) continue;
            solid_of[i] = static_cast<std::uint32_t>(evaluation.solids.size());
            evaluation.solids.push_back(solid(sums, i, has_cap[i]));
        }
        for (SectionRegion& region : regions) {
            region.solid[above_ ? 0 : 1] =
                solid_of[part.root(static_cast<std::uint32_t>(region.loops.front() - first))];
        }
        for (const std::uint32_t c : live_) {  // solids that the plane does not touch
            const auto at = std::lower_bound(roots.begin(), roots.end(), std::pair{c, 0U});
            if (at == roots.end() || at->first != c) evaluation.solids.push_back(solid(sums_, c, false));
        }
    }

    void add_cap(SumTable& sums, std::size_t part, const SectionRegion& region, std::size_t plane) const {
        const Vec3 outward = above_ ? -normal_ : normal_;
        const double distance = (offsets_[plane] - height(normal_, p_.origin)) * (above_ ? -1 : 1);
        sums.part(part).faces += region.triangles;
        sums.part(part).volume += distance * region.area_mm2 / 3;
        const double weight = p_.unit.empty() ? region.area_mm2 : region.triangles;
        for (std::size_t b = 0; b < p_.piece->half_spaces.size(); ++b) {
            const double upwards = weight * dot(outward, p_.piece->half_spaces[b].up());
            BaseSums& base = sums.bases(part)[b];
            (upwards > 0 ? base.up : base.down) += std::abs(upwards);
        }
    }

    SolidEvaluation solid(const SumTable& sums, std::size_t part, bool has_cap) const {
        SolidEvaluation s;
        const PartSums& all = sums.part(part);
        s.faces = static_cast<std::size_t>(all.faces);
        s.volume_mm3 = all.volume;
        s.above = above_;
        if (sums.has_boxes()) s.size = sums.box(part).size();
        for (std::size_t b = 0; b < p_.piece->half_spaces.size(); ++b) {
            const BaseSums& base = sums.bases(part)[b];
            if (base.faces > 0) s.bases.push_back(share(p_.piece->half_spaces[b].cut, base.up, base.down));
        }
        if (has_cap) {  // its up is the normal above the plane, the opposite below
            s.bases.push_back(share(new_cut, above_ ? all.up : all.down, above_ ? all.down : all.up));
        }
        return s;
    }

    BaseShare share(std::int32_t cut, double up, double down) const {
        if (p_.unit.empty()) return {cut, down, up + down, 0, 0};
        return {cut, 0, 0, down, up + down};
    }

    const PreparedPiece& p_;
    const Slabs& slabs_;
    const Section& section_;
    Vec3 normal_;
    std::span<const double> offsets_;
    bool above_;
    std::size_t planes_;
    DisjointSets sets_;
    SumTable sums_;
    std::vector<std::vector<GraphEdge>> edges_at_;           // per slab
    std::vector<std::vector<std::uint32_t>> components_at_;  // per slab
    std::vector<std::uint32_t> live_;                        // roots of the components added so far
};

// Fills in `s`, and returns what follows of the solids; their sizes only where `with_sizes`.
std::vector<std::optional<CutEvaluation>> sweep_sections(const PreparedPiece& prepared, Vec3 normal,
                                                         std::span<const double> offsets, SweptSections& s,
                                                         bool with_sizes) {
    std::vector<std::optional<CutEvaluation>> evaluations(offsets.size());
    if (offsets.empty()) return evaluations;
    s.slabs = slabs(prepared, normal, offsets);
    s.section = find_section(prepared, s.slabs, offsets);
    if (with_sizes && !prepared.sizes.of_cluster.empty()) add_boxes(prepared, normal, offsets, s.slabs, s.section);
    assert(s.section.first_loop.size() == offsets.size() + 1 && s.section.first_loop.back() == s.section.loops.size());
    assert(std::is_sorted(s.section.first_loop.begin(), s.section.first_loop.end()));
    s.regions.assign(offsets.size(), {});
    for (std::size_t plane = 0; plane < offsets.size(); ++plane) {
        if (s.section.first_loop[plane] == s.section.first_loop[plane + 1]) continue;
        evaluations[plane].emplace();
        for (std::size_t i = s.section.first_loop[plane]; i < s.section.first_loop[plane + 1]; ++i) {
            evaluations[plane]->cap_area_mm2 += s.section.loops[i].area_mm2;
        }
        s.regions[plane] = regions(s.section, plane);
    }
    const std::vector<CavityLink> links = cavity_links(*prepared.piece->mesh, prepared.shells, normal);
    for (const bool above : {true, false}) {
        SweepSide(prepared, s.slabs, s.section, normal, offsets, links, above).run(evaluations, s.regions);
    }
    return evaluations;
}

void add_of_sections(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                     const Objectives& objectives, const SweptSections& sections,
                     std::span<std::optional<CutEvaluation>> evaluations) {
    if (prepared.has_seam) add_seams(*prepared.piece, sections.slabs, sections.section, offsets, evaluations);
    if (objectives.needs_connector())
        add_connector(prepared, normal, offsets, sections, objectives.connector, evaluations);
    if (objectives.needs_symmetry())
        add_symmetry(prepared, normal, offsets, sections, *objectives.symmetry_plane, evaluations);
}

void add_structure(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                   std::span<std::optional<CutEvaluation>> evaluations) {
    if (!prepared.stressed) return;
    const std::vector<SectionStress> stress = section_stress(*prepared.stressed, normal, offsets);
    for (std::size_t j = 0; j < evaluations.size(); ++j) {
        if (!evaluations[j]) continue;
        evaluations[j]->structure = stress[j].value;
        evaluations[j]->coarse_sections = stress[j].too_coarse;
    }
}

}  // namespace

std::vector<std::optional<CutEvaluation>> sweep_solids(const PreparedPiece& prepared, Vec3 normal,
                                                       std::span<const double> offsets) {
    SweptSections sections;
    return sweep_sections(prepared, normal, offsets, sections, true);
}

void add_fragility(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                   const Objectives& objectives, std::span<std::optional<CutEvaluation>> evaluations) {
    assert(evaluations.size() == offsets.size());
    const double d = objectives.fragility_distance;
    const FragilityForm form = objectives.fragility_form;
    const std::vector<double> values = form == FragilityForm::thinness ? sweep_thinness(prepared, normal, offsets, d)
                                       : form == FragilityForm::thesis
                                           ? sweep_thesis_fragility(prepared, normal, offsets, d)
                                           : sweep_binary_fragility(prepared, normal, offsets, d);
    assert(values.size() == evaluations.size());
    for (std::size_t j = 0; j < evaluations.size(); ++j) {
        if (!evaluations[j] || evaluations[j]->cap_area_mm2 <= 0) continue;
        evaluations[j]->fragility =
            form == FragilityForm::thinness ? values[j] / evaluations[j]->cap_area_mm2 : values[j];
    }
}

void add_section_terms(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                       const Objectives& objectives, std::span<std::optional<CutEvaluation>> evaluations) {
    add_structure(prepared, normal, offsets, evaluations);
    if (!prepared.has_seam && !objectives.needs_connector() && !objectives.needs_symmetry()) return;
    SweptSections sections;
    sweep_sections(prepared, normal, offsets, sections, false);
    add_of_sections(prepared, normal, offsets, objectives, sections, evaluations);
}

std::vector<std::optional<CutEvaluation>> sweep(const PreparedPiece& prepared, Vec3 normal,
                                                std::span<const double> offsets, const Objectives& objectives) {
    SweptSections sections;
    std::vector<std::optional<CutEvaluation>> evaluations = sweep_sections(prepared, normal, offsets, sections, true);
    add_fragility(prepared, normal, offsets, objectives, evaluations);
    add_of_sections(prepared, normal, offsets, objectives, sections, evaluations);
    add_structure(prepared, normal, offsets, evaluations);
    return evaluations;
}

}  // namespace qchopper
