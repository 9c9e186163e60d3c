// Glue between a new or opened project, the requests of decide.h and the replay of plans.

#include "app/engine/segment_project.h"

#include "app/engine/replay_plan.h"
#include "app/jobs/unreachable_of.h"
#include "app/store/project_lines.h"
#include "app/store/replay.h"
#include "base/parallel.h"
#include "base/text.h"
#include "base/timings.h"

namespace qchopper {
namespace {

SegmentAnswer misfit_answer(const std::string& why, ProjectDraft draft) {
    SegmentAnswer answer;
    answer.is_demand_met = false;
    answer.notes = {"The plan does not apply: " + why + ". Nothing was made."};
    answer.is_project_made = false;
    answer.folder = std::move(draft.folder);
    answer.project = std::move(draft.project);
    return answer;
}

void record_uncut(ProjectDraft& draft, const Context& context) {
    const StageTimer stage(context, "solids found");
    context.progress("scans parted into solids", 0, 1);
    record(draft.project, uncut(draft.scan, draft.project.settings.objectives.fragment_volume_mm3));
}

bool is_scan_there(const Project& project) {
    std::error_code error;
    return std::filesystem::exists(project.scan.path, error);
}

// What of each piece is out of reach, where the project has samples of them and its scan is still there: without, the
// other figures are shown all the same.
std::vector<std::optional<double>> unreachable_shares(OpenProject& open, const Context& context) {
    const Project& project = open.project();
    if (!project.settings.takes_samples() || !is_scan_there(project)) return {};
    const std::vector<Piece>& pieces = open.segmentation().pieces;
    const StageTimer stage(context, "surface out of reach");
    std::vector<std::optional<double>> shares(pieces.size());
    parallel_for(0, pieces.size(), [&](std::size_t i) {
        context.check_cancelled();
        shares[i] = share_by_objective(pieces[i], project.settings.objectives.tilt_deg);
    });
    return shares;
}

// Adds the state of the project to an answer.
SegmentAnswer with_state(SegmentAnswer answer, OpenProject& open, const Context& context) {
    if (!answer.proposal && !answer.preview && !answer.plan && !answer.regions) {
        answer.unreachable = unreachable_shares(open, context);
    }
    if (open.project().settings.objectives.needs_structure() && is_scan_there(open.project())) {
        answer.stress = open.stress();
    }
    answer.folder = open.folder();
    answer.project = open.project();
    answer.pieces_written = open.are_pieces_written();
    return answer;
}

// Makes the cuts of a plan on a project that has none, until one does not apply.
SegmentAnswer make_cuts_of(const Plan& plan, OpenProject& open, const ProjectContext& context) {
    Segmentation segmentation = open.segmentation();
    const StageTimer stage(context, "plan replayed");
    std::size_t discarded = 0;
    const auto keep = [&](const Segmentation& s) {
        open.adopt(s);
        context.saved(kept_cuts(s.cuts.size(), open.folder()) + ".");
        const bool is_cut = s.discarded.size() == discarded;
        context.message(is_cut ? cut_line(s.cuts.back(), open.project().settings)
                               : discarded_lines(open.project()).back());
        discarded = s.discarded.size();
    };
    const Project& p = open.project();
    const PlanReplay replay = replay_plan(plan, p.scan, segmentation, p.settings, open.cache(), keep, context);
    SegmentAnswer answer;
    answer.notes.assign(replay.notes.begin(), replay.notes.end());
    const std::string until = std::to_string(segmentation.cuts.size()) + " of " + std::to_string(plan.cuts.size());
    const std::string left_out =
        std::to_string(segmentation.discarded.size()) + " of " + std::to_string(plan.discards.size());
    answer.done = until + " cuts of the plan are made" +
                  (plan.discards.empty() ? "" : ", " + left_out + " pieces of it discarded") +
                  "; the volumes of the pieces differ by at most " + significant(100 * replay.largest_volume_off, 3) +
                  " %.";
    if (!replay.applies) {
        answer.is_demand_met = false;
        answer.notes.push_back("The plan does not apply: " + replay.why + ". " +
                               kept_cuts(segmentation.cuts.size(), open.folder()) + ".");
    }
    return answer;
}

}  // namespace

SegmentAnswer segment_scan(const ProjectChoices& choices, ProjectRequest request, const ProjectContext& context) {
    ProjectDraft draft = draft_project(choices, context);
    const std::optional<Plan> plan = std::move(draft.plan);
    if (plan) {
        const std::string why = misfit(*plan, draft.project.scan, draft.scan);
        if (!why.empty()) return misfit_answer(why, std::move(draft));
    }
    record_uncut(draft, context);
    LockedProject open = make_project(std::move(draft), context);
    request.weights.reset();  // the project is made with them
    if (!plan) return segment_open_project(open.project, request, context);
    if (request.write_pieces) open.project.keep_pieces_written();
    return with_state(make_cuts_of(*plan, open.project, context), open.project, context);
}

SegmentAnswer segment_open_project(OpenProject& open, const ProjectRequest& request, const ProjectContext& context) {
    return with_state(decide(open, request, context), open, context);
}

SegmentAnswer segment_project(const std::filesystem::path& folder,
                              const std::optional<std::filesystem::path>& cell_file, const ProjectRequest& request,
                              const ProjectContext& context) {
    context.saved("The project is unchanged.");
    LockedProject open(folder, cell_file, context);
    return segment_open_project(open.project, request, context);
}

}  // namespace qchopper
