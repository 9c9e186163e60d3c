// Keeps the programs of pieces with their proof on disk, so that they are made once: what a change of other pieces
// leaves the same is not made again. The files may be deleted at any time.
//
// A file is named by a SHA-256 over all that programs are made from, and ends in a SHA-256 of its content: programs of
// another source and damaged files are ignored. What is taken is what would be made again, to the byte
// (tests/app/jobs/kept_programs_test.cpp). The number of the piece and its order change names alone
// (cam/post/post.h, renamed): programs are taken for another name that is as long, unless a sentence about
// them names a file.

#pragma once

#include <filesystem>
#include <optional>

#include "app/jobs/piece_program.h"
#include "app/store/caches/cache_file.h"
#include "base/sha256.h"
#include "cam/job/job.h"
#include "cam/toolpath/toolpath_settings.h"

namespace qchopper {

constexpr const char* programs_ending = ".programs";  // of the names of the files

// What programs of a piece depend on.
struct ProgramSource {
    const JobInput& job;  // before its program and before anything was decided about its holes
    Sha256 cell_sha256;   // of the cell file
    FineTools fine = FineTools::worthwhile;
};

// What a toolpath depends on; programs depend on the holes and on the digits of the piece's number besides.
// O(triangles).
CacheWriter toolpath_source(const ProgramSource& source);

void put(CacheWriter& out, const BlockPlacement& place);
BlockPlacement block_placement_from(CacheReader& in);

// The file in `folder`, whether it is there or not. O(triangles).
std::filesystem::path programs_file(const std::filesystem::path& folder, const ProgramSource& source);

// What keep_programs wrote into the file of this source; nothing if there is none, or it is damaged. A file that is
// taken counts as written now (remove_oldest of app/store/caches/cache_file.h). O(bytes).
std::optional<PiecePrograms> kept_programs(const std::filesystem::path& file, const ProgramSource& source);

// The bytes of that file. O(bytes).
Bytes programs_bytes(const ProgramSource& source, const PiecePrograms& programs);

// What cannot be written is not kept. O(bytes).
void keep_programs(const std::filesystem::path& file, const ProgramSource& source, const PiecePrograms& programs);

}  // namespace qchopper
