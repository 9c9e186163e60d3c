// The steps of the loop as OpenProject takes them, each saved decision by decision. In the review cuts are asked in
// their order: a replacement gives other names to the pieces of later cuts only. Then pieces are cut again:
// docs/decisions/0039. The cost is that of the search (segment/search), of the setups of all pieces, and of jobs.

#include <algorithm>
#include <limits>
#include <map>

#include "app/engine/loop.h"
#include "app/engine/planes_by_setups.h"
#include "app/engine/review_cuts.h"
#include "app/jobs/piece_program.h"
#include "app/jobs/project_sheets.h"
#include "app/store/project_folder.h"
#include "app/store/replay.h"
#include "base/error.h"
#include "base/timings.h"
#include "segment/search/cut_list.h"
#include "segment/search/recut.h"

namespace qchopper {
namespace {

// Whether the operator chose the plane, or decided about a piece of this or a later cut.
bool is_decided(const Project& project, const Segmentation& segmentation, const Cut& cut) {
    if (cut.chosen.normal_index == own_index) return true;
    const auto is_later = [&](const Discard& d) { return d.after >= static_cast<std::size_t>(cut.number); };
    if (std::any_of(project.discards.begin(), project.discards.end(), is_later)) return true;
    const std::vector<SetupOrder> orders = committed_setup_orders(project.history);
    return std::any_of(orders.begin(), orders.end(), [&](const SetupOrder& order) {
        const auto piece = piece_named(segmentation, order.piece);
        return piece && made_by(segmentation.pieces[*piece]) >= cut.number;
    });
}

// What needs no trial; nothing: other planes can be tried.
std::optional<ReviewOutcome> settled(const Project& project, const Segmentation& segmentation, const Cut& cut) {
    if (!is_last_of_its_pieces(segmentation.cuts, cut.number)) return ReviewOutcome::carries_cut;
    if (is_decided(project, segmentation, cut)) return ReviewOutcome::decided;
    return std::nullopt;
}

void choose_setups(std::span<const Piece> pieces, Setups& setups, const LoopObserver& observer,
                   const Context& context) {
    StageTimer stage(context, "setups chosen");
    context.progress("setups chosen", 0, pieces.size());
    setups.map(pieces, context);
    stage.next("work envelopes judged");
    setups.place(pieces, context);
    if (!observer.on_setup) return;
    for (const Piece& piece : pieces) observer.on_setup(piece, setups.placed(piece));
}

}  // namespace

SearchEnd OpenProject::search(const PieceChecks& checks, const OnDecision& on_decision, const Context& context,
                              const std::optional<TimeLimit>& time_limit) {
    return search(checks, OldReview::dropped, on_decision, context, time_limit);
}

SearchEnd OpenProject::cut_refused(const OnDecision& on_decision, const Context& context,
                                   const std::optional<TimeLimit>& time_limit) {
    return search(checks(), OldReview::kept, on_decision, context, time_limit);
}

SearchEnd OpenProject::search(const PieceChecks& checks, OldReview review, const OnDecision& on_decision,
                              const Context& context, const std::optional<TimeLimit>& time_limit) {
    remove_outputs(folder_, project_);
    Segmentation working = segmentation();
    const StageTimer stage(context, "search");
    BeamProgress progress = beam_progress(
        project_, working, [this]() -> const TriangleMesh& { return scan(); }, folder_ / "cache");
    if (project_.settings.objectives.needs_structure()) set_stress(progress.root.pieces, stress());
    release_scan();
    const auto keep = [&](const Segmentation& best) {
        adopt(best, progress.saved(), review);
        if (on_decision) on_decision(best);
    };
    SearchEnd end = qchopper::search(working, project_.settings, cache(), checks, keep, context, time_limit, &progress);
    adopt(working, end.is_out_of_time() ? progress.saved() : std::nullopt, review);
    if (end.is_out_of_time()) return end;
    record_end(end);
    write_current_pieces();
    project_.stage = Stage::cut;
    save();
    return end;
}

void OpenProject::record_end(const SearchEnd& end) {
    project_.end_reason = end.reason;
    project_.ended_because = end.sentence;
    project_.reverted = end.reverted;
    if (!end.is_finished()) project_.warnings.push_back(early_end(end.sentence));
}

// Other weights or rules: the search goes on with them, and its cuts are judged again.
void OpenProject::drop_unfinished_review() {
    if (is_being_judged()) project_.review.reset();
}

bool OpenProject::begin_review() {
    const SearchSettings& settings = project_.settings;
    if (settings.objectives.weights.unreachable <= 0 && !settings.stop.max_unreachable) return false;
    if (setups() == nullptr) return false;
    if (project_.stage != Stage::cut || project_.review) return is_being_judged();
    project_.review.emplace();
    save();
    return true;
}

void OpenProject::review_cuts(const OnDecision& on_decision, const Context& context) {
    if (project_.review->are_cuts_asked) return;
    if (project_.settings.objectives.weights.unreachable > 0) {
        const StageTimer stage(context, "setups judge the cuts");
        std::vector<std::int32_t> numbers = doubtful_cuts(segmentation(), *setups(), context);
        const auto is_known = [&](std::int32_t number) {
            const std::vector<CutReview>& known = project_.review->cuts;
            return std::any_of(known.begin(), known.end(), [&](const CutReview& v) { return v.cut == number; });
        };
        std::erase_if(numbers, is_known);
        std::map<std::int32_t, Piece> divided = pieces_to_recut(numbers, context);
        for (const std::int32_t number : numbers) {
            if (judge_cut(number, divided, context) && on_decision) on_decision(segmentation());
            divided.erase(number);
        }
    }
    project_.review->are_cuts_asked = true;
    save();
}

std::optional<SearchEnd> OpenProject::cut_again(const OnDecision& on_decision, const Context& context,
                                                const std::optional<TimeLimit>& time_limit) {
    std::optional<SearchEnd> end = cut_by_setups(on_decision, context, time_limit);
    if (end && end->is_out_of_time()) return end;
    setups()->keep_only(segmentation().pieces);
    if (project_.stage == Stage::cutting) write_current_pieces();
    project_.stage = Stage::cut;
    project_.review->is_done = true;
    save();
    return end;
}

// The rules of the search, but by the setups that jobs are made of.
PieceChecks OpenProject::checks_by_setups(const SearchSettings& settings, const Context& context) {
    PieceChecks checks = this->checks();
    checks.unreachable = [this](const Piece& piece) { return setups()->left_by_setup(piece); };
    checks.work_out = [this](std::span<const Piece> pieces, const AskedOfPieces&) { setups()->place(pieces, {}); };
    checks.planes_on_trial = [this, &settings, &context](const Segmentation& s, std::size_t piece,
                                                         std::vector<Ranked> ranked) {
        return planes_by_setups(s, piece, std::move(ranked), settings, *setups(), cache(), context);
    };
    return checks;
}

// The state in which pieces are passed over that the search gave up, unless holder and arm keep more of them out of
// reach than it knew, or a cut that is replaced made them other pieces.
BeamProgress OpenProject::after_the_search(const Segmentation& segmentation) {
    std::int32_t first_replaced = std::numeric_limits<std::int32_t>::max();
    for (const CutReview& cut : project_.review->cuts) {
        if (cut.outcome == ReviewOutcome::replaced) first_replaced = std::min(first_replaced, cut.cut);
    }
    BeamState state;
    state.from = segmentation.cuts.size();
    state.branches.emplace_back();
    for (const RevertedTrial& trial : project_.reverted) {
        const auto index = piece_named(segmentation, trial.piece);
        if (!index || made_by(segmentation.pieces[*index]) >= first_replaced) continue;
        const UnreachableSurface left = setups()->left_by_setup(segmentation.pieces[*index]);
        if (left.mm2 > 0 && left.share * (1 - trial.before_mm2 / left.mm2) > doubtful_share) continue;
        state.branches.front().passed_over.push_back(trial.piece);
        state.branches.front().reverted.push_back(trial);
    }
    return {std::move(state), segmentation};
}

// A search of its own, with trials that setups decide. Its state is saved as that of any search; that it is this one
// follows from the verdict.
std::optional<SearchEnd> OpenProject::cut_by_setups(const OnDecision& on_decision, const Context& context,
                                                    const std::optional<TimeLimit>& time_limit) {
    if (!project_.settings.stop.max_unreachable) return std::nullopt;
    if (time_limit && time_limit->has_passed()) return end_of_time(*time_limit);
    const StageTimer stage(context, "pieces cut by their setups");
    setups()->place(segmentation().pieces, context);
    Segmentation working = segmentation();
    SearchSettings settings = project_.settings;
    settings.beam = 1;
    BeamProgress progress =
        project_.beam ? beam_progress(
                            project_, working, [this]() -> const TriangleMesh& { return scan(); }, folder_ / "cache")
                      : after_the_search(working);
    release_scan();
    const auto keep = [&](const Segmentation& s) {
        take_over(s, progress.saved());
        save();
        setups()->keep_only(segmentation().pieces);
        if (on_decision) on_decision(s);
    };
    SearchEnd end = qchopper::search(working, settings, cache(), checks_by_setups(settings, context), keep, context,
                                     time_limit, &progress);
    project_.beam.reset();
    if (end.is_out_of_time()) {
        project_.beam = progress.saved();
        save();
        return end;
    }
    record(project_, segmentation());
    record_end(end);
    return end;
}

std::map<std::int32_t, Piece> OpenProject::pieces_to_recut(std::vector<std::int32_t> numbers, const Context& context) {
    std::erase_if(numbers, [&](std::int32_t number) {
        return settled(project_, segmentation(), segmentation().cuts[static_cast<std::size_t>(number - 1)]).has_value();
    });
    if (numbers.empty()) return {};
    std::map<std::int32_t, Piece> divided = divided_pieces(project_, scan(), numbers, context, folder_ / "cache");
    for (auto& [number, piece] : divided) {
        if (project_.settings.objectives.needs_structure()) piece.stress = stress();
    }
    release_scan();
    return divided;
}

bool OpenProject::judge_cut(std::int32_t number, const std::map<std::int32_t, Piece>& divided, const Context& context) {
    const Segmentation& now = segmentation();
    const Cut& cut = now.cuts[static_cast<std::size_t>(number - 1)];
    const auto piece = divided.find(number);
    if (piece == divided.end()) {
        const MilledSurface surface = milled_surface(now, number, *setups());
        const ReviewOutcome outcome = settled(project_, now, cut).value_or(ReviewOutcome::kept);
        project_.review->cuts.push_back({number, cut.piece, outcome, 0, surface, surface});
        save();
        return false;
    }
    Piece parted = piece->second;
    parted.name = cut.piece;
    RecutTrial trial = try_other_planes(now, parted, number, project_.settings, *setups(), context);
    if (trial.better) {
        replace_cut(*trial.better, std::move(trial.review));
        return true;
    }
    setups()->keep_only(now.pieces);
    project_.review->cuts.push_back(std::move(trial.review));
    save();
    return false;
}

// The stage is `cutting` before a file is removed, so that nothing that is on disk belongs to other cuts. Why the
// search ended stays: by it and by the verdict that is not done the project is known to go on here.
void OpenProject::replace_cut(const Segmentation& alone, CutReview review) {
    project_.stage = Stage::cutting;
    project_.jobs.clear();
    save_project(folder_, project_);
    remove_outputs(folder_, project_);
    segmentation_ = recut(segmentation(), alone);
    setups()->keep_only(segmentation_->pieces);
    decide(project_.history, Replacement{alone.cuts.front()});
    record(project_, *segmentation_);
    if (!project_.do_rules_hold()) project_.warnings.push_back(early_end(project_.ended_because));
    project_.review->cuts.push_back(std::move(review));
    save();
}

void OpenProject::take_pieces(std::vector<Piece> pieces, std::vector<PlacedSetup> setups) {
    segmentation_.emplace();
    segmentation_->cuts = project_.cuts;
    segmentation_->pieces = std::move(pieces);
    for (std::size_t i = 0; i < setups.size(); ++i) {
        this->setups()->know(segmentation_->pieces[i], std::move(setups[i]));
    }
    are_pieces_taken_ = true;
}

void OpenProject::begin_outputs(const std::optional<SearchEnd>& end) {
    const bool is_out_of_time = end && end->is_out_of_time();
    if (is_out_of_time) record_end(*end);
    if ((!end || is_out_of_time) && !are_pieces_taken_) write_current_pieces();
}

// With their setups, and what joins them.
PreparedProject OpenProject::pieces_for_jobs(const LoopObserver& observer, const Context& context) {
    check_cell();
    PreparedProject prepared{folder_, {}, setups()->cell(), max_unreachable(project_, setups()->cell()), {}};
    const std::vector<Piece>& pieces = segmentation().pieces;
    release_scan();
    prepared.joints = project_joints(segmentation(), &prepared.cell, context);
    choose_setups(pieces, *setups(), observer, context);
    for (const PieceJoint& joint : prepared.joints.joints) {
        prepared.joints.faces.push_back(joint_faces(joint, setups()->placed(pieces[joint.below]).setup(),
                                                    setups()->placed(pieces[joint.above]).setup()));
    }
    return prepared;
}

PreparedProject OpenProject::set_up(const std::optional<SearchEnd>& end, const LoopObserver& observer,
                                    const Context& context) {
    check_cell();
    remove_jobs(folder_, project_);
    begin_outputs(end);
    PreparedProject prepared = pieces_for_jobs(observer, context);
    for (const Piece& piece : segmentation().pieces) {
        prepared.pieces.push_back(report_without_job(folder_, project_, piece, *setups()));
    }
    save_project(folder_, project_);
    prepared.project = project_;
    return prepared;
}

PreparedProject OpenProject::follow_toolpaths(MissingToolpaths missing, const std::string& program_version,
                                              const Context& context) {
    PreparedProject prepared = pieces_for_jobs({}, context);
    prepared.pieces = qchopper::follow_toolpaths(folder_, project_, segmentation(), *setups(), prepared.joints.joints,
                                                 program_version, missing, context);
    prepared.project = project_;
    return prepared;
}

WrittenItems OpenProject::write_items(const PreparedProject& prepared, const std::string& program_version,
                                      const Context& context) {
    const Cell& cell = setups()->cell();
    const std::string because = no_programs_for(cell);
    if (!because.empty()) throw InputError(InputFault::use, "no programs are made for " + cell.name + ": " + because);
    const std::vector<Piece>& pieces = segmentation().pieces;
    remove_items(folder_);
    std::error_code error;  // that it cannot be made is told by the first file
    std::filesystem::create_directories(items_folder(folder_), error);
    WrittenItems written;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        context.check_cancelled();
        context.progress("items written", i, pieces.size());
        WorkItem item =
            item_of(folder_, project_, segmentation(), i, *setups(), prepared.joints.joints, program_version);
        item.is_settled = prepared.are_refusals_settled;
        write_file(items_folder(folder_) / (pieces[i].name + item_ending), to_bytes(item));
        if (!item.has_program()) continue;
        ++written.count;
        if (result_of(item, folder_ / "cache")) {
            copy_result(item, folder_ / "cache", folder_ / "work" / "results");
            ++written.kept;
            continue;
        }
        written.all_s += item.effort;
        written.largest_s = std::max(written.largest_s, item.effort);
    }
    return written;
}

PreparedProject OpenProject::write_outputs(const std::optional<SearchEnd>& end, const std::string& program_version,
                                           const LoopObserver& observer, const Context& context) {
    check_cell();
    begin_outputs(end);
    PreparedProject prepared = pieces_for_jobs(observer, context);
    const std::vector<Piece>& pieces = segmentation().pieces;
    prepared.pieces = write_jobs(folder_, project_, segmentation(), *setups(), prepared.joints.joints, program_version,
                                 observer.on_job, context);
    write_sheets(folder_, project_, segmentation(), *setups(), prepared.joints.joints, context);
    write_pictures(folder_, pieces, *setups(), context);
    project_.stage = end && end->is_out_of_time() ? Stage::cutting : Stage::done;
    const StageTimer stage(context, "project saved");
    save_project(folder_, project_);
    prepared.project = project_;
    return prepared;
}

}  // namespace qchopper
