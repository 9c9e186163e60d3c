// Cuts a scan one decision at a time: makes the project, opens it again, refuses what does not go together.

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/segment_decide.h"
#include "app/cli/segment_project.h"
#include "app/cli/segment_setups.h"
#include "app/cli/segment_values.h"
#include "app/project/products.h"
#include "app/project/replay_plan.h"
#include "app/report/segment_report.h"
#include "app/report/shell_word.h"

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
        {a.crumbs.has_value(), "--crumbs"},       {a.out.has_value(), "--out"},
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
    if (!a.out) refuse("no project folder is named", "say -o NAME.qch");
    if (a.fits_cell && !a.cell) refuse("--fits-cell needs a cell", "say --cell FILE, for example cells/foam-1.toml");
}

int tell(SegmentAnswer answer, const OpenProject& project, Terminal& terminal) {
    answer.pieces_written = project.are_pieces_written();
    for (const std::string& line : lines(answer, project.folder(), project.project())) terminal.show(line);
    terminal.json(document(answer, project.folder(), project.project()));
    return answer.is_demand_met ? exit_done : exit_demand_broken;
}

// Opens the project in a folder whose lock is held.
int decide_in(const fs::path& folder, Project project, std::optional<TriangleMesh> scan, const SegmentArguments& a,
              Terminal& terminal) {
    std::optional<Cell> cell;
    if (fs::exists(folder / "cell.toml")) cell = read_cell(folder / "cell.toml");
    const Project as_loaded = project;
    OpenProject open(folder, std::move(project), [&]() -> TriangleMesh {
        return scan ? std::move(*scan) : std::move(take_in_scan(as_loaded, terminal).mesh);
    });
    std::optional<Setups> setups;
    FitsCell fits_cell;
    if (cell) {
        setups.emplace(*cell);
        fits_cell = [&](const Piece& piece) { return setups->of(piece).envelope.fits(); };
    }
    if (a.write_pieces) open.keep_pieces_written();
    return tell(decide(open, a, fits_cell, terminal), open, terminal);
}

std::string kept_words(const Segmentation& segmentation, const fs::path& folder) {
    return "The " + std::to_string(segmentation.cuts.size()) + " cuts made so far are kept in " + folder.string() + ".";
}

int replay_in(const fs::path& folder, Project project, TriangleMesh scan, const Plan& plan, bool write_pieces,
              Terminal& terminal) {
    OpenProject open(folder, std::move(project), [&] { return std::move(scan); });
    if (write_pieces) open.keep_pieces_written();
    Segmentation segmentation = open.segmentation();
    std::size_t discarded = 0;
    const auto keep = [&](const Segmentation& s) {
        open.adopt(s);
        terminal.unchanged = kept_words(s, folder);
        const bool is_cut = s.discarded.size() == discarded;
        terminal.say(is_cut ? cut_line(s.cuts.back()) : discarded_lines(open.project()).back());
        discarded = s.discarded.size();
    };
    const PlanReplay replay = replay_plan(plan, open.project().scan, segmentation, open.project().settings, open.book(),
                                          keep, terminal.context());
    SegmentAnswer answer;
    answer.notes = replay.notes;
    char off[32];
    std::snprintf(off, sizeof off, "%.3g %%", 100 * replay.largest_volume_off);
    const std::string until = std::to_string(segmentation.cuts.size()) + " of " + std::to_string(plan.cuts.size());
    const std::string left_out =
        std::to_string(segmentation.discarded.size()) + " of " + std::to_string(plan.discards.size());
    answer.done = until + " cuts of the plan are made" +
                  (plan.discards.empty() ? "" : ", " + left_out + " pieces of it discarded") +
                  "; the volumes of the pieces differ by at most " + off + ".";
    if (!replay.applies) {
        answer.is_demand_met = false;
        answer.notes.push_back("The plan does not apply: " + replay.why + ". " + kept_words(segmentation, folder));
    }
    return tell(answer, open, terminal);
}

int start(const SegmentArguments& a, Terminal& terminal) {
    const fs::path out = without_slash(*a.out);
    check_output(out);
    std::optional<Bytes> cell_file;
    if (a.cell) {
        read_cell(*a.cell);  // an impossible one is refused before anything is made
        cell_file = read_file(*a.cell, settings_limit);
    }
    std::optional<Plan> plan;
    if (a.replayed) {
        const Bytes text = read_file(*a.replayed, record_limit);
        plan = plan_from_text({reinterpret_cast<const char*>(text.data()), text.size()}, a.replayed->string());
    }
    Intake intake = take_in_scan(a.input, a, terminal);
    Project project = new_project(a.input, intake, a);
    if (plan) {
        if (!a.preset) {
            const Weights weights = a.weights ? weights_from(*a.weights)->over(plan->weights) : plan->weights;
            project.settings.objectives.weights = project.history.weights_at_start = weights;
        }
        const std::string why = misfit(*plan, project.scan, intake.mesh);
        if (!why.empty()) {
            SegmentAnswer answer;
            answer.is_demand_met = false;
            answer.notes = {"The plan does not apply: " + why + ". Nothing was made."};
            terminal.show(answer.notes.front());
            terminal.json(document(answer, out, project));
            return exit_demand_broken;
        }
    }
    record(project, uncut(intake.mesh, project.settings.objectives.crumb_volume_mm3));
    create_project(out, project, cell_file);
    terminal.unchanged = "The project " + out.string() + " is made, with no cut.";
    const ProjectLock lock(out);
    if (plan) return replay_in(out, std::move(project), std::move(intake.mesh), *plan, a.write_pieces, terminal);
    SegmentArguments decisions = a;
    decisions.weights.reset();  // the project is made with them
    return decide_in(out, std::move(project), std::move(intake.mesh), decisions, terminal);
}

}  // namespace

int run(const SegmentArguments& a, Terminal& terminal) {
    std::error_code error;
    const bool is_project = fs::is_directory(a.input, error);
    const std::string action = action_of(a);
    check_together(a, action, is_project);
    if (!is_project) {
        check_scan(a, action);
        return start(a, terminal);
    }
    if (!fs::exists(a.input / "project.json", error)) {
        throw InputError(InputFault::missing, a.input.string() + " is a folder, but no project",
                         "name a scan, or a folder that segment or prepare has made");
    }
    check_project(a, action);
    terminal.unchanged = "The project is unchanged.";
    const fs::path folder = without_slash(a.input);
    const ProjectLock lock(folder);
    Project project = load_project(folder);
    clear_leftovers(folder);
    if (a.cell) take_cell(folder, *a.cell, terminal);
    return decide_in(folder, std::move(project), std::nullopt, a, terminal);
}

}  // namespace qchopper
