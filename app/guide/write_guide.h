// Writes the assembly guide of a finished project: guide.html, guide.pdf and guide.glb in its folder.
//
// They are never stale, as jobs and sheets: they are removed when one of those changes. No time is in them: the same
// project gives the same bytes (tests/app/cli/guide_test.cpp).

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/engine/open_project.h"
#include "app/jobs/project_joints.h"

namespace qchopper {

struct WrittenGuide {
    ProjectJoints joints;
    std::vector<std::filesystem::path> files;
    std::vector<std::string> held;  // pieces that have to be held when they are moved, for nothing holds them yet
};
// For people: how much is joined, a line per file, what has to be held.
std::vector<std::string> lines(const WrittenGuide& guide);

// Precondition: the caller holds the lock of the folder. Reports progress in pictures. Throws InputError (use) for a
// project that is not finished, what export_pieces and write_file throw, and Cancelled: then the files of before are
// there, or none.
WrittenGuide write_guide(OpenProject& project, const std::string& program_version, const Context& context);

}  // namespace qchopper
