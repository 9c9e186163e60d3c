// One table.

#include "app/engine/presets.h"

#include <array>
#include <cmath>

namespace qchopper {
namespace {

struct Preset {
    const char* name;
    Weights weights;
    bool undercut_by_area;
    std::optional<std::size_t> max_faces;
    std::optional<int> min_cuts;
};

constexpr std::size_t workable_faces = 100'000;

// Surface out of reach leads: a hundredth of the scan's surface is worth a whole point. Thin parts and further pieces
// cost enough that neither slivers nor wafers are cut off for little, and balance decides between equals.
SearchSettings carve() {
    SearchSettings settings;
    settings.objectives.weights = {0.05, 1, 0.3, 0, 100};
    settings.objectives.scope = TermScope::cut;
    settings.candidates.offsets_per_normal = 80;
    settings.stop.max_unreachable = 0.02;
    return settings;
}

// After public re-implementations of Luo et al. 2012: neither their paper nor the thesis gives weights.
SearchSettings chopper() {
    SearchSettings settings;
    settings.objectives.weights = {};
    for (const ObjectiveField& field : all_objectives) settings.objectives.weights.*field.weight = 0;
    Weights& w = settings.objectives.weights;
    w.parts = 1;
    w.utilization = 0.05;
    w.connector = 1;
    w.fragility = 1;
    w.seam = 0.1;
    w.symmetry = 0.25;
    settings.objectives.fragility_form = FragilityForm::binary;
    settings.candidates.normals = CandidateNormals::sphere;
    settings.candidates.offset_step_mm = 5;
    settings.candidates.takes_symmetry = true;
    settings.objectives.scope = TermScope::cut;
    return settings;
}

const std::array<Preset, 4> presets{{
    // name        face ratio, fragility, piece count, undercut
    {"bunny", {10, 5, 50, 10}, false, std::nullopt, 3},
    {"femur", {10, 5, 50, 10}, false, workable_faces, std::nullopt},
    {"vertebrae", {5, 1, 200, 1}, false, workable_faces, std::nullopt},
    {"skull", {5, 1, 200, 1}, false, workable_faces, std::nullopt},
}};

constexpr PresetRow rows[] = {
    {"carve",
     "what a tilting tool reaches, until at most 2 % of any piece is out of reach and every piece fits the cell"},
    {"thesis", "the objectives of Nicholson 2016, no stop rule"},
    {"bunny", "the bunny of Nicholson 2016"},
    {"femur", "the femur of Nicholson 2016"},
    {"vertebrae", "the vertebrae of Nicholson 2016"},
    {"skull", "the skull of Nicholson 2016"},
    {"chopper", "the objectives of Luo et al. 2012, until every piece fits the print volume"}};

}  // namespace

std::span<const PresetRow> preset_rows() {
    return rows;
}

std::optional<SearchSettings> preset(std::string_view name) {
    if (name == "carve") return carve();
    if (name == "chopper") return chopper();
    if (name == "thesis") return SearchSettings{};
    for (const Preset& p : presets) {
        if (name != p.name) continue;
        SearchSettings settings;
        settings.objectives.weights = p.weights;
        settings.objectives.undercut_by_area = p.undercut_by_area;
        settings.stop.max_faces = p.max_faces;
        settings.stop.min_cuts = p.min_cuts;
        return settings;
    }
    return std::nullopt;
}

bool are_rules_of_carve(std::string_view preset_name, const StopRules& rules) {
    return preset_name == "carve" && rules.max_unreachable == carve().stop.max_unreachable && !rules.max_faces &&
           !rules.min_cuts && !rules.max_obb;
}

SearchSettings stopping_at_print_volume(SearchSettings settings, std::string_view preset_name) {
    if (preset_name == "chopper" && !settings.stop.is_any_set())
        settings.stop.max_obb = settings.objectives.print_volume;
    return settings;
}

SearchSettings with_cell(SearchSettings settings, std::string_view preset_name, double max_tilt_deg,
                         std::optional<Vec3> largest_block) {
    if (!settings.objectives.print_volume) settings.objectives.print_volume = largest_block;
    settings = stopping_at_print_volume(settings, preset_name);
    if (are_rules_of_carve(preset_name, settings.stop)) settings.stop.fits_cell = true;
    if (settings.objectives.weights.unreachable > 0)
        settings.objectives.tilt_deg = std::round(1e9 * max_tilt_deg) / 1e9;
    return settings;
}

}  // namespace qchopper
