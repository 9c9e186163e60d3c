// From a scan to job files, or on with a project that is not finished yet.

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/project_arguments.h"
#include "app/cli/version.h"
#include "app/project/project_folder.h"
#include "app/project/shell_word.h"
#include "app/report/prepare_report.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& what, const std::string& to_do) {
    throw InputError(InputFault::use, what, to_do);
}

// Options that a new project needs, and that an old one has already.
void check_options(const PrepareArguments& a, bool is_project) {
    if (!is_project) {
        check_unit(a.input, a);
        if (!a.cell) refuse("no cell is named", "pass --cell FILE, for example cells/foam-1.toml");
        if (!a.out) refuse("no project folder is named", "pass -o NAME.qch");
        return;
    }
    const bool has_any = a.units || a.scale || a.preset || given_rules(a) || a.stop || a.fragility || a.weights ||
                         a.beam || a.fragments || a.fragment_volume_mm3 || a.out || is_any_given(a) ||
                         (a.cell && fs::exists(a.input / "cell.toml"));
    if (has_any) {
        refuse(a.input.string() + " is a project: its settings were fixed when it was made",
               "leave the options out to go on with it, or prepare the scan again");
    }
}

// The rest of the way once the scan is in.
int finish(OpenProject& open, std::optional<double> time_limit_s, Terminal& terminal) {
    const auto keep_words = [&](const Segmentation& s) {
        terminal.unchanged = kept_cuts(s.cuts.size(), open.folder()) + "; go on with: qchopper prepare " +
                             shell_word(open.folder()) + ".";
    };
    keep_words(open.segmentation());
    if (open.segmentation().pieces.empty()) {
        throw InputError(InputFault::mesh, open.project().scan.path.string() + " holds nothing but fragments",
                         "check the scan");
    }
    if (open.project().stage == Stage::cutting) {
        const auto on_round = [&](const Segmentation& s) {
            keep_words(s);
            terminal.say(cut_line(s.cuts.back()));
        };
        const SearchEnd end = open.search(open.fits_cell(), on_round, terminal.context(), time_limit_s);
        terminal.warn(open.segmentation().warnings);
        if (!end.is_finished()) terminal.warn(early_end(end.sentence));
    }
    const PreparedProject prepared = open.prepare(version, terminal.context());
    terminal.warn(warnings(prepared));
    terminal.show(table(prepared, open.setups()->cell()));
    terminal.json(document(prepared, open.setups()->cell()));
    return prepared.project.do_rules_hold() && prepared.all_fit() ? exit_done : exit_demand_broken;
}

int start(const PrepareArguments& a, Terminal& terminal) {
    const fs::path out = without_slash(*a.out);
    check_output(out);
    read_cell(*a.cell);  // an impossible one is refused before anything is made
    const Bytes cell_file = read_file(*a.cell, settings_limit);
    const ProjectChoices choices = choices_of(a.input, a);
    ImportedScan imported = import_project_scan(choices, terminal.context());
    terminal.warn(imported.report.warnings);
    Project project = new_project(choices, imported);
    if (!project.settings.stop.is_any_set()) project.settings.stop.fits_cell = true;
    create_project(out, project, cell_file);
    const ProjectLock lock(out);
    OpenProject open(out, std::move(project), [&] { return std::move(imported.mesh); });
    return finish(open, a.time_limit_s, terminal);
}

int go_on(const fs::path& folder, const PrepareArguments& a, Terminal& terminal) {
    const ProjectLock lock(folder);
    OpenProject open(folder, terminal.context());
    clear_leftovers(folder);
    if (a.cell) {  // segment may have made it without one
        take_cell(folder, *a.cell, terminal.context());
        terminal.unchanged = "The project knows its cell now; its decisions are unchanged.";
    }
    open.check_cell();
    terminal.unchanged = "The project is unchanged.";
    open.scan();
    const Project& project = open.project();
    terminal.say(folder.string() + ": goes on after " + std::to_string(project.cuts.size()) + " cuts");
    if (project.beam) terminal.say("The beam of " + std::to_string(project.beam->branches.size()) + " goes on.");
    return finish(open, a.time_limit_s, terminal);
}

}  // namespace

int run(const PrepareArguments& arguments, Terminal& terminal) {
    const bool is_project = is_project_folder(arguments.input);
    check_options(arguments, is_project);
    if (!is_project) return start(arguments, terminal);
    return go_on(without_slash(arguments.input), arguments, terminal);
}

}  // namespace qchopper
