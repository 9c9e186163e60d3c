// Segments a scan one request at a time: makes a project of it, or opens one that exists, and does what is asked.

#pragma once

#include <filesystem>
#include <optional>

#include "app/engine/decide.h"
#include "app/engine/make_project.h"

namespace qchopper {

// Makes a project of a scan, with given weights those of choices and not of the request. With choices.plan its cuts and
// discarded pieces are made until one does not apply, and nothing else that is requested is done; if the plan does not
// fit the scan (replay_plan.h, misfit), no project is made. Throws what draft_project, make_project and decide throw.
SegmentAnswer segment_scan(const ProjectChoices& choices, ProjectRequest request, const ProjectContext& context);

// decide(), with the state of the project in the answer. Precondition and errors are those of decide().
SegmentAnswer segment_open_project(OpenProject& open, const ProjectRequest& request, const ProjectContext& context);

// Throws what LockedProject and decide throw.
SegmentAnswer segment_project(const std::filesystem::path& folder,
                              const std::optional<std::filesystem::path>& cell_file, const ProjectRequest& request,
                              const ProjectContext& context);

}  // namespace qchopper
