// Makes the programs of some pieces of a prepared project, so that several processes, on several machines that share
// its folder, make those of all of it; prepare then takes them (app/jobs/kept_programs.h).
//
// The jobs are the same to the byte as if prepare had made their programs itself (tests/app/cli/work_test.cpp). What is
// finished stays when the program is stopped or killed.

#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/jobs/piece_jobs.h"
#include "app/store/project_context.h"

namespace qchopper {

// One of `count` parts of the pieces. Invariant: number < count.
struct Shard {
    std::size_t number = 0;
    std::size_t count = 1;
};

// Indices of the pieces of a shard, the largest first: by the surface of their boxes each goes to the shard that has
// least so far. Every piece is in one shard. O(pieces * (log(pieces) + shards) + points).
std::vector<std::size_t> pieces_of(const Shard& shard, std::span<const Piece> pieces);

struct WorkAnswer {
    std::filesystem::path folder;
    Shard shard;
    std::size_t piece_count = 0;      // of the project
    std::vector<WorkedPiece> pieces;  // of the shard, in the order of the project's
};

// Takes no lock and changes nothing but the cache. `on_piece` is called from one thread at a time. Throws what
// load_project throws, InputError (use) for a project that is not prepared or whose cell takes no programs, Cancelled.
WorkAnswer work_project(const std::filesystem::path& folder, const Shard& shard, const std::string& program_version,
                        const std::function<void(const WorkedPiece&)>& on_piece, const ProjectContext& context);

}  // namespace qchopper
