// Glue between folder, import and lock. Everything that can be refused is checked before the scan is imported, which is
// the long part. O(bytes of the scan and triangles of its import).

#include "app/engine/make_project.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <variant>

#include "app/engine/presets.h"
#include "app/pictures/regions_view.h"
#include "app/store/ignored_surface.h"
#include "app/store/no_cut_surface.h"
#include "app/store/project_lines.h"
#include "app/store/replay.h"
#include "base/error.h"
#include "base/text.h"
#include "base/timings.h"
#include "cam/cell/job_tools.h"
#include "cam/setup/choose_setup.h"
#include "segment/picture/lettering.h"
#include "segment/regions/methods.h"

namespace qchopper {
namespace {

// Its weights, and where surface out of reach has one of them, all that the preset carve evaluates planes by.
void take_objectives(const Plan& plan, SearchSettings& settings) {
    if (plan.weights.unreachable > 0) {
        const SearchSettings carve = *preset("carve");
        settings.objectives.scope = carve.objectives.scope;
        int& offsets = settings.candidates.offsets_per_normal;
        if (offsets == CandidateOptions{}.offsets_per_normal) offsets = carve.candidates.offsets_per_normal;
    }
    settings.objectives.weights = plan.weights;
}

// What the largest block holds of a piece, with the foam that is kept around that. Nothing if no block holds any.
std::optional<Vec3> room_in_largest_block(const Cell& cell) {
    std::optional<Vec3> largest;
    const auto volume = [](Vec3 v) { return v.x * v.y * v.z; };
    for (const Stock& stock : cell.stock) {
        const Vec3 room = stock.size - cell.stock_margin() * Vec3{2, 2, 1};
        if (!(room.x > 0 && room.y > 0 && room.z > 0)) continue;
        if (!largest || volume(room) > volume(*largest)) largest = room;
    }
    return largest;
}

// The settings of a project in a cell: its tilt, its largest block and its first dowels.
SearchSettings settings_in(const Cell& cell, const SearchSettings& before, const std::string& preset_name) {
    SearchSettings settings = with_cell(before, preset_name, max_tilt_deg(cell), room_in_largest_block(cell));
    settings.candidates.along_caps = is_any_sawn(cell);
    if (settings.objectives.needs_connector() && !cell.dowels.empty()) {
        const DowelSize& dowel = cell.dowels.front();
        ConnectorOptions& connector = settings.objectives.connector;
        connector.diameter = dowel.diameter;
        connector.depth = dowel.depth;
        connector.wall = dowel.wall;
    }
    return settings;
}

bool was_any_cut_decided(const History& history) {
    return std::any_of(history.decisions.begin(), history.decisions.end(), [](const Decision& decision) {
        return std::holds_alternative<Cut>(decision) || std::holds_alternative<Replacement>(decision);
    });
}

// What follows from a cell that the project did not know before. Cuts that were decided with another tilt keep theirs.
void follow_cell(OpenProject& project, const ProjectContext& context) {
    const SearchSettings& before = project.project().settings;
    SearchSettings after = settings_in(project.setups()->cell(), before, project.project().preset);
    const double tilt = after.objectives.tilt_deg;
    if (was_any_cut_decided(project.project().history)) after.objectives.tilt_deg = before.objectives.tilt_deg;
    const double kept = after.objectives.tilt_deg;
    project.set_settings(after);
    if (kept == tilt) return;
    context.warn("the tool of this cell tilts by " + significant(tilt, 4) + " degrees, but planes are ranked for " +
                 significant(kept, 4) + " degrees, as when the first cut was decided; stop rules and setups take the " +
                 "cell's. To rank for the cell's tilt, prepare the scan again with this cell");
}

// --finest-tool and --fine none name the tools that may be used.
void take_finest_tool(ProjectChoices& choices, const Cell& cell) {
    const bool has_fine = choices.fine_tools != FineTools::none;
    if (!choices.tools.empty() || (choices.finest_tool_mm <= 0 && has_fine)) return;
    if (!cell.machine) {
        throw InputError(InputFault::use, "the cell file describes no machine, and has one tool",
                         Sentence::with_key("leave_fine_tools", {}, "leave out which fine tools may be used"));
    }
    const std::vector<CuttingTool>& tools = cell.machine->tools;
    double least = choices.finest_tool_mm;
    if (!has_fine) least = std::max(least, tools[finishing_tool(tools, tools[roughing_tool(tools)].diameter)].diameter);
    if (finishing_tools(tools, least, std::numeric_limits<double>::infinity()).empty()) {
        throw InputError(InputFault::use,
                         "no ball-ended tool of the cell has a diameter of " + significant(least, 4) + " mm or more",
                         Sentence::with_key("smaller_finest_tool", {}, "give a smaller diameter"));
    }
    for (const CuttingTool& tool : tools) {
        if (tool.shape != ToolShape::ball || tool.diameter >= least) choices.tools.push_back(tool.number);
    }
    std::ranges::sort(choices.tools);
}

// The planes of each method in their order (segment/regions/region_planes.h), with a message for each. Precondition:
// every name is one of region_methods(). Throws Cancelled.
std::vector<GivenPlane> proposed_planes(const TriangleMesh& scan, const std::vector<std::string>& methods,
                                        const Context& context) {
    std::vector<GivenPlane> planes;
    for (const std::string& name : methods) {
        const RegionMethod* method = region_method(name);
        assert(method != nullptr);
        const StageTimer stage(context, "regions by " + name);
        const ScanRegions regions = scan_regions(scan, *method, {}, context);
        const RegionPlanes found = region_planes(face_graph(regions.copy), regions.labels);
        context.message(region_sentence(name, regions.labels.count, found));
        for (const BorderPlane& border : found.planes) planes.push_back({border.plane, name});
    }
    return planes;
}

}  // namespace

ProjectDraft draft_project(ProjectChoices choices, const ProjectContext& context) {
    check_font();
    check_output(choices.folder);
    ProjectDraft draft;
    draft.folder = choices.folder;
    std::optional<Cell> cell;
    if (choices.cell_file) {
        cell = read_cell(*choices.cell_file);  // an impossible one is refused before anything is made
        take_finest_tool(choices, *cell);      // likewise
        with_tools(*cell, choices.tools);      // likewise
        draft.cell_file = read_file(*choices.cell_file, settings_limit);
    }
    if (choices.plan) draft.plan = read_plan(*choices.plan);
    if (draft.plan && choices.preset.empty()) take_objectives(*draft.plan, choices.settings);
    if (!choices.load) choices.settings.objectives.weights.structure = 0;  // a plan has its weight, but no load
    check_load(choices.load, choices.weights.over(choices.settings.objectives.weights));
    std::optional<PaintedScan> painted = read_painted(choices);
    std::optional<NoCutMarks> no_cut = read_no_cut(choices);
    ImportedScan imported = import_project_scan(choices, context);
    std::optional<IgnoredSurface> ignored = ignore_surface(choices, std::move(painted), imported, context);
    CandidateOptions& candidates = choices.settings.candidates;
    std::optional<NoCutSurface> no_cut_surface = mark_no_cut(choices, std::move(no_cut), imported, candidates, context);
    const std::vector<GivenPlane> proposed = proposed_planes(imported.mesh, choices.proposers, context);
    candidates.given.insert(candidates.given.end(), proposed.begin(), proposed.end());
    candidates.takes_symmetry |= choices.weights.over(choices.settings.objectives.weights).symmetry > 0;
    if (candidates.takes_symmetry) {
        const StageTimer stage(context, "symmetry plane found");
        candidates.symmetry = symmetry_plane(imported.mesh);
        if (candidates.symmetry) {
            choices.settings.objectives.symmetry_plane = candidates.symmetry->plane;
            context.message(symmetry_line(*candidates.symmetry) + ".");
        }
    }
    context.warn(imported.report.warnings);
    draft.project = new_project(choices, imported);
    draft.project.no_cut = std::move(no_cut_surface);
    if (cell) draft.project.settings = settings_in(*cell, draft.project.settings, choices.preset);
    draft.project.ignored = std::move(ignored);
    draft.scan = std::move(imported.mesh);
    return draft;
}

LockedProject::LockedProject(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& cell_file,
                             const ProjectContext& context)
    : lock(folder), project(folder, context) {
    check_font();
    clear_leftovers(folder);
    if (!cell_file) return;
    take_cell(folder, *cell_file, context);
    follow_cell(project, context);
    context.saved("The project knows its cell now; its decisions are unchanged.");
}

LockedProject::LockedProject(ProjectDraft made, const Context& context)
    : lock(made.folder),
      project(
          made.folder, made.project,
          [scan = std::optional(std::move(made.scan)), folder = made.folder, of = made.project, context]() mutable {
              if (!scan) return scan_of_project(folder, of, context);
              TriangleMesh mesh = std::move(*scan);
              scan.reset();
              return mesh;
          },
          context) {}

LockedProject make_project(ProjectDraft draft, const ProjectContext& context) {
    const StageTimer stage(context, "project saved");
    create_project(draft.folder, draft.project, draft.cell_file, draft.scan.ignored);
    context.saved("The project " + draft.folder.string() + " is made, with no cut.");
    return LockedProject(std::move(draft), context);
}

}  // namespace qchopper
