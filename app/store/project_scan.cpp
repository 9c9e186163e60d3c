// The import is that of segment/import; the new project is filled field by field.

#include "app/store/project_scan.h"

#include "base/error.h"
#include "base/text.h"
#include "segment/import/inspect.h"
#include "segment/mesh/measure.h"
#include "segment/repair/fragments.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

void report_import(const fs::path& scan, const ImportedScan& imported, const Context& context) {
    const RepairReport& r = imported.report.repair;
    std::string line = scan.filename().string() + ": " + with_commas(imported.mesh.triangles.size()) + " faces, " +
                       describe_size(bounds(imported.mesh).size()) + ".";
    if (r.holes_filled > 0) line += " " + with_commas(r.holes_filled) + " holes closed.";
    if (r.collapsed > 0) line += " " + with_commas(r.collapsed) + " collapsed faces dropped.";
    if (r.points_copied > 0) line += " " + with_commas(r.points_copied) + " non-manifold vertices split.";
    if (r.shells_reoriented > 0) line += " " + with_commas(r.shells_reoriented) + " shells turned outwards.";
    context.message(line);
}

ImportOptions options_of(const ProjectChoices& choices) {
    ImportOptions options;
    options.mm_per_unit = choices.mm_per_unit;
    options.scale = choices.scale;
    options.on_unusual_size = choices.on_unusual_size;
    options.repair = qchopper::options_of(choices.repair);
    return options;
}

}  // namespace

ImportedScan import_project_scan(const ProjectChoices& choices, const Context& context) {
    if (choices.scan == "-") {
        throw InputError(InputFault::use, "a project needs its scan again, and standard input is read only once",
                         "save the scan in a file and name that");
    }
    ImportedScan imported = import_scan(choices.scan, options_of(choices), context);
    report_import(choices.scan, imported, context);
    return imported;
}

ImportedScan import_project_scan(const Project& project, const Context& context) {
    const ScanSource& s = project.scan;
    ImportedScan imported =
        import_scan(s.path, options_of(ProjectChoices{s.path, mm_per(s.unit), s.scale, {}, s.repair}), context);
    if (imported.sha256 != s.sha256) {
        throw InputError(InputFault::mesh, s.path.string() + " is not the scan that the project was made from",
                         "put that scan back, or prepare this one as a new project");
    }
    report_import(s.path, imported, context);
    return imported;
}

Project new_project(const ProjectChoices& choices, const ImportedScan& imported) {
    Project project;
    ScanSource& scan = project.scan;
    scan.path = fs::absolute(choices.scan);
    scan.unit = unit_of(imported.mm_per_unit);
    scan.repair = choices.repair;
    scan.scale = choices.scale;
    scan.sha256 = imported.sha256;
    scan.centre = imported.centre;
    scan.faces = imported.mesh.triangles.size();
    scan.volume_mm3 = volume_mm3(imported.mesh);
    scan.warnings = imported.report.warnings;
    project.preset = choices.preset;
    project.settings = choices.settings;
    project.settings.objectives.weights = choices.weights.over(choices.settings.objectives.weights);
    project.settings.objectives.fragment_volume_mm3 =
        choices.fragment_volume_mm3.value_or(fragment_share * scan.volume_mm3);
    project.history.weights_at_start = project.settings.objectives.weights;
    project.fragments = choices.fragments;
    project.load = choices.load;
    project.tools = choices.tools;
    project.has_all_fine_tools = choices.fine_tools == FineTools::all;
    project.warnings = imported.report.warnings;
    return project;
}

}  // namespace qchopper
