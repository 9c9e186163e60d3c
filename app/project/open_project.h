// The engine that makes a project advance: cut by cut with undo, redo and reset, or by the search, to pieces and jobs.
//
// Every decision is saved before the next is thought about, and what was evaluated is kept in the folder's cache.
// Memory and project.json never differ, and killing the program at any moment leaves the decisions before or after the
// last one. Undo gives back the exact project of before but for its history; redo returns
// (tests/app/project/open_project_test.cpp). The scan is taken in, and cut again, only when something asks for it.

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/project/outputs.h"
#include "app/project/project.h"
#include "segment/search/search.h"

namespace qchopper {

// A project at the end of its way: how each of its pieces is carved.
struct PreparedProject {
    std::filesystem::path folder;
    Project project;
    std::vector<PieceReport> pieces;
    bool all_fit() const;
};

// "the stop rules do not hold: ...", as it stands in a project whose search ended too early.
std::string early_end(const std::string& sentence);

class OpenProject {
 public:
    // The caller holds the lock of the folder. `import_project_scan` gives the scan as ScanSource says.
    OpenProject(std::filesystem::path folder, Project project, std::function<TriangleMesh()> import_project_scan);

    // The project of a folder, whose scan is taken in with the context when it is needed. Only who holds the lock may
    // decide. Throws what load_project throws.
    OpenProject(const std::filesystem::path& folder, const Context& context);

    OpenProject(const OpenProject&) = delete;
    OpenProject& operator=(const OpenProject&) = delete;

    const std::filesystem::path& folder() const { return folder_; }
    const Project& project() const { return project_; }
    const TriangleMesh& scan();
    const Segmentation& segmentation();
    EvaluationCache& book();

    // How pieces are carved in the project's cell; nothing: it knows none. Throws InputError (config) for a cell file
    // that is wrong.
    Setups* setups();
    // Throws InputError (use) for a project that knows no cell.
    void check_cell();
    // What the stop rule asks; empty without a cell.
    FitsCell fits_cell();

    // The piece to be cut next: by the rules, or the one with most faces if they hold already or none is set.
    struct Next {
        std::optional<std::size_t> piece;  // nothing: there is none
        bool rules_hold = false;           // rules are set, and they hold
    };
    Next next(const FitsCell& fits_cell);
    // Nothing if no piece has that name.
    std::optional<std::size_t> piece_named(const std::string& name);

    // Rankings evaluate what is not evaluated yet, and neither cut nor change anything but the cache.
    std::vector<Ranked> ranking(std::size_t piece, const Context& context);
    // The operator's own plane, nudged once. Nothing if it misses, or leaves fewer than two pieces that are no
    // fragments. Its normal and offset have the number -1.
    std::optional<Ranked> own_plane(std::size_t piece, const Plane& plane, const Context& context);

    // Why not: true if it misses the piece, or runs so near to its end or to a cut that bounds it that it parts
    // nothing.
    bool misses(std::size_t piece, const Plane& plane);

    // Decisions. False, and nothing changes: the plane misses, the weights are those that stand, no cut stands.
    bool decide_cut(Cut cut);
    bool decide_weights(const Weights& weights);
    bool decide_discard(const std::string& piece);  // no such piece, or the only one
    bool decide_reset();
    // Gives the decision that was taken back or put in force again; nothing if there is none.
    std::optional<Decision> undo();
    std::optional<Decision> redo();

    // From now on the pieces are written whenever the project is saved, not only at the end of a search.
    void keep_pieces_written();
    bool are_pieces_written() const { return pieces_are_written_; }

    // How the search is to go on; no decision, so undo does not take it back.
    void set_search(const StopRules& stop, std::size_t beam);

    // Lets the search go on by itself to the stop rules, saves the best of every round, and writes the pieces at its
    // end, unless time ran out.
    SearchEnd search(const FitsCell& fits_cell, const std::function<void(const Segmentation&)>& on_round,
                     const Context& context, std::optional<double> time_limit_s);

    // Writes pieces, jobs and pictures once the cutting is over. After a search that ran out of time they are written
    // too, and the project says so and can go on. Throws as check_cell does.
    PreparedProject prepare(const std::string& program_version, const Context& context);

    // Makes the next cut or discarded piece of a segmentation that grows outside of here (replay_plan.h) a decision.
    void adopt(const Segmentation& segmentation);

 private:
    void adopt(const Segmentation& segmentation, std::optional<BeamState> beam);
    void record_end(const SearchEnd& end);
    void stand_at(std::size_t standing);
    void save();

    std::filesystem::path folder_;
    Project project_;
    std::function<TriangleMesh()> import_scan_;
    std::optional<TriangleMesh> scan_;
    std::optional<Segmentation> segmentation_;
    std::unique_ptr<EvaluationCache> book_;
    std::optional<Setups> setups_;
    std::optional<SearchEnd> end_;  // of the last search, until something else is decided
    bool pieces_are_written_ = false;
};

}  // namespace qchopper
