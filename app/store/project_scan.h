// Imports the scan of a project: for a new one, or again with the unit, scale and repair that the project records.

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/store/project.h"
#include "cam/toolpath/toolpath_settings.h"
#include "segment/import/import_scan.h"

namespace qchopper {

// Which surface may stay as it is.
struct IgnoreChoices {
    std::optional<std::filesystem::path> painted = {};  // a PLY in which it is marked (segment/io/read_painted.h)
    bool inside = false;                                // what lies inside (segment/access/inside.h)
};

// What an operator chooses for a new project.
struct ProjectChoices {
    std::filesystem::path scan;
    std::optional<double> mm_per_unit;  // of the scan; nothing: as in its file
    double scale = 1;
    std::function<void(Vec3 size)> on_unusual_size = {};  // ImportOptions::on_unusual_size
    RepairChoices repair = {};
    IgnoreChoices ignore = {};
    std::optional<std::filesystem::path> no_cut = {};  // a PLY that marks surface that must not be cut
    std::vector<std::string> proposers = {};           // names of region_methods() (segment/regions/methods.h)
    std::string preset = {};                           // the name of the settings; empty: none
    SearchSettings settings = {};                      // all but the volume below which solids are no pieces
    GivenWeights weights = {};                         // in place of those of the settings
    std::optional<double> fragment_volume_mm3 =
        {};  // solids below are no pieces; nothing: a share of the scan's volume
    FragmentChoice fragments = FragmentChoice::keep;
    std::optional<StructureOptions> load = {};  // Project::load
    // Of the folder (make_project.h).
    std::filesystem::path folder = {};                    // NAME.qch, to be made
    std::optional<std::filesystem::path> cell_file = {};  // to be copied; nothing: no cell yet
    std::vector<std::uint16_t> tools = {};                // Project::tools
    double finest_tool_mm = 0;                            // balls of a smaller diameter are none of the tools
    FineTools fine_tools = FineTools::worthwhile;         // `none` leaves tools out too
    std::optional<std::filesystem::path> plan = {};       // whose cuts are to be made
};

// Reports in a message what was done to the scan. Throws what import_scan throws, and InputError (use) for standard
// input.
ImportedScan import_project_scan(const ProjectChoices& choices, const Context& context);

// Imports the scan of an existing project. Throws in addition InputError (mesh) if the file's SHA-256 is not the one in
// the project.
ImportedScan import_project_scan(const Project& project, const Context& context);

// The project of an imported scan without a decision; its pieces are not listed yet (replay.h, record). O(faces).
Project new_project(const ProjectChoices& choices, const ImportedScan& imported);

}  // namespace qchopper
