// The loop, with what an operator is told of it.

#include "app/engine/prepare_project.h"

#include "app/engine/loop.h"
#include "app/store/project_lines.h"
#include "base/error.h"
#include "base/printable.h"

namespace qchopper {
namespace {

void discard(OpenProject& project, const DiscardRequest& request, const ProjectContext& context) {
    const std::vector<std::string> names = pieces_meant(request, project.segmentation());
    if (names.empty()) return context.message(none_is_below(request));
    if (!project.decide_discard(names)) {
        throw InputError(InputFault::use, "every piece is meant to be discarded", "leave one, or prepare another scan");
    }
    for (const std::string& line : discarded_lines(project.project())) context.message(line);
}

PreparedProject finish(OpenProject& project, const PrepareOptions& options, const ProjectContext& context) {
    const bool is_empty = project.segmentation().pieces.empty();
    LoopObserver observer;
    observer.on_decision = told_decisions(
        project,
        [folder = project.folder().string()](const std::string& kept) {
            return Sentence::with_key("go_on_with_prepare", {kept, folder}, kept + "; it can go on from there.");
        },
        false, context);
    if (options.has_programs) project.set_has_programs(*options.has_programs);
    if (is_empty) {
        throw InputError(InputFault::mesh, project.project().scan.path.string() + " holds nothing but fragments",
                         "check the scan");
    }
    if (options.discard) discard(project, *options.discard, context);
    observer.on_cut = [&, was_done = project.project().stage == Stage::done](const std::optional<SearchEnd>& end) {
        if (end) context.warn(texts(project.segmentation().warnings));
        if (end && end->is_out_of_time()) {
            context.warn(early_end(end->sentence));
        } else if (!was_done && !project.project().do_rules_hold()) {
            context.warn(early_end(project.project().ended_because));
        }
    };
    LoopOptions loop;
    loop.program_version = options.program_version;
    if (options.time_limit_s) loop.time_limit.emplace(TimeLimit{*options.time_limit_s});
    if (options.has_items) loop.last = LoopStep::setups;
    PreparedProject prepared = *run_loop(project, loop, observer, context).prepared;
    if (options.has_items && project.project().stage == Stage::cutting) {
        context.warn(Sentence::with_key("no_items_yet", {project.folder().string()},
                                        "no items are written before the cutting has ended"));
    } else if (options.has_items) {
        prepared.items = project.write_items(prepared, options.program_version, context);
    }
    return prepared;
}

}  // namespace

PreparedProject prepare_scan(const ProjectChoices& choices, const PrepareOptions& options,
                             const ProjectContext& context) {
    ProjectDraft draft = draft_project(choices, context);
    StopRules& stop = draft.project.settings.stop;
    if (!stop.is_any_set()) stop.fits_cell = true;
    LockedProject open = make_project(std::move(draft), context);
    return finish(open.project, options, context);
}

PreparedProject prepare_project(const std::filesystem::path& folder,
                                const std::optional<std::filesystem::path>& cell_file, const PrepareOptions& options,
                                const ProjectContext& context) {
    LockedProject open(folder, cell_file, context);
    open.project.check_cell();
    context.saved("The project is unchanged.");
    open.project.scan();
    const Project& project = open.project.project();
    context.message(folder.string() + ": goes on after " + std::to_string(project.cuts.size()) + " cuts");
    if (project.beam && project.settings.beam > 1) {
        context.message("The beam of " + std::to_string(project.beam->branches.size()) + " goes on.");
    }
    return finish(open.project, options, context);
}

}  // namespace qchopper
