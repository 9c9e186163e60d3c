#include "app/cli/project_arguments.h"

#include "app/cli/option_values.h"
#include "app/project/presets.h"
#include "base/error.h"
#include "segment/io/read_mesh.h"

namespace qchopper {
namespace {

std::optional<Stop> combine_of(const ProjectArguments& a) {
    if (!a.stop) return std::nullopt;
    return *a.stop == "any" ? Stop::any : Stop::all;
}

SearchSettings settings_of(const ProjectArguments& a) {
    SearchSettings settings = a.preset ? *preset(*a.preset) : SearchSettings{};
    settings.stop = given_rules(a).value_or(settings.stop);
    settings.stop.combine = combine_of(a).value_or(settings.stop.combine);
    if (a.fragility) {
        settings.objectives.fragility_form = *a.fragility == "thesis" ? FragilityForm::thesis : FragilityForm::thinness;
    }
    if (a.weights) settings.objectives.weights = weights_from(*a.weights)->over(settings.objectives.weights);
    if (a.beam) settings.beam = static_cast<std::size_t>(*a.beam);
    return settings;
}

}  // namespace

std::optional<StopRules> given_rules(const ProjectArguments& a) {
    if (!a.min_cuts && !a.max_faces && !a.max_obb && !a.fits_cell) return std::nullopt;
    StopRules rules;
    rules.min_cuts = a.min_cuts;
    rules.max_faces = a.max_faces;
    if (a.max_obb) rules.max_obb = lengths_from(*a.max_obb);
    rules.fits_cell = a.fits_cell;
    rules.combine = combine_of(a).value_or(rules.combine);
    return rules;
}

bool is_any_given(const RepairChoiceArguments& a) {
    return a.weld_mm || a.fill || a.smooth_marks || a.wrap_mm || a.resolve_self_intersections;
}

RepairChoices repair_choices(const RepairChoiceArguments& a) {
    RepairChoices choices;
    choices.weld_mm = a.weld_mm.value_or(0);
    if (a.fill) choices.fill = *fill_named(*a.fill);
    choices.resolve_self_intersections = a.resolve_self_intersections;
    choices.smooth_marks = a.smooth_marks;
    choices.wrap_mm = a.wrap_mm.value_or(0);
    return choices;
}

void check_unit(const std::filesystem::path& scan, const ProjectArguments& a) {
    if (a.units || scan == "-" || read_mesh(scan).mm_per_unit) return;
    throw InputError(InputFault::use, "the scan has no unit", "pass --units mm, cm, m or in");
}

ProjectChoices choices_of(const std::filesystem::path& scan, const ProjectArguments& a) {
    ProjectChoices choices;
    choices.scan = scan;
    if (a.units) choices.mm_per_unit = mm_per(unit_named(*a.units));
    choices.scale = a.scale.value_or(1);
    choices.repair = repair_choices(a);
    choices.preset = a.preset.value_or("");
    choices.settings = settings_of(a);
    choices.fragment_volume_mm3 = a.fragment_volume_mm3;
    if (a.fragments && *a.fragments == "drop") choices.fragments = FragmentChoice::drop;
    return choices;
}

ProjectRequest request_of(const SegmentArguments& a) {
    ProjectRequest request;
    request.propose = a.step;
    request.accept = a.accept;
    if (a.plane) request.plane = plane_from(*a.plane);
    if (a.preview) {
        const std::optional<std::size_t> place = place_from(*a.preview);
        if (place) request.preview = *place;
        if (!place) request.preview = *plane_from(*a.preview);
    }
    request.discard = a.discard;
    request.undo = a.undo;
    request.redo = a.redo;
    request.reset = a.reset;
    if (a.goes_on) {
        request.search = SearchRequest{given_rules(a), combine_of(a), {}, a.time_limit_s};
        if (a.beam) request.search->beam = static_cast<std::size_t>(*a.beam);
    }
    request.plan = a.plan;
    request.piece = a.piece;
    request.top = a.top.value_or(request.top);
    return request;
}

}  // namespace qchopper
