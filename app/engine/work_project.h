// Programs of the pieces of a project by several processes, on one machine or on many: prepare writes an item per
// piece, work makes the programs of some of them, and gather writes the jobs from items and results.
//
// Items and results lie in work/ of the project and depend on nothing else (docs/developer/formats/work-folder.md). The
// jobs are the same to the byte as if prepare had made their programs itself (tests/app/cli/work_test.cpp). What is
// finished stays when the program is stopped or killed.

#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/engine/open_project.h"
#include "app/jobs/work_attempt.h"
#include "app/jobs/work_item.h"
#include "app/store/project_context.h"

namespace qchopper {

// One of `count` parts of the items. Invariant: number < count.
struct Shard {
    std::size_t number = 0;
    std::size_t count = 1;
};

// Indices of the items of a shard, the largest effort first: each goes to the shard that has least so far. Every item
// is in one shard. O(items * (log(items) + shards)).
std::vector<std::size_t> items_of(const Shard& shard, std::span<const double> efforts);

// An item without a result, and what is known of the attempts to make it.
struct UnmadePiece {
    std::string piece;
    std::optional<SeenAttempt> last;  // the attempt that gave a sign of life last
    std::size_t failures = 0;         // attempts that have ended without a result
    std::uint64_t bytes = 0;          // peak memory of their processes
};

// So many attempts to make a piece may fail before it is left out, unless it is asked for.
constexpr std::size_t most_failures = 3;

struct WorkOptions {
    Shard shard;
    bool has_retry = false;  // whether pieces are tried again of which most_failures attempts have failed
};

struct WorkAnswer {
    std::filesystem::path folder;  // of the project; empty: of several, or of none
    Shard shard;
    std::size_t piece_count = 0;           // in all, of those that get a program
    std::vector<WorkedPiece> pieces;       // of the shard, in the order of their names
    std::vector<UnmadePiece> unmade = {};  // by name: all of them of work_done(), of work_items() those left out
    double spent_s = 0;                    // CPU time of all processes that have worked on them
    double left_s = 0;                     // of the unmade ones, as estimated
};

// Makes the programs of the items of a shard: of the project at a folder, or of files of items, whose results lie in
// results/ beside the folder that each is in. Takes no lock, reads no scan. `on_piece` is called from one thread at a
// time. A piece that fails does not keep the others from being made. Throws InputError (missing) if there is no item,
// what read_file and item_from() throw, Cancelled; at the end the first failure.
WorkAnswer work_items(const std::vector<std::filesystem::path>& inputs, const WorkOptions& options,
                      const std::string& program_version, const std::function<void(const WorkedPiece&)>& on_piece,
                      const ProjectContext& context);

// An item of a project with what making its programs takes, as it is estimated: CPU seconds of one processor of 2026,
// and bytes of memory at their peak, which is never meant to be too little.
struct ItemEstimate {
    std::string piece;
    double seconds = 0;
    double bytes = 0;
    bool is_made = false;      // its result is there
    std::size_t failures = 0;  // attempts that have ended without it
    bool is_given_up() const { return !is_made && failures >= most_failures; }
};
// By name. Throws as work_items() does.
std::vector<ItemEstimate> item_estimates(const std::filesystem::path& folder, const std::string& program_version);

// What the results of these inputs hold and what is known of the others; nothing is made. Throws as work_items() does.
WorkAnswer work_done(const std::vector<std::filesystem::path>& inputs, const std::string& program_version);

struct GatherAnswer {
    std::vector<UnmadePiece> unmade;          // whose result is missing or damaged, by name
    std::vector<WorkedPiece> refused;         // of which the arm does not follow the toolpath, and which are changed
    std::optional<PreparedProject> prepared;  // with jobs; nothing: one of these lists is not empty
};

// Writes the jobs of a project from its items and the whole results of them, which are copied into its cache. Needs no
// scan and chooses no setup. Pieces that the arm refuses are to be cut again or milled from fewer orientations, as by
// prepare: writing the items again does that, and keeps the results of the others. `makes_missing`: does it here, and
// makes the programs that are missing then. Throws what LockedProject throws, InputError (missing) if there is no item
// or those of other pieces, (use) if the cell file is another one since, what work_items() and prepare_project() throw.
GatherAnswer gather_project(const std::filesystem::path& folder, bool makes_missing, const std::string& program_version,
                            const ProjectContext& context);

}  // namespace qchopper
