// The programs of a piece that an earlier run made and proved, taken from the job files that it left.
//
// Making and proving a program takes minutes; a run that was stopped goes on with the pieces that are not done. What is
// taken is what would be made again: same input, same bytes (tests/app/jobs/kept_programs_test.cpp).

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/jobs/piece_program.h"
#include "base/sha256.h"

namespace qchopper {

// What programs of a piece depend on.
struct ProgramSource {
    const Piece& piece;
    const Setup& setup;
    const std::string& envelope_document;  // of its work envelope: how the arm holds each region of poses
    std::uint16_t piece_no = 1;
    const std::vector<DrawnCap>& caps;   // before anything was decided about their holes
    Sha256 cell_sha256;                  // of the cell file
    const std::string& program_version;  // of qchopper
};

// Nothing unless the folder of jobs holds all parts of the piece's program, each with the verdict on its bytes, all
// made from this source. Files that are damaged count as missing.
std::optional<PiecePrograms> kept_programs(const std::filesystem::path& jobs, const ProgramSource& source);

}  // namespace qchopper
