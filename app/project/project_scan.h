// The scan of a project: taken in for a new one, and taken in again exactly as the project says.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/project/project.h"
#include "segment/import/import_scan.h"

namespace qchopper {

// What a new project is told.
struct ProjectChoices {
    std::filesystem::path scan;
    std::optional<double> mm_per_unit;  // of the scan; nothing: what its file says
    double scale = 1;
    RepairChoices repair = {};
    std::string preset = {};                         // the name of the settings; empty: none
    SearchSettings settings = {};                    // all but the volume below which solids are no pieces
    std::optional<double> fragment_volume_mm3 = {};  // that one; nothing: a share of the scan's volume
    FragmentChoice fragments = FragmentChoice::keep;
};

// A message says what was done to the scan. Throws what import_scan throws, and InputError (use) for standard input.
ImportedScan import_project_scan(const ProjectChoices& choices, const Context& context);

// The project of a scan before its first cut.
Project new_project(const ProjectChoices& choices, const ImportedScan& imported);

// Likewise; throws InputError (mesh) if the file is another scan by now.
ImportedScan import_project_scan(const Project& project, const Context& context);

}  // namespace qchopper
