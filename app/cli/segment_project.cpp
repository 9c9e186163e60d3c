#include "app/cli/segment_project.h"

#include <unistd.h>

#include <algorithm>

#include "app/cli/segment_values.h"
#include "app/project/presets.h"
#include "app/report/repair_report.h"
#include "app/report/shell_word.h"
#include "base/error.h"
#include "base/staged_folder.h"
#include "base/text.h"
#include "segment/import/inspect.h"
#include "segment/mesh/measure.h"
#include "segment/repair/crumbs.h"
#include "segment/search/rank.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

SearchSettings settings_of(const ProjectArguments& a, double scan_volume_mm3) {
    SearchSettings settings = a.preset ? *preset(*a.preset) : SearchSettings{};
    settings.stop = given_rules(a).value_or(settings.stop);
    if (a.stop) settings.stop.combine = *a.stop == "any" ? Stop::any : Stop::all;
    if (a.fragility) {
        settings.objectives.fragility_form = *a.fragility == "thesis" ? FragilityForm::thesis : FragilityForm::thinness;
    }
    if (a.weights) settings.objectives.weights = weights_from(*a.weights)->over(settings.objectives.weights);
    if (a.beam) settings.beam = static_cast<std::size_t>(*a.beam);
    settings.objectives.crumb_volume_mm3 = a.fragment_volume_mm3.value_or(crumb_share * scan_volume_mm3);
    return settings;
}

RepairChoices repair_of(const ProjectArguments& a) {
    RepairChoices choices = repair_choices(a);
    choices.resolve_self_intersections = a.resolve_self_intersections;
    return choices;
}

void tell_intake(const fs::path& scan, const Intake& intake, Terminal& terminal) {
    const RepairReport& r = intake.report.repair;
    std::string line = scan.filename().string() + ": " + with_commas(intake.mesh.triangles.size()) + " faces, " +
                       size_in_words(bounds(intake.mesh).size()) + ".";
    if (r.holes_filled > 0) line += " " + with_commas(r.holes_filled) + " holes closed.";
    if (r.collapsed > 0) line += " " + with_commas(r.collapsed) + " collapsed faces dropped.";
    if (r.points_copied > 0) line += " " + with_commas(r.points_copied) + " pinched points split.";
    if (r.shells_turned > 0) line += " " + with_commas(r.shells_turned) + " shells turned outwards.";
    terminal.say(line);
}

}  // namespace

RepairChoices repair_choices(const RepairChoiceArguments& a) {
    RepairChoices choices;
    choices.weld_mm = a.weld_mm.value_or(0);
    if (a.fill) choices.fill = *fill_named(*a.fill);
    choices.smooth_marks = a.smooth_marks;
    choices.wrap_mm = a.wrap_mm.value_or(0);
    return choices;
}

std::optional<StopRules> given_rules(const ProjectArguments& a) {
    if (!a.min_cuts && !a.max_faces && !a.max_obb && !a.fits_cell) return std::nullopt;
    StopRules rules;
    rules.min_cuts = a.min_cuts;
    rules.max_faces = a.max_faces;
    rules.max_obb = a.max_obb;
    rules.fits_cell = a.fits_cell;
    if (a.stop) rules.combine = *a.stop == "any" ? Stop::any : Stop::all;
    return rules;
}

fs::path without_slash(const fs::path& folder) {
    return folder.has_filename() ? folder : folder.parent_path();
}

void check_output(const fs::path& out) {
    std::error_code error;
    if (fs::exists(out, error)) {
        throw InputError(InputFault::create, out.string() + " exists already",
                         fs::exists(out / "project.json", error)
                             ? "go on with it by: qchopper prepare " + shell_word(out) + ", or choose another name"
                             : "choose another name");
    }
    const fs::path parent = out.has_parent_path() ? out.parent_path() : fs::path(".");
    if (!fs::is_directory(parent, error)) {
        throw InputError(InputFault::create, out.string() + " cannot be made: there is no folder " + parent.string(),
                         "make that folder first");
    }
    if (::access(parent.c_str(), W_OK) != 0) {
        throw InputError(InputFault::create,
                         out.string() + " cannot be made: " + parent.string() + " cannot be written",
                         "choose another place");
    }
}

bool is_any_given(const ProjectArguments& a) {
    return a.weld_mm || a.fill || a.smooth_marks || a.wrap_mm || a.resolve_self_intersections;
}

IntakeOptions options_of(const ScanSource& scan) {
    IntakeOptions options;
    options.mm_per_unit = mm_per(scan.unit);
    options.scale = scan.scale;
    options.repair = options_of(scan.repair);
    return options;
}

void check_unit(const fs::path& scan, const ProjectArguments& a) {
    if (a.units || scan == "-" || read_mesh(scan).mm_per_unit) return;
    throw InputError(InputFault::use, "the scan has no unit", "say --units mm, cm, m or in");
}

Intake take_in_scan(const fs::path& scan, const ProjectArguments& a, Terminal& terminal) {
    if (scan == "-") {
        throw InputError(InputFault::use, "a project needs its scan again, and standard input is read only once",
                         "save the scan in a file and name that");
    }
    IntakeOptions options;
    if (a.units) options.mm_per_unit = mm_per(unit_named(*a.units));
    options.scale = a.scale.value_or(1);
    options.repair = options_of(repair_of(a));
    Intake intake = take_in(scan, options, terminal.context());
    tell_intake(scan, intake, terminal);
    for (const std::string& warning : intake.report.warnings) terminal.warn(warning);
    return intake;
}

Intake take_in_scan(const Project& project, Terminal& terminal) {
    const ScanSource& s = project.scan;
    Intake intake = take_in(s.path, options_of(s), terminal.context());
    if (to_hex(intake.sha256) != s.sha256) {
        throw InputError(InputFault::mesh, s.path.string() + " is not the scan that the project was made from",
                         "put that scan back, or prepare this one as a new project");
    }
    tell_intake(s.path, intake, terminal);
    return intake;
}

Project new_project(const fs::path& scan, const Intake& intake, const ProjectArguments& a) {
    Project project;
    project.scan.path = fs::absolute(scan);
    project.scan.unit = unit_of(intake.mm_per_unit);
    project.scan.repair = repair_of(a);
    project.scan.scale = a.scale.value_or(1);
    project.scan.sha256 = to_hex(intake.sha256);
    project.scan.centre = intake.centre;
    project.scan.faces = intake.mesh.triangles.size();
    project.scan.volume_mm3 = volume_mm3(intake.mesh);
    project.scan.warnings = intake.report.warnings;
    project.preset = a.preset.value_or("");
    project.settings = settings_of(a, project.scan.volume_mm3);
    project.history.weights_at_start = project.settings.objectives.weights;
    project.crumbs = a.crumbs && *a.crumbs == "drop" ? CrumbChoice::drop : CrumbChoice::keep;
    project.warnings = intake.report.warnings;
    return project;
}

void create_project(const fs::path& folder, const Project& project, const std::optional<Bytes>& cell_file) {
    try {
        StagedFolder aside(folder);
        fs::create_directories(aside.path() / "pieces");
        fs::create_directory(aside.path() / "jobs");
        fs::create_directory(aside.path() / "pictures");
        if (cell_file) write_file(aside.path() / "cell.toml", *cell_file);
        save_project(aside.path(), project);
        aside.move_to_its_place();
    } catch (const fs::filesystem_error& e) {
        throw InputError(InputFault::create, folder.string() + " cannot be made: " + e.code().message(),
                         "choose another place");
    }
}

void take_cell(const fs::path& folder, const fs::path& cell_file, Terminal& terminal) {
    read_cell(cell_file);  // an impossible one is refused before it is taken
    write_file(folder / "cell.toml", read_file(cell_file, settings_limit));
    terminal.say(folder.string() + ": its cell is now that of " + cell_file.string());
    terminal.unchanged = "The project knows its cell now; its decisions are unchanged.";
}

std::string cut_line(const Cut& cut) {
    const Terms& t = cut.chosen.terms;
    std::string made;
    for (const std::string& name : cut.pieces) made += (made.empty() ? "" : ", ") + name;
    // Another than the best may have been accepted; the best is then among those that were passed over. Of totals that
    // differ by a tie none is better.
    const bool is_best = std::all_of(cut.runners_up.begin(), cut.runners_up.end(),
                                     [&](const Ranked& r) { return r.terms.total + tie >= t.total; });
    const std::string which = cut.chosen.normal < 0
                                  ? "given plane"
                                  : (is_best ? "best of " : "one of ") + std::to_string(cut.candidates) + " planes";
    return "cut " + std::to_string(cut.number) + " on piece " + cut.piece + ": " + which + ", total " +
           fixed(t.total, 3) + " (face ratio " + fixed(t.face_ratio, 2) + ", fragility " + fixed(t.fragility, 3) +
           ", piece count " + fixed(t.piece_count, 0) + ", undercut " + fixed(t.undercut, 3) + "); makes " + made +
           (cut.crumbs > 0 ? " and " + std::to_string(cut.crumbs) + " crumbs" : "");
}

}  // namespace qchopper
