// Cuts a scan one decision at a time: makes the project, opens it again, refuses what does not go together.

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/option_values.h"
#include "app/cli/project_arguments.h"
#include "app/project/project_folder.h"
#include "app/project/replay.h"
#include "app/project/replay_plan.h"
#include "app/project/shell_word.h"
#include "app/report/segment_report.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& what, const std::string& to_do) {
    throw InputError(InputFault::use, what, to_do);
}

// What is to be done, as it was typed; one at most.
std::string action_of(const SegmentArguments& a) {
    std::string action;
    const std::pair<bool, const char*> all[] = {{a.step, "--step"},
                                                {a.accept.has_value(), "--accept"},
                                                {a.plane.has_value(), "--plane"},
                                                {a.discard.has_value(), "--discard"},
                                                {a.undo, "--undo"},
                                                {a.redo, "--redo"},
                                                {a.preview.has_value(), "--preview"},
                                                {a.reset, "--reset"},
                                                {a.goes_on, "--auto"},
                                                {a.plan.has_value(), "--plan"},
                                                {a.replayed.has_value(), "--replay"}};
    for (const auto& [is_given, name] : all) {
        if (!is_given) continue;
        if (!action.empty()) refuse(action + " and " + name + " are two things at once", "say one after the other");
        action = name;
    }
    return action;
}

bool is_one_of(const std::string& action, std::initializer_list<const char*> all) {
    return std::any_of(all.begin(), all.end(), [&](const char* a) { return action == a; });
}

void check_together(const SegmentArguments& a, const std::string& action, bool is_project) {
    const std::string doing = action.empty() ? "this" : action;
    if (a.piece && !is_one_of(action, {"--step", "--accept", "--plane", "--preview"})) {
        refuse("--piece says nothing to " + doing, "use it with --step, --accept, --plane or --preview");
    }
    if (a.top && action != "--step") refuse("--top says nothing to " + doing, "use it with --step");
    if (a.time_limit_s && action != "--auto") refuse("--time-limit says nothing to " + doing, "use it with --auto");
    if (is_project && a.weights && is_one_of(action, {"--discard", "--undo", "--redo", "--reset", "--plan"})) {
        refuse("--weights and " + action + " are two decisions", "say one after the other");
    }
}

void check_project(const SegmentArguments& a, const std::string& action) {
    const std::pair<bool, const char*> fixed_ones[] = {
        {a.units.has_value(), "--units"},         {a.scale.has_value(), "--scale"},
        {a.preset.has_value(), "--preset"},       {a.fragment_volume_mm3.has_value(), "--fragment-volume"},
        {a.fragments.has_value(), "--fragments"}, {a.out.has_value(), "--out"},
        {a.fragility.has_value(), "--fragility"}, {a.replayed.has_value(), "--replay"},
        {is_any_given(a), "a choice of repair"}};
    for (const auto& [is_given, name] : fixed_ones) {
        if (is_given) {
            refuse(a.input.string() + " is a project: " + name + " belongs to a new one",
                   "leave it out, or make a new project of the scan");
        }
    }
    std::error_code error;
    if (a.cell && fs::exists(a.input / "cell.toml", error)) {
        refuse(a.input.string() + " is a project that knows its cell already",
               "leave --cell out, or make a new project of the scan");
    }
    if ((given_rules(a) || a.stop || a.beam) && action != "--auto") {
        refuse("stop rules and --beam tell the search how to go on", "use them with --auto");
    }
}

void check_scan(const SegmentArguments& a, const std::string& action) {
    if (is_one_of(action, {"--accept", "--discard", "--undo", "--redo", "--reset", "--plan"})) {
        refuse(a.input.string() + " is a scan: " + action + " needs a project",
               "make one first: qchopper segment " + shell_word(a.input) + " --units UNIT -o NAME.qch");
    }
    check_unit(a.input, a);
    if (!a.out) refuse("no project folder is named", "pass -o NAME.qch");
    if (a.fits_cell && !a.cell) refuse("--fits-cell needs a cell", "pass --cell FILE, for example cells/foam-1.toml");
}

int tell(SegmentAnswer answer, const OpenProject& project, Terminal& terminal) {
    answer.pieces_written = project.are_pieces_written();
    terminal.warn(answer.warnings);
    terminal.show(lines(answer, project.folder(), project.project()));
    terminal.json(document(answer, project.folder(), project.project()));
    return answer.is_demand_met ? exit_done : exit_demand_broken;
}

// The lock of the project is held.
int decide_in(OpenProject& open, const std::optional<GivenWeights>& weights, const SegmentArguments& a,
              Terminal& terminal) {
    open.setups();  // a cell file that is wrong is told before anything is decided
    if (a.write_pieces) open.keep_pieces_written();
    SegmentAnswer answer;
    if (weights) answer = change_weights(open, weights->over(open.project().settings.objectives.weights));
    if (!answer.done.empty()) terminal.unchanged = "The weights are changed; the cuts are unchanged.";
    const auto is_beam = [&] { return open.project().settings.beam > 1; };
    SearchListener listener;
    listener.on_kept = [&](std::size_t cuts) {
        terminal.unchanged = kept_cuts(cuts, open.folder(), is_beam()) + "; go on by --auto.";
    };
    listener.on_round = [&](const Segmentation& best) {
        terminal.say((is_beam() ? "best so far: " : "") + cut_line(best.cuts.back()));
    };
    return tell(decide(open, request_of(a), listener, terminal.context(), std::move(answer)), open, terminal);
}

int replay_in(OpenProject& open, const Plan& plan, Terminal& terminal) {
    std::size_t discarded = 0;
    const auto on_decision = [&](const Segmentation& s) {
        terminal.unchanged = kept_cuts(s.cuts.size(), open.folder()) + ".";
        const bool is_cut = s.discarded.size() == discarded;
        terminal.say(is_cut ? cut_line(s.cuts.back()) : discarded_lines(open.project()).back());
        discarded = s.discarded.size();
    };
    return tell(make_cuts_of(plan, open, on_decision, terminal.context()), open, terminal);
}

std::optional<Plan> plan_of(const SegmentArguments& a) {
    if (!a.replayed) return std::nullopt;
    const Bytes text = read_file(*a.replayed, record_limit);
    return plan_from_text({reinterpret_cast<const char*>(text.data()), text.size()}, a.replayed->string());
}

// The weights of a plan are its project's too, unless a preset or the arguments say others.
void take_weights(Project& project, const Plan& plan, const SegmentArguments& a) {
    if (a.preset) return;
    const Weights weights = a.weights ? weights_from(*a.weights)->over(plan.weights) : plan.weights;
    project.settings.objectives.weights = project.history.weights_at_start = weights;
}

int tell_misfit(const std::string& why, const fs::path& out, const Project& project, Terminal& terminal) {
    SegmentAnswer answer;
    answer.is_demand_met = false;
    answer.notes = {"The plan does not apply: " + why + ". Nothing was made."};
    terminal.show(answer.notes);
    terminal.json(document(answer, out, project));
    return exit_demand_broken;
}

int start(const SegmentArguments& a, Terminal& terminal) {
    const fs::path out = without_slash(*a.out);
    check_output(out);
    std::optional<Bytes> cell_file;
    if (a.cell) {
        read_cell(*a.cell);  // an impossible one is refused before anything is made
        cell_file = read_file(*a.cell, settings_limit);
    }
    const std::optional<Plan> plan = plan_of(a);
    const ProjectChoices choices = choices_of(a.input, a);
    ImportedScan imported = import_project_scan(choices, terminal.context());
    terminal.warn(imported.report.warnings);
    Project project = new_project(choices, imported);
    if (plan) {
        take_weights(project, *plan, a);
        const std::string why = misfit(*plan, project.scan, imported.mesh);
        if (!why.empty()) return tell_misfit(why, out, project, terminal);
    }
    record(project, uncut(imported.mesh, project.settings.objectives.fragment_volume_mm3));
    create_project(out, project, cell_file);
    terminal.unchanged = "The project " + out.string() + " is made, with no cut.";
    const ProjectLock lock(out);
    OpenProject open(out, std::move(project), [&] { return std::move(imported.mesh); });
    if (!plan) return decide_in(open, std::nullopt, a, terminal);  // it is made with the weights that were given
    if (a.write_pieces) open.keep_pieces_written();
    return replay_in(open, *plan, terminal);
}

}  // namespace

int run(const SegmentArguments& a, Terminal& terminal) {
    const std::string action = action_of(a);
    std::error_code error;
    check_together(a, action, fs::is_directory(a.input, error));
    if (!is_project_folder(a.input)) {
        check_scan(a, action);
        return start(a, terminal);
    }
    check_project(a, action);
    terminal.unchanged = "The project is unchanged.";
    const fs::path folder = without_slash(a.input);
    const ProjectLock lock(folder);
    OpenProject open(folder, terminal.context());
    clear_leftovers(folder);
    if (a.cell) {
        take_cell(folder, *a.cell, terminal.context());
        terminal.unchanged = "The project knows its cell now; its decisions are unchanged.";
    }
    return decide_in(open, a.weights ? weights_from(*a.weights) : std::nullopt, a, terminal);
}

}  // namespace qchopper
