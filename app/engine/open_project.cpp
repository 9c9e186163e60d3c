// Keeps scan, segmentation, evaluations and setups once they are made, and saves the project after every change. Saving
// costs O(size of project.json); undo and redo cut the scan again, O(cuts) times the cost of a cut.

#include "app/engine/open_project.h"

#include <algorithm>
#include <array>

#include "app/jobs/ordered_job.h"
#include "app/jobs/piece_program.h"
#include "app/jobs/project_sheets.h"
#include "app/jobs/unreachable_of.h"
#include "app/store/caches/evaluation_store.h"
#include "app/store/caches/stress_store.h"
#include "app/store/ignored_surface.h"
#include "app/store/project_folder.h"
#include "app/store/project_lines.h"
#include "app/store/replay.h"
#include "base/error.h"
#include "base/printable.h"
#include "base/timings.h"
#include "cam/setup/blocks_needed.h"
#include "segment/access/tool_directions.h"
#include "segment/cut/nudge.h"

namespace qchopper {
namespace {

// Assumed: filler and sandpaper take as long on a strip of this width along a joint as handwork on the same area that
// no tool reaches.
constexpr double seam_width_mm = 10;

std::optional<Candidate> nudged_off(const Piece& piece, const Plane& plane) {
    const Plane wanted = canonical(plane);
    const std::optional<Nudged> nudged = nudge(piece, wanted.normal, std::span(&wanted.offset, 1)).front();
    if (!nudged) return std::nullopt;
    return Candidate{{wanted.normal, nudged->offset}, wanted.offset, own_index, own_index};
}

// What is known of pieces that are no more: a project that stays open would grow by them with every decision.
void forget_others(const Segmentation& now, EvaluationCache& cache, std::optional<Setups>& setups) {
    const std::array<const Segmentation*, 1> held{&now};
    cache.keep_only(held);
    if (setups) setups->keep_only(now.pieces);
}

}  // namespace

bool PreparedProject::all_fit() const {
    return std::all_of(pieces.begin(), pieces.end(), [](const PieceReport& p) { return p.fits(); });
}

bool PreparedProject::has_programs() const {
    return project.has_programs && no_programs_for(cell).empty();
}

bool PreparedProject::are_programs_proven() const {
    return !has_programs() || std::all_of(pieces.begin(), pieces.end(),
                                          [](const PieceReport& p) { return p.job.empty() || p.is_proven(); });
}

std::string early_end(const std::string& sentence) {
    return "the stop rules do not hold: " + sentence;
}

OpenProject::OpenProject(std::filesystem::path folder, Project project, std::function<TriangleMesh()> import_scan,
                         const Context& context)
    : folder_(std::move(folder)),
      project_(std::move(project)),
      context_(context),
      import_scan_(std::move(import_scan)) {}

OpenProject::OpenProject(const std::filesystem::path& folder, const Context& context)
    : OpenProject(folder, load_project(folder), {}, context) {
    import_scan_ = [this] { return scan_of_project(folder_, project_, context_); };
}

const TriangleMesh& OpenProject::scan() {
    if (!scan_) scan_ = import_scan_();
    return *scan_;
}

void OpenProject::release_scan() {
    if (segmentation_) scan_.reset();
}

const Segmentation& OpenProject::segmentation() {
    if (segmentation_) return *segmentation_;
    const TriangleMesh& imported = scan();
    const StageTimer stage(context_, "cuts replayed");
    segmentation_ = replay(project_, imported, context_, folder_ / "cache");
    if (project_.settings.objectives.needs_structure()) set_stress(segmentation_->pieces, stress());
    return *segmentation_;
}

const std::shared_ptr<const StressedModel>& OpenProject::stress() {
    if (!stress_ && project_.load) {
        stress_ = kept_stress(folder_ / "cache", scan(), *project_.load, context_);
        for (const std::string& line : stress_lines(*stress_)) context_.message(line);
    }
    return stress_;
}

EvaluationCache& OpenProject::cache() {
    if (!cache_) {
        const SearchSettings& settings = project_.settings;
        cache_ = std::make_unique<EvaluationCache>(
            settings.objectives, settings.candidates,
            evaluation_store(folder_ / "cache", settings.objectives, settings.candidates));
    }
    return *cache_;
}

Setups* OpenProject::setups() {
    const std::filesystem::path cell = folder_ / "cell.toml";
    if (!setups_ && std::filesystem::exists(cell)) setups_.emplace(read_cell(cell));
    if (!setups_) return nullptr;
    setups_->set_orders(committed_setup_orders(project_.history));
    setups_->set_tools(project_.tools);
    setups_->set_count_narrow(project_.settings.stop.count_narrow);
    setups_->set_places(recorded_places(project_));
    return &*setups_;
}

void OpenProject::check_cell() {
    if (setups() != nullptr) return;
    throw InputError(InputFault::use, folder_.string() + " has no cell yet",
                     Sentence::with_key("give_cell", {}, "give it one"));
}

PieceChecks OpenProject::checks() {
    Setups* setups = this->setups();
    PieceChecks checks;
    checks.unreachable = unreachable_of(default_tilt_deg);
    if (setups == nullptr) return checks;
    checks.unreachable = [setups, timings = context_.timings](const Piece& piece) {
        const StageTimer stage(timings, "surface out of reach");
        return setups->unreachable(piece);
    };
    checks.fits_cell = [setups, timings = context_.timings](const Piece& piece) {
        const StageTimer stage(timings, "blocks chosen");
        return setups->fits(piece);
    };
    checks.blocks_needed = [blocks = usable_blocks(setups->planned())](Vec3 size) {
        return blocks_needed(blocks, size);
    };
    checks.is_machinable = [setups, timings = context_.timings](const Piece& piece) {
        const StageTimer stage(timings, "setups of pieces that fit");
        return setups->is_machinable(piece);
    };
    checks.work_out = [setups, timings = context_.timings](std::span<const Piece> pieces, const AskedOfPieces& asked) {
        setups->work_out(pieces, asked, timings);
    };
    checks.min_gain_mm2 = setups->min_gain_mm2();
    checks.seam_width_mm = seam_width_mm;
    checks.low_blocks_needed = [blocks = low_usable_blocks(setups->with_shortest_tools())](Vec3 size) {
        return blocks_needed(blocks, size);
    };
    return checks;
}

OpenProject::Next OpenProject::next(const PieceChecks& checks) {
    const StopRules& rules = project_.settings.stop;
    StopJudge judge = judge_for(project_.settings, checks, cache());
    const std::vector<Piece>& pieces = segmentation().pieces;
    const NextPiece by_rules = judge.next(segmentation(), {});
    Next next{by_rules.piece, by_rules.is_finished && rules.is_any_set()};
    if (next.piece || pieces.empty()) return next;
    const auto largest = std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
        return a.mesh->triangles.size() < b.mesh->triangles.size();
    });
    next.piece = static_cast<std::size_t>(largest - pieces.begin());
    return next;
}

SearchSettings OpenProject::settings_with(const std::optional<Weights>& tried) const {
    SearchSettings settings = project_.settings;
    if (!tried) return settings;
    settings.objectives.weights = *tried;
    if (settings.needs_same(project_.settings)) return settings;
    throw InputError(InputFault::use,
                     "these weights count terms that are not known of this project's pieces, or none of some that are",
                     "make them those of the project, which undo takes back");
}

std::vector<Ranked> OpenProject::ranking(std::size_t piece, std::size_t best, const Context& context,
                                         const std::optional<Weights>& tried) {
    constexpr std::size_t with_neighbours = 4;  // a plane that is listed, those beside it, and the refined one
    const SearchSettings settings = settings_with(tried);
    const StageTimer stage(context, "planes ranked");
    return rank(segmentation(), piece, settings, cache(), context, with_neighbours * best,
                too_large_for(project_.settings, segmentation().pieces[piece]));
}

std::vector<std::size_t> OpenProject::listed(std::size_t piece, const std::vector<Ranked>& ranked, std::size_t most) {
    return without_neighbours(ranked, segmentation().pieces[piece], project_.settings.candidates, most);
}

BlocksNeeded OpenProject::too_large_for(const SearchSettings& settings, const Piece& piece) {
    return judge_for(settings, checks(), cache()).too_large_for(piece);
}

std::optional<Ranked> OpenProject::own_plane(std::size_t piece, const Plane& plane, const Context& context,
                                             const std::optional<Weights>& tried) {
    const SearchSettings settings = settings_with(tried);
    const std::optional<Candidate> candidate = nudged_off(segmentation().pieces[piece], plane);
    if (!candidate) return std::nullopt;
    const StageTimer stage(context, "planes ranked");
    return rank_plane(segmentation(), piece, *candidate, settings, cache(), context);
}

bool OpenProject::misses(std::size_t piece, const Plane& plane) {
    const Piece& target = segmentation().pieces[piece];
    const std::optional<Candidate> candidate = nudged_off(target, plane);
    return !candidate || !cache().evaluation_of(target, *candidate, {});
}

bool OpenProject::decide_cut(Cut cut) {
    Segmentation after = segmentation();
    const StageTimer stage(context_, "cuts made");
    context_.progress("cuts made", after.cuts.size(), 0);
    if (!apply(after, std::move(cut), project_.settings.objectives.fragment_volume_mm3)) return false;
    adopt(after);
    forget_others(after, cache(), setups_);
    return true;
}

void OpenProject::adopt(const Segmentation& segmentation) {
    adopt(segmentation, std::nullopt);
}

void OpenProject::adopt(const Segmentation& segmentation, std::optional<BeamState> beam, OldReview review) {
    take_over(segmentation, std::move(beam));
    if (review == OldReview::dropped) project_.review.reset();
    save();
}

void OpenProject::take_over(const Segmentation& segmentation, std::optional<BeamState> beam) {
    remove_outputs(folder_, project_);
    segmentation_ = segmentation;
    project_.end_reason.reset();
    project_.ended_because.clear();
    project_.reverted.clear();
    record(project_, *segmentation_);
    project_.beam = std::move(beam);
}

bool OpenProject::decide_weights(const Weights& weights) {
    if (weights == project_.settings.objectives.weights) return false;
    check_load(project_.load, weights);
    check_symmetry(project_.settings.candidates.symmetry, weights);
    decide(project_.history, WeightsChange{weights});
    set_weights(weights);
    project_.beam.reset();
    drop_unfinished_review();
    save();
    return true;
}

void OpenProject::set_weights(const Weights& weights) {
    const SearchSettings before = project_.settings;
    project_.settings.objectives.weights = weights;
    if (project_.settings.needs_same(before)) return;
    segmentation_.reset();
    cache_.reset();
}

bool OpenProject::decide_discard(const std::vector<std::string>& pieces) {
    Segmentation after = segmentation();
    if (pieces.empty()) return false;
    for (const std::string& piece : pieces) {
        if (!discard(after, piece)) return false;
    }
    adopt(after);
    return true;
}

bool OpenProject::decide_reset() {
    if (project_.cuts.empty() && project_.discards.empty()) return false;
    remove_outputs(folder_, project_);
    decide(project_.history, Reset{});
    commit_first(project_.history.committed);
    return true;
}

// The other outputs do not depend on it: of a piece whose setup changes the job alone is removed.
bool OpenProject::decide_setup(const SetupOrder& order) {
    if (!piece_named(segmentation(), order.piece)) return false;
    if (committed_setup_order(project_.history, order.piece) == order) return false;
    decide(project_.history, order);
    remove_sheets(folder_);
    remove_items(folder_);
    std::erase_if(project_.jobs, [&](const WrittenJob& job) { return job.piece == order.piece; });
    project_.beam.reset();
    save();
    return true;
}

std::optional<PieceReport> OpenProject::write_job_again(std::size_t piece, const std::string& program_version) {
    check_cell();
    if (project_.stage != Stage::done) return std::nullopt;
    const std::vector<PieceJoint> joints =
        piece_joints(segmentation().pieces, joint_settings(&setups()->cell()), context_);
    PieceReport report =
        write_job(folder_, project_, segmentation(), piece, *setups(), joints, program_version, context_);
    write_sheets(folder_, project_, segmentation(), *setups(), joints, context_);
    save_project(folder_, project_);
    return report;
}

std::optional<Decision> OpenProject::undo() {
    return change_committed(to_undo(project_.history), project_.history.committed - 1);
}

std::optional<Decision> OpenProject::redo() {
    return change_committed(to_redo(project_.history), project_.history.committed + 1);
}

std::optional<Decision> OpenProject::change_committed(const Decision* changed, std::size_t committed) {
    if (changed == nullptr) return std::nullopt;
    if (const auto* order = std::get_if<SetupOrder>(changed)) {
        remove_sheets(folder_);
        remove_items(folder_);
        std::erase_if(project_.jobs, [&](const WrittenJob& job) { return job.piece == order->piece; });
    } else if (!std::holds_alternative<WeightsChange>(*changed)) {
        remove_outputs(folder_, project_);
    }
    commit_first(committed);
    if (project_.stage == Stage::cutting) bring_back_outputs(folder_, project_);
    return *changed;  // the list of decisions stays as it is
}

// Everything that follows from the decisions in force is made anew, as after loading them.
void OpenProject::commit_first(std::size_t committed) {
    project_.history.committed = committed;
    set_weights(committed_weights(project_.history));
    project_.beam.reset();
    drop_unfinished_review();
    std::vector<Cut> cuts = committed_cuts(project_.history);
    std::vector<Discard> discards = committed_discards(project_.history);
    if (cuts != project_.cuts || discards != project_.discards) {
        project_.cuts = std::move(cuts);
        project_.discards = std::move(discards);
        project_.review.reset();
        segmentation_.reset();
        record(project_, segmentation());
        forget_others(*segmentation_, cache(), setups_);
    }
    save();
}

void OpenProject::set_search(const StopRules& stop, std::size_t beam) {
    SearchSettings settings = project_.settings;
    settings.stop = stop;
    settings.beam = beam;
    set_settings(settings);
}

void OpenProject::set_settings(const SearchSettings& settings) {
    if (settings == project_.settings) return;
    remove_items(folder_);
    const bool needs_same = settings.needs_same(project_.settings);
    if (settings.objectives != project_.settings.objectives) cache_.reset();
    project_.settings = settings;
    project_.beam.reset();
    drop_unfinished_review();
    // Made again with samples, or without: as a project that is opened with these settings.
    if (!needs_same) segmentation_.reset();
    save();
}

void OpenProject::set_has_programs(bool has_programs) {
    if (has_programs == project_.has_programs) return;
    project_.has_programs = has_programs;
    save();
}

void OpenProject::keep_pieces_written() {
    pieces_are_written_ = true;
    write_current_pieces();
}

void OpenProject::save() {
    const StageTimer stage(context_, "project saved");
    save_project(folder_, project_);
    if (pieces_are_written_) write_current_pieces();
}

void OpenProject::write_current_pieces() {
    const Segmentation& current = segmentation();
    const StageTimer stage(context_, "pieces written");
    write_pieces(folder_, current, project_.fragments, context_);
}

}  // namespace qchopper
