// The engine that makes a project advance: cut by cut with undo, redo and reset, or by the search, to pieces and jobs.
//
// Lengths in mm about the scan's centre. Every decision is saved before the next one is evaluated, and evaluations are
// kept in the folder's cache. Memory and project.json never differ, and killing the program at any moment leaves the
// decisions before or after the last one. Undo restores the project of before exactly but for its history; redo
// reverses that (tests/app/engine/open_project_test.cpp). The scan is imported, and cut again, only when it is needed.

#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/engine/outputs.h"
#include "app/jobs/piece_jobs.h"
#include "app/jobs/project_joints.h"
#include "app/store/project.h"
#include "segment/search/search.h"

namespace qchopper {

// Of what programs are made from, with the estimated time of making those that are not kept: CPU seconds of one
// processor of 2026.
struct WrittenItems {
    std::size_t count = 0;  // of pieces that get a program
    std::size_t kept = 0;   // of them, those that have it
    double all_s = 0;
    double largest_s = 0;
};

// A project of which all pieces are set up, and how each of them is milled.
struct PreparedProject {
    std::filesystem::path folder;
    Project project;
    Cell cell;
    double max_unreachable = 0;       // share of a piece's surface that may stay out of reach
    std::vector<PieceReport> pieces;  // in the order of the project's
    ProjectJoints joints = {};        // of them
    WrittenItems items = {};          // for other processes to work on (work_project.h)
    // Whether the programs of all pieces are known, and nothing more is changed because the arm refuses some of them.
    bool are_refusals_settled = false;
    bool all_fit() const;
    // Whether jobs of this cell hold programs, and programs were asked for.
    bool has_programs() const;
    // Whether every program that was made is proven.
    bool are_programs_proven() const;
};

struct LoopObserver;
using OnDecision = std::function<void(const Segmentation&)>;

// "the stop rules do not hold: ...", the warning of a project whose search ended too early.
std::string early_end(const std::string& sentence);

class OpenProject {
 public:
    // `import_scan` returns the scan of project.scan with what is ignored; it is called when needed, and again when it
    // is needed after it was freed. Precondition of all functions that change something: the caller holds the lock of
    // the folder (project_folder.h). What the context points to outlives this object.
    OpenProject(std::filesystem::path folder, Project project, std::function<TriangleMesh()> import_scan,
                const Context& context = {});

    // The project of a folder, whose scan is imported with the context when it is needed; every function that needs it
    // then throws what scan_of_project throws. Throws what load_project throws.
    OpenProject(const std::filesystem::path& folder, const Context& context);

    OpenProject(const OpenProject&) = delete;
    OpenProject& operator=(const OpenProject&) = delete;

    const std::filesystem::path& folder() const { return folder_; }
    const Project& project() const { return project_; }
    const TriangleMesh& scan();
    const Segmentation& segmentation();
    // The stress of the scan under the project's load, and a message about it; null without a load. Throws what
    // stress_of throws.
    const std::shared_ptr<const StressedModel>& stress();
    EvaluationCache& cache();

    // How pieces are milled in the project's cell; nullptr without a cell. Throws InputError (config) for a cell file
    // that is wrong.
    Setups* setups();
    // Throws InputError (use) for a project without a cell.
    void check_cell();
    // What the stop rules ask: whether a piece fits the cell (empty without a cell), and what of it is out of reach of
    // the cell's tools, or of any tool (unreachable_of.h). Valid while this object lives.
    PieceChecks checks();

    // The piece to be cut next: by the rules, or the one with most faces if they hold already or none is set.
    struct Next {
        std::optional<std::size_t> piece;  // an index; nothing: there is no piece
        bool rules_hold = false;           // rules are set, and they hold
    };
    Next next(const PieceChecks& checks);

    // In the following, `piece` is an index in segmentation().pieces. All candidates of the piece, best first.
    // Evaluates those that are not evaluated yet; changes nothing but the cache.
    // The first `best` that are listed are certain to be so (segment/search/rank_piece.h). `tried`: weights in place of
    // those in force. Throws InputError (use) for weights of terms that the project's pieces are not made for
    // (SearchSettings::needs_same).
    std::vector<Ranked> ranking(std::size_t piece, std::size_t best, const Context& context,
                                const std::optional<Weights>& tried = {});
    // Of a ranking of the piece the indices of the first `most` planes that are more than one step of the offsets apart
    // (segment/search/rank.h): the places of which an operator takes one.
    std::vector<std::size_t> listed(std::size_t piece, const std::vector<Ranked>& ranked, std::size_t most);
    // The boxes into which a piece that the stop rules of the settings call too large is cut; else empty.
    BlocksNeeded too_large_for(const SearchSettings& settings, const Piece& piece);
    // The operator's own plane, nudged once. Nothing if it misses, or leaves fewer than two pieces that are no
    // fragments. The numbers of its normal and offset are -1.
    std::optional<Ranked> own_plane(std::size_t piece, const Plane& plane, const Context& context,
                                    const std::optional<Weights>& tried = {});

    // Whether a plane misses the piece, or runs so near to its end or to a cut that bounds it that it parts nothing.
    bool misses(std::size_t piece, const Plane& plane);

    // Decisions. They return false and change nothing where there is nothing to decide:
    bool decide_cut(Cut cut);                                     // the plane misses
    bool decide_weights(const Weights& weights);                  // they are the current ones
    bool decide_discard(const std::vector<std::string>& pieces);  // none, one is not there, or no other is left
    bool decide_reset();                                          // no cut and no discarded piece is in force
    bool decide_setup(const SetupOrder& order);                   // it is in force already, or there is no such piece
    // The decision that was taken back or put in force again; nothing if there is none. Jobs and other outputs that a
    // decision has put out of force come back with the decisions that they follow from (bring_back_outputs()).
    std::optional<Decision> undo();
    std::optional<Decision> redo();

    // Writes the pieces now, and from now on whenever the project is saved, not only at the end of a search.
    void keep_pieces_written();
    bool are_pieces_written() const { return pieces_are_written_; }

    // Sets how the search goes on. This is no decision: undo does not take it back.
    void set_search(const StopRules& stop, std::size_t beam);
    // The same for all settings. Precondition: the weights stay as they are.
    void set_settings(const SearchSettings& settings);

    // The steps of the loop, in the order in which run_loop() takes them (loop.h). `on_decision` is called with the
    // segmentation after each decision is saved; it may be empty. Throw Cancelled; what was decided stays saved.
    //
    // Whether a search is to begin or to go on: none has ended yet, and setups judge none.
    bool is_search_open() const { return project_.stage == Stage::cutting && !is_being_judged(); }
    // Runs the search to the stop rules and writes the pieces at its end, unless time ran out.
    SearchEnd search(const PieceChecks& checks, const OnDecision& on_decision, const Context& context,
                     const std::optional<TimeLimit>& time_limit);
    // Whether setups are to judge what a search made, or to go on with it: in a project with a cell whose search has
    // ended, where surface out of reach has a weight or is limited, and once. Saves that it has begun.
    bool begin_review();
    // Whether it has begun and is not done.
    bool is_being_judged() const { return project_.review && !project_.review->is_done; }
    // With the weight `unreachable` a cut of which the pieces can be milled better along another plane is replaced
    // (review_cuts.h); every cut is asked once. Precondition of this and the next: begin_review() returned true.
    void review_cuts(const OnDecision& on_decision, const Context& context);
    // With the rule max_unreachable a piece of which the setup of its job leaves more out of reach is cut again on
    // trial, by planes that setups compare (planes_by_setups.h); project().end_reason then says of the final setups
    // whether the rules hold. Ends the review, unless time runs out. Returns the end of that cutting, if there was any.
    std::optional<SearchEnd> cut_again(const OnDecision& on_decision, const Context& context,
                                       const std::optional<TimeLimit>& time_limit);
    // search() for pieces that the arm refuses (Setups::refuse_with_long_tools()), after setups have judged the
    // cuts: what they said stays, also if the program is killed, and no cut is judged again.
    SearchEnd cut_refused(const OnDecision& on_decision, const Context& context,
                          const std::optional<TimeLimit>& time_limit);
    // The setups of all pieces, without jobs; those of an earlier run are removed. `end` as in write_outputs(). Throws
    // what check_cell throws.
    PreparedProject set_up(const std::optional<SearchEnd>& end, const LoopObserver& observer, const Context& context);
    // The same, and what the arm says of the toolpaths of the pieces (follow_toolpaths() of app/jobs/piece_jobs.h).
    PreparedProject follow_toolpaths(MissingToolpaths missing, const std::string& program_version,
                                     const Context& context);
    // Writes work/items/<piece>.qitem of every piece (work_project.h), in place of those that are there, and copies
    // programs that are kept into work/results. Precondition: `prepared` is that of set_up(). Throws InputError (use)
    // for a cell whose jobs get no programs, what write_file throws, Cancelled.
    WrittenItems write_items(const PreparedProject& prepared, const std::string& program_version,
                             const Context& context);
    // Takes pieces and setups that another run has made, so that write_outputs() needs no scan and chooses no setup.
    // Nothing but that may follow. Preconditions: they are those of the project, which has a cell and in which nothing
    // is left to cut.
    void take_pieces(std::vector<Piece> pieces, std::vector<PlacedSetup> setups);
    // Writes pieces, jobs and pictures. `end` is that of the cutting before it in this run. If time ran out the stage
    // stays Stage::cutting, so that the project can go on. Throws what check_cell throws.
    PreparedProject write_outputs(const std::optional<SearchEnd>& end, const std::string& program_version,
                                  const LoopObserver& observer, const Context& context);

    // Whether jobs are written with robot programs from now on. This is no decision: undo does not take it back.
    void set_has_programs(bool has_programs);

    // Writes the job of one piece again, if the jobs are written, and says what it is; `piece` is an index in
    // segmentation().pieces. Throws what check_cell throws.
    std::optional<PieceReport> write_job_again(std::size_t piece, const std::string& program_version);

    // Makes the newest cut or discarded piece of a segmentation that is extended by others (replay_plan.h) a decision.
    void adopt(const Segmentation& segmentation);

 private:
    enum class OldReview { dropped, kept };
    void adopt(const Segmentation& segmentation, std::optional<BeamState> beam, OldReview review = OldReview::dropped);
    SearchEnd search(const PieceChecks& checks, OldReview review, const OnDecision& on_decision, const Context& context,
                     const std::optional<TimeLimit>& time_limit);
    void take_over(const Segmentation& segmentation, std::optional<BeamState> beam);
    // The pieces are made again, with samples or without, if that follows from them.
    void set_weights(const Weights& weights);
    void drop_unfinished_review();
    std::map<std::int32_t, Piece> pieces_to_recut(std::vector<std::int32_t> numbers, const Context& context);
    std::optional<SearchEnd> cut_by_setups(const OnDecision& on_decision, const Context& context,
                                           const std::optional<TimeLimit>& time_limit);
    BeamProgress after_the_search(const Segmentation& segmentation);
    PieceChecks checks_by_setups(const SearchSettings& settings, const Context& context);
    // Throws as ranking().
    SearchSettings settings_with(const std::optional<Weights>& tried) const;
    // Whether it is replaced.
    bool judge_cut(std::int32_t number, const std::map<std::int32_t, Piece>& divided, const Context& context);
    void replace_cut(const Segmentation& alone, CutReview review);
    void record_end(const SearchEnd& end);
    std::optional<Decision> change_committed(const Decision* changed, std::size_t committed);
    void commit_first(std::size_t committed);
    // Frees the scan, which the pieces do not need: 36 bytes a face. scan() imports it again.
    void release_scan();
    void save();
    void write_current_pieces();
    void begin_outputs(const std::optional<SearchEnd>& end);
    PreparedProject pieces_for_jobs(const LoopObserver& observer, const Context& context);

    std::filesystem::path folder_;
    Project project_;
    Context context_;
    std::function<TriangleMesh()> import_scan_;
    std::optional<TriangleMesh> scan_;
    std::optional<Segmentation> segmentation_;
    std::shared_ptr<const StressedModel> stress_;
    std::unique_ptr<EvaluationCache> cache_;
    std::optional<Setups> setups_;
    bool pieces_are_written_ = false;
    bool are_pieces_taken_ = false;
};

}  // namespace qchopper
