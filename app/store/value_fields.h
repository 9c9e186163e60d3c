// Tables of the values that project.json and the documents of the commands have in common (base/json_fields.h).
//
// Keys are those of docs/developer/formats/project-folder.md (WEIGHTS, TERMS, SOLID, IGNORED, SETTINGS, CUT). What is
// read is what was written (tests/app/store/project_test.cpp).

#pragma once

#include "app/store/project.h"
#include "base/enum_names.h"
#include "base/json_fields.h"
#include "segment/access/tool_directions.h"

namespace qchopper {

constexpr auto names_of(Stop) {
    return EnumNames<Stop, 2>{{{Stop::any, "any"}, {Stop::all, "all"}}};
}
constexpr auto names_of(TermScope) {
    return EnumNames<TermScope, 2>{{{TermScope::cut, "cut"}, {TermScope::whole, "whole"}}};
}
constexpr auto names_of(FragilityForm) {
    return EnumNames<FragilityForm, 3>{
        {{FragilityForm::thinness, "thinness"}, {FragilityForm::thesis, "thesis"}, {FragilityForm::binary, "binary"}}};
}
constexpr auto names_of(CandidateNormals) {
    return EnumNames<CandidateNormals, 2>{{{CandidateNormals::box, "box"}, {CandidateNormals::sphere, "sphere"}}};
}
constexpr auto names_of(ConnectorForm) {
    return EnumNames<ConnectorForm, 2>{{{ConnectorForm::spread, "spread"}, {ConnectorForm::ratio, "ratio"}}};
}
constexpr auto names_of(ReviewOutcome) {
    return EnumNames<ReviewOutcome, 4>{{{ReviewOutcome::replaced, "replaced"},
                                        {ReviewOutcome::kept, "kept"},
                                        {ReviewOutcome::carries_cut, "carries_cut"},
                                        {ReviewOutcome::decided, "decided"}}};
}

// Of the objectives that are not always named, those that are not 0.
template <class V, Of<Weights> T>
void fields(V& v, T& weights) {
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        const ObjectiveField& field = all_objectives[i];
        if (i < always_named) {
            v(field.key, weights.*field.weight);
        } else {
            v.maybe(field.key, weights.*field.weight);
        }
    }
}

template <class V, Of<Terms> T>
void fields(V& v, T& terms) {
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        const ObjectiveField& field = all_objectives[i];
        if (i < always_named) {
            v(field.key, terms.*field.value);
        } else {
            v.maybe(field.key, terms.*field.value);
        }
    }
    v("total", terms.total);
}

template <class V, Of<SolidRecord> T>
void fields(V& v, T& solid) {
    v.maybe("name", solid.name);  // a fragment has none
    v("cut", solid.cut);
    v("faces", solid.faces);
    v("volume_mm3", solid.volume_mm3);
    v("centre_mm", solid.centre);
}

template <class V, Of<IgnoredSurface> T>
void fields(V& v, T& ignored) {
    using Path = std::filesystem::path;
    v.converted(
        "painted", ignored.painted, [](const Path& file) { return file.empty() ? std::nullopt : std::optional(file); },
        [](const std::optional<Path>& file) { return file.value_or(Path()); });
    v("inside", ignored.inside);
    v("share", ignored.share);
    v("sha256", ignored.sha256);
}

template <class V, Of<NoCutSurface> T>
void fields(V& v, T& no_cut) {
    v("painted", no_cut.painted);
    v("points", no_cut.points);
    v("sha256", no_cut.sha256);
}

template <class V, Of<Plane> T>
void fields(V& v, T& plane) {
    v("normal", plane.normal);
    v("offset_mm", plane.offset);
}

template <class V, Of<GivenPlane> T>
void fields(V& v, T& given) {
    fields(v, given.plane);
    v.maybe("proposed_by", given.by);
}

template <class V, Of<SymmetryPlane> T>
void fields(V& v, T& symmetry) {
    fields(v, symmetry.plane);
    v("score_mm", symmetry.score_mm);
    v("spacing_mm", symmetry.spacing_mm);
    v.written("ratio", [&] { return symmetry.ratio(); });
    v.written("is_symmetric", [&] { return symmetry.is_symmetric(); });
}

template <class V, Of<ConnectorOptions> T>
void fields(V& v, T& connector) {
    v("form", connector.form);
    v("diameter_mm", connector.diameter);
    v("depth_mm", connector.depth);
    v("wall_mm", connector.wall);
    v("spacing_mm", connector.spacing);
}

template <class V, Of<StopRules> T>
void fields(V& v, T& stop) {
    v("combine", stop.combine);
    v("fits_cell", stop.fits_cell);
    v("max_cuts", stop.max_cuts);
    v.maybe("max_faces", stop.max_faces);
    v.maybe("min_cuts", stop.min_cuts);
    v.maybe("max_obb_mm", stop.max_obb);
    v.maybe("max_unreachable", stop.max_unreachable);
    v.maybe("count_narrow", stop.count_narrow);
}

// All but what is kept beside project.json.
template <class V, Of<SearchSettings> T>
void fields(V& v, T& settings) {
    auto& o = settings.objectives;
    auto& c = settings.candidates;
    v("weights", o.weights);
    v("face_ratio_threshold", o.face_ratio_threshold);
    v("fragility_form", o.fragility_form);
    v("fragility_distance_mm", o.fragility_distance);
    v("undercut_by_area", o.undercut_by_area);
    v("fragment_volume_mm3", o.fragment_volume_mm3);
    v("offsets_per_normal", c.offsets_per_normal);
    v("runners_up", settings.runners_up);
    v("beam", settings.beam);
    v("near", settings.near);
    v("stop", settings.stop);
    v.maybe("terms_over", o.scope, TermScope::whole);
    v.maybe("utilization_over", o.utilization_scope, TermScope::cut);
    v.maybe("print_volume_mm", o.print_volume);
    v.maybe("connector", o.connector);
    v.maybe("forbidden", o.forbidden);
    v.maybe("tilt_deg", o.tilt_deg, default_tilt_deg);
    v.maybe("normals", c.normals);
    v.maybe("offset_step_mm", c.offset_step_mm);
    v.maybe("takes_symmetry", c.takes_symmetry);
    v.maybe("along_caps", c.along_caps);
    v.maybe("symmetry", c.symmetry);
    v.maybe("planes", c.given);
}

template <class V, Of<Ranked> T>
void fields(V& v, T& ranked) {
    fields(v, ranked.plane);
    v("wanted_offset_mm", ranked.wanted_offset);
    v("normal_index", ranked.normal_index);
    v("offset_index", ranked.offset_index);
    v("terms", ranked.terms);
    v.maybe("seam_mm", ranked.seam_mm);
    v.maybe("coarse_sections", ranked.coarse_sections);
}

template <class V, Of<Cut> T>
void fields(V& v, T& cut) {
    v("number", cut.number);
    v("piece", cut.piece);
    v("chosen", cut.chosen);
    v("candidates", cut.candidates);
    v("pieces", cut.pieces);
    v("fragments", cut.fragments);
    v("runners_up", cut.runners_up);
}

template <class V, Of<MilledSurface> T>
void fields(V& v, T& surface) {
    v("unreachable_mm2", surface.unreachable_mm2);
    v("area_mm2", surface.area_mm2);
}

template <class V, Of<CutReview> T>
void fields(V& v, T& review) {
    v("cut", review.cut);
    v("piece", review.piece);
    v("outcome", review.outcome);
    v("planes", review.planes);
    v("before", review.before);
    v("best", review.best);
}

}  // namespace qchopper
