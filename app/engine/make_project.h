// Makes a project of a scan, or opens one that exists; in both cases its folder is locked while it is open.

#pragma once

#include <filesystem>
#include <optional>

#include "app/engine/open_project.h"
#include "app/store/plan.h"
#include "app/store/project_context.h"
#include "app/store/project_folder.h"
#include "app/store/project_scan.h"

namespace qchopper {

// A new project that is not on disk yet.
struct ProjectDraft {
    std::filesystem::path folder;    // NAME.qch
    std::optional<Bytes> cell_file;  // as it was read; nothing: the project has no cell yet
    std::optional<Plan> plan;        // to be replayed
    TriangleMesh scan;               // imported, with what of it is ignored
    Project project;                 // without a decision
};

// Checks font, folder and cell file, reads the plan, reads the painted files, then imports the scan and
// finds what of it is ignored, what must not be cut, the planes that methods propose, which are given ones from then
// on, and its symmetry plane; writes nothing. The weights are those of the plan where there is neither a preset nor
// given weights. Throws InputError: what check_font, check_output, read_cell, read_plan, read_painted, read_no_cut,
// import_project_scan, ignore_surface and mark_no_cut throw, in this order.
ProjectDraft draft_project(ProjectChoices choices, const ProjectContext& context);

// A project whose folder no other program writes while this object lives.
struct LockedProject {
    // Opens the project of a folder, removes what a killed program left behind, then copies the cell file into the
    // folder, if one is given. Precondition: with a cell file the project has no cell yet. Throws what ProjectLock,
    // load_project, check_font and take_cell throw.
    LockedProject(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& cell_file,
                  const ProjectContext& context);
    // Opens what make_project has written.
    LockedProject(ProjectDraft made, const Context& context);

    ProjectLock lock;
    OpenProject project;
};

// Writes the folder of a draft. Throws what create_project and ProjectLock throw.
LockedProject make_project(ProjectDraft draft, const ProjectContext& context);

}  // namespace qchopper
