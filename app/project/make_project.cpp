// Glue between folder, import and lock. Everything that can be refused is checked before the scan is imported, which is
// the long part.

#include "app/project/make_project.h"

#include <numbers>

#include "app/project/ignored_surface.h"
#include "base/timings.h"
#include "cam/cell/cell.h"

namespace qchopper {

ProjectDraft draft_project(ProjectChoices choices, const ProjectContext& context) {
    check_output(choices.folder);
    ProjectDraft draft;
    draft.folder = choices.folder;
    if (choices.cell_file) {
        const Cell cell = read_cell(*choices.cell_file);  // an impossible one is refused before anything is made
        if (cell.machine && choices.settings.objectives.weights.unreachable > 0) {
            choices.settings.objectives.tilt_deg = cell.machine->max_tilt * 180 / std::numbers::pi;
        }
        draft.cell_file = read_file(*choices.cell_file, settings_limit);
    }
    if (choices.plan) draft.plan = read_plan(*choices.plan);
    if (draft.plan && choices.preset.empty()) choices.settings.objectives.weights = draft.plan->weights;
    std::optional<PaintedScan> painted = read_painted(choices);
    ImportedScan imported = import_project_scan(choices, context);
    std::optional<IgnoredSurface> ignored = ignore_surface(choices, std::move(painted), imported, context);
    context.warn(imported.report.warnings);
    draft.project = new_project(choices, imported);
    draft.project.ignored = std::move(ignored);
    draft.scan = std::move(imported.mesh);
    return draft;
}

LockedProject::LockedProject(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& cell_file,
                             const ProjectContext& context)
    : lock(folder), project(folder, context) {
    clear_leftovers(folder);
    if (!cell_file) return;
    take_cell(folder, *cell_file, context);
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
