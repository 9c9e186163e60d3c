#include "app/project/project_scan.h"

#include "base/error.h"
#include "base/text.h"
#include "segment/import/inspect.h"
#include "segment/mesh/measure.h"
#include "segment/repair/crumbs.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

void tell_intake(const fs::path& scan, const Intake& intake, const Context& context) {
    const RepairReport& r = intake.report.repair;
    std::string line = scan.filename().string() + ": " + with_commas(intake.mesh.triangles.size()) + " faces, " +
                       size_in_words(bounds(intake.mesh).size()) + ".";
    if (r.holes_filled > 0) line += " " + with_commas(r.holes_filled) + " holes closed.";
    if (r.collapsed > 0) line += " " + with_commas(r.collapsed) + " collapsed faces dropped.";
    if (r.points_copied > 0) line += " " + with_commas(r.points_copied) + " pinched points split.";
    if (r.shells_turned > 0) line += " " + with_commas(r.shells_turned) + " shells turned outwards.";
    context.message(line);
}

IntakeOptions options_of(const ProjectChoices& choices) {
    IntakeOptions options;
    options.mm_per_unit = choices.mm_per_unit;
    options.scale = choices.scale;
    options.repair = qchopper::options_of(choices.repair);
    return options;
}

}  // namespace

Intake take_in_scan(const ProjectChoices& choices, const Context& context) {
    if (choices.scan == "-") {
        throw InputError(InputFault::use, "a project needs its scan again, and standard input is read only once",
                         "save the scan in a file and name that");
    }
    Intake intake = take_in(choices.scan, options_of(choices), context);
    tell_intake(choices.scan, intake, context);
    return intake;
}

Intake take_in_scan(const Project& project, const Context& context) {
    const ScanSource& s = project.scan;
    Intake intake = take_in(s.path, options_of(ProjectChoices{s.path, mm_per(s.unit), s.scale, s.repair}), context);
    if (to_hex(intake.sha256) != s.sha256) {
        throw InputError(InputFault::mesh, s.path.string() + " is not the scan that the project was made from",
                         "put that scan back, or prepare this one as a new project");
    }
    tell_intake(s.path, intake, context);
    return intake;
}

Project new_project(const ProjectChoices& choices, const Intake& intake) {
    Project project;
    ScanSource& scan = project.scan;
    scan.path = fs::absolute(choices.scan);
    scan.unit = unit_of(intake.mm_per_unit);
    scan.repair = choices.repair;
    scan.scale = choices.scale;
    scan.sha256 = to_hex(intake.sha256);
    scan.centre = intake.centre;
    scan.faces = intake.mesh.triangles.size();
    scan.volume_mm3 = volume_mm3(intake.mesh);
    scan.warnings = intake.report.warnings;
    project.preset = choices.preset;
    project.settings = choices.settings;
    project.settings.objectives.crumb_volume_mm3 = choices.crumb_volume_mm3.value_or(crumb_share * scan.volume_mm3);
    project.history.weights_at_start = project.settings.objectives.weights;
    project.crumbs = choices.crumbs;
    project.warnings = intake.report.warnings;
    return project;
}

}  // namespace qchopper
