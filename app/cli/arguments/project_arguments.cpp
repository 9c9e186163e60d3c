// Field by field, without an algorithm.

#include "app/cli/arguments/project_arguments.h"

#include <algorithm>
#include <utility>

#include "app/cli/arguments/option_values.h"
#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/files/file.h"

namespace qchopper {
namespace {

constexpr std::size_t max_planes = 1'000;

// Planes of a file, one in each line: nx,ny,nz,d as --plane takes it, mm about the scan's centre. Empty lines, and
// lines that begin with #, are passed over; blanks around numbers too. `name` stands for the file in messages.
std::vector<Plane> plane_list(std::string_view text, const std::string& name) {
    std::vector<Plane> planes;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string content(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        std::erase_if(content, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
        if (content.empty() || content.front() == '#') continue;
        const std::string where = name + ", line " + std::to_string(line);
        const std::optional<Plane> plane = plane_from(content);
        if (!plane) {
            throw InputError(InputFault::config, where + ": not a plane nx,ny,nz,d",
                             "write a direction of any length but 0, and the distance along it in mm");
        }
        if (planes.size() == max_planes) {
            throw InputError(InputFault::config, where + ": more than " + std::to_string(max_planes) + " planes",
                             "keep those that matter");
        }
        planes.push_back(canonical(*plane));
    }
    if (planes.empty()) {
        throw InputError(InputFault::config, name + " holds no plane", "write a plane nx,ny,nz,d in each line");
    }
    return planes;
}

std::vector<Plane> planes_of_file(const std::filesystem::path& file) {
    const Bytes bytes = read_file(file, settings_limit);
    return plane_list({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

std::optional<Stop> combine_of(const ProjectArguments& a) {
    if (!a.stop) return std::nullopt;
    return *a.stop == "any" ? Stop::any : Stop::all;
}

void take_candidates(const ProjectArguments& a, CandidateOptions& candidates) {
    if (a.normals) candidates.normals = *a.normals == "box" ? CandidateNormals::box : CandidateNormals::sphere;
    if (a.offsets) {
        candidates.offsets_per_normal = *a.offsets;
        candidates.offset_step_mm.reset();
    }
    if (a.offset_step_mm) candidates.offset_step_mm = a.offset_step_mm;
    if (a.planes) {
        candidates.given.clear();
        for (const Plane& plane : planes_of_file(*a.planes)) candidates.given.push_back({plane});
    }
    candidates.takes_symmetry = candidates.takes_symmetry || a.symmetry;
}

SearchSettings settings_of(const ProjectArguments& a, const std::string& preset_name) {
    SearchSettings settings = preset(preset_name).value_or(SearchSettings{});
    settings.stop = given_rules(a).value_or(settings.stop);
    settings.stop.combine = combine_of(a).value_or(settings.stop.combine);
    settings.stop.count_narrow = a.count_narrow;
    settings.stop.max_cuts = a.max_cuts.value_or(settings.stop.max_cuts);
    if (a.fragility) {
        settings.objectives.fragility_form = *a.fragility == "thesis"   ? FragilityForm::thesis
                                             : *a.fragility == "binary" ? FragilityForm::binary
                                                                        : FragilityForm::thinness;
    }
    if (a.beam) settings.beam = static_cast<std::size_t>(*a.beam);
    take_candidates(a, settings.candidates);
    if (a.print_volume) settings.objectives.print_volume = lengths_from(*a.print_volume);
    if (a.utilization)
        settings.objectives.utilization_scope = *a.utilization == "whole" ? TermScope::whole : TermScope::cut;
    if (a.connector)
        settings.objectives.connector.form = *a.connector == "ratio" ? ConnectorForm::ratio : ConnectorForm::spread;
    settings.objectives.forbidden = a.forbidden;
    return stopping_at_print_volume(settings, preset_name);
}

RepairChoices repair_choices(const RepairChoiceArguments& a) {
    return {a.snap_borders_mm.value_or(0), a.fill ? *fill_named(*a.fill) : Fill::by_size, a.resolve_self_intersections,
            a.smooth_pen_grooves, a.alpha_wrap_mm.value_or(0)};
}

// The steps of repair that may be skipped, by the names of --skip.
constexpr std::pair<const char*, bool RepairOptions::*> skippable_steps[] = {
    {"faces", &RepairOptions::drop_repeated},
    {"split", &RepairOptions::split},
    {"orient", &RepairOptions::orient},
    {"stitch", &RepairOptions::stitch},
    {"degenerate", &RepairOptions::remove_degenerate},
    {"orient_outward", &RepairOptions::orient_outward}};

}  // namespace

std::optional<StopRules> given_rules(const ProjectArguments& a) {
    if (!a.min_cuts && !a.max_faces && !a.max_obb && !a.fits_cell && !a.max_unreachable) return std::nullopt;
    StopRules rules;
    rules.min_cuts = a.min_cuts;
    rules.max_faces = a.max_faces;
    if (a.max_obb) rules.max_obb = lengths_from(*a.max_obb);
    rules.fits_cell = a.fits_cell;
    rules.max_unreachable = a.max_unreachable;
    rules.count_narrow = a.count_narrow;
    rules.combine = combine_of(a).value_or(rules.combine);
    return rules;
}

ProjectChoices choices_of(const ProjectArguments& a, const std::string& preset_if_none) {
    ProjectChoices choices;
    choices.scan = a.input;
    if (a.units) choices.mm_per_unit = mm_per(unit_named(*a.units));
    choices.scale = a.scale.value_or(1);
    choices.repair = repair_choices(a);
    choices.ignore = {a.ignore_surface, a.ignore_inside};
    choices.no_cut = a.no_cut;
    if (a.propose) choices.proposers = *proposers_from(*a.propose);
    choices.preset = a.preset.value_or(preset_if_none);
    choices.settings = settings_of(a, choices.preset);
    choices.fragment_volume_mm3 = a.fragment_volume_mm3;
    if (a.structure) choices.load = load_from(*a.structure);
    if (choices.load) choices.settings.objectives.weights.structure = 1;
    if (a.weights) choices.weights = *weights_from(*a.weights);
    if (a.fragments && *a.fragments == "drop") choices.fragments = FragmentChoice::drop;
    if (a.out) choices.folder = without_slash(*a.out);
    choices.cell_file = a.cell;
    choices.tools = ascending(a.tools);
    choices.finest_tool_mm = a.finest_tool.value_or(0);
    if (a.fine && *a.fine == "all") choices.fine_tools = FineTools::all;
    if (a.fine && *a.fine == "none") choices.fine_tools = FineTools::none;
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
    request.preview_setups = a.preview_setups;
    if (a.discard) request.discard = discard_from(*a.discard);
    request.undo = a.undo;
    request.redo = a.redo;
    request.reset = a.reset;
    if (a.goes_on) {
        request.search = SearchRequest{given_rules(a), combine_of(a), a.max_cuts, {}, a.time_limit_s};
        if (a.beam) request.search->beam = static_cast<std::size_t>(*a.beam);
    }
    request.plan = a.plan;
    if (a.regions) request.regions = RegionsRequest{*a.regions, a.out.value_or("")};
    if (a.weights) request.weights = weights_from(*a.weights);
    if (a.tried_weights) request.tried_weights = weights_from(*a.tried_weights);
    if (a.expected_plane) request.expected_plane = plane_from(*a.expected_plane);
    request.piece = a.piece;
    request.top = a.top.value_or(request.top);
    request.write_pieces = a.write_pieces;
    return request;
}

ImportOptions import_options_of(const RepairArguments& a) {
    if ((a.groove_width || a.groove_depth) && !a.smooth_pen_grooves) {
        throw InputError(InputFault::use, "--groove-width and --groove-depth limit what --smooth-pen-grooves looks for",
                         "pass --smooth-pen-grooves too");
    }
    ImportOptions options;
    if (a.units) options.mm_per_unit = mm_per(unit_named(*a.units));
    options.scale = a.scale.value_or(1);
    options.may_lack_unit =
        !a.snap_borders_mm && !a.smooth_pen_grooves && !a.alpha_wrap_mm;  // no option has a length in mm
    RepairChoices choices = repair_choices(a);
    choices.resolve_self_intersections = !a.keep_self_intersections;
    RepairOptions& repair = options.repair;
    repair = options_of(choices);
    repair.pen_grooves.max_width = a.groove_width.value_or(repair.pen_grooves.max_width);
    repair.pen_grooves.max_depth = a.groove_depth.value_or(repair.pen_grooves.max_depth);
    for (const auto& [name, step] : skippable_steps) {
        repair.*step = std::find(a.skipped.begin(), a.skipped.end(), name) == a.skipped.end();
    }
    repair.drop_fragments = a.fragments && *a.fragments == "drop";
    repair.measure_deviation = true;
    return options;
}

}  // namespace qchopper
