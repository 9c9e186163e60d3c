// Tables of options; the first violation in their order is reported.

#include "app/cli/arguments/check_arguments.h"

#include <utility>

#include "app/cli/arguments/project_arguments.h"
#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/printable.h"
#include "segment/io/read_mesh.h"

namespace qchopper {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& to_do) {
    throw InputError(InputFault::use, what, to_do);
}

// What segment is to do, and the options and inputs that it takes.
struct Action {
    bool is_given;
    const char* option;
    bool takes_piece;    // --piece
    bool takes_weights;  // --weights, where the input is a project
    bool takes_scan;     // a scan as the input
};

Action action_of(const SegmentArguments& a) {
    const Action actions[] = {{a.step, "--step", true, true, true},
                              {a.accept.has_value(), "--accept", true, true, false},
                              {a.plane.has_value(), "--plane", true, true, true},
                              {a.discard.has_value(), "--discard", false, false, true},
                              {a.undo, "--undo", false, false, false},
                              {a.redo, "--redo", false, false, false},
                              {a.preview.has_value(), "--preview", true, true, true},
                              {a.reset, "--reset", false, false, false},
                              {a.goes_on, "--auto", false, true, true},
                              {a.plan.has_value(), "--plan", false, false, false},
                              {a.replayed.has_value(), "--replay", false, true, true},
                              {a.regions.has_value(), "--regions", false, false, false}};
    Action action{false, "this", false, true, true};
    for (const Action& next : actions) {
        if (!next.is_given) continue;
        if (action.is_given) {
            refuse(std::string(action.option) + " and " + next.option + " exclude each other",
                   "run one after the other");
        }
        action = next;
    }
    return action;
}

// The first option given that only a new project takes; empty: none.
std::string new_project_option(const ProjectArguments& a, bool is_replay_given = false) {
    const bool is_repair_given =
        a.snap_borders_mm || a.fill || a.smooth_pen_grooves || a.alpha_wrap_mm || a.resolve_self_intersections;
    const std::pair<bool, const char*> options[] = {{a.units.has_value(), "--units"},
                                                    {a.scale.has_value(), "--scale"},
                                                    {a.size_ok, "--size-ok"},
                                                    {a.preset.has_value(), "--preset"},
                                                    {!a.tools.empty(), "--tools"},
                                                    {a.finest_tool.has_value(), "--finest-tool"},
                                                    {a.fine.has_value(), "--fine"},
                                                    {a.fragment_volume_mm3.has_value(), "--fragment-volume"},
                                                    {a.fragments.has_value(), "--fragments"},
                                                    {a.out.has_value(), "--out"},
                                                    {a.fragility.has_value(), "--fragility"},
                                                    {is_replay_given, "--replay"},
                                                    {is_repair_given, "a choice of repair"},
                                                    {a.ignore_surface.has_value(), "--ignore-surface"},
                                                    {a.ignore_inside, "--ignore-inside"},
                                                    {a.print_volume.has_value(), "--print-volume"},
                                                    {a.utilization.has_value(), "--utilization"},
                                                    {!a.forbidden.empty(), "--forbid"},
                                                    {a.connector.has_value(), "--connector"},
                                                    {a.structure.has_value(), "--structure"},
                                                    {a.normals.has_value(), "--normals"},
                                                    {a.offsets.has_value(), "--offsets"},
                                                    {a.offset_step_mm.has_value(), "--offset-step"},
                                                    {a.planes.has_value(), "--planes"},
                                                    {a.propose.has_value(), "--propose"},
                                                    {a.symmetry, "--symmetry"},
                                                    {a.no_cut.has_value(), "--no-cut"}};
    for (const auto& [is_given, name] : options) {
        if (is_given) return name;
    }
    return {};
}

bool is_second_cell(const ProjectArguments& a) {
    std::error_code error;
    return a.cell && std::filesystem::exists(a.input / "cell.toml", error);
}

void check_unit(const ProjectArguments& a) {
    if (a.units || a.input == "-" || read_mesh(a.input).mm_per_unit) return;
    refuse("the scan has no unit", "pass --units mm, cm, m or in");
}

void check_action(const SegmentArguments& a, const Action& action) {
    const std::string option = action.option;
    if (a.piece && !action.takes_piece) {
        refuse("--piece has no effect on " + option, "use it with --step, --accept, --plane or --preview");
    }
    if (a.top && !a.step) refuse("--top has no effect on " + option, "use it with --step");
    if (a.expected_plane && !a.accept) refuse("--expect-plane has no effect on " + option, "use it with --accept");
    if (a.tried_weights && !a.step && !a.preview) {
        refuse("--try-weights has no effect on " + option, "use it with --step or --preview; --weights decides");
    }
    if (a.preview_setups && !a.preview) refuse("--setups has no effect on " + option, "use it with --preview");
    if (a.time_limit_s && !a.goes_on) refuse("--time-limit has no effect on " + option, "use it with --auto");
    std::error_code error;
    if (a.weights && !action.takes_weights && std::filesystem::is_directory(a.input, error)) {
        refuse("--weights and " + option + " are two decisions", "run one after the other");
    }
}

void check_project(const SegmentArguments& a) {
    const std::string input = a.input.string();
    ProjectArguments of_project = a;
    if (a.regions) {
        if (!a.out) refuse("--regions writes a file", "name it: -o regions.png, or regions.ply");
        of_project.out.reset();
    }
    const std::string option = new_project_option(of_project, a.replayed.has_value());
    if (!option.empty()) {
        refuse(input + " is a project: " + option + " belongs to a new one",
               "leave it out, or make a new project of the scan");
    }
    if (is_second_cell(a)) {
        refuse(input + " is a project that has a cell already", "leave --cell out, or make a new project of the scan");
    }
    if ((given_rules(a) || a.stop || a.max_cuts || a.beam) && !a.goes_on) {
        refuse("stop rules, --max-cuts and --beam are options of the search", "use them with --auto");
    }
}

void check_scan(const SegmentArguments& a, const Action& action) {
    std::error_code error;
    if (!action.takes_scan && !std::filesystem::exists(a.input, error)) {
        throw InputError(InputFault::missing, "there is no project " + a.input.string(),
                         "name a folder that prepare has made");
    }
    if (!action.takes_scan) {
        refuse(a.input.string() + " is a scan: " + action.option + " needs a project",
               "make one first: qchopper segment " + shell_word(a.input) + " --units UNIT -o NAME.qch");
    }
    check_unit(a);
    if (!a.out) refuse("no project folder is named", "pass -o NAME.qch");
    for (const auto& [is_given, option] : {std::pair{!a.tools.empty(), "--tools"},
                                           {a.finest_tool.has_value(), "--finest-tool"},
                                           {a.fine.has_value(), "--fine"}}) {
        if (is_given && !a.cell)
            refuse(std::string(option) + " needs a cell", "pass --cell FILE, which lists the tools");
    }
    if (a.fits_cell && !a.cell) refuse("--fits-cell needs a cell", "pass --cell FILE, for example cells/foam-1.toml");
}

}  // namespace

void check_arguments(const PrepareArguments& a) {
    if (!is_project_folder(a.input)) {
        check_unit(a);
        if (!a.cell) refuse("no cell is named", "pass --cell FILE, for example cells/foam-1.toml");
        if (!a.out) refuse("no project folder is named", "pass -o NAME.qch");
        return;
    }
    if (!new_project_option(a).empty() || given_rules(a) || a.stop || a.max_cuts || a.weights || a.beam ||
        is_second_cell(a)) {
        refuse(a.input.string() + " is a project: its settings were fixed when it was made",
               "leave the options out to go on with it, or prepare the scan again");
    }
}

void check_arguments(const SegmentArguments& a) {
    const Action action = action_of(a);
    check_action(a, action);
    if (is_project_folder(a.input)) return check_project(a);
    check_scan(a, action);
}

void check_arguments(const CellSimArguments& a) {
    if (a.drop.empty() && !a.list_faults) refuse("no drop folder is named", "pass --drop FOLDER");
    if (a.picture && !a.cell) refuse("--picture needs the machine of a cell file", "pass --cell FILE");
}

void check_arguments(const SubmitArguments& a) {
    const bool is_local = a.engine == "local";
    if (is_local && a.is_only_written)
        refuse("--print writes a script for Slurm", "leave --print or --engine local out");
    if (is_local && !a.options.empty()) refuse("what follows -- is for sbatch", "leave it or --engine local out");
    if (!is_local && a.memory_mb) refuse("--memory is for --engine local", "give Slurm -- --mem=SIZE");
}

}  // namespace qchopper
