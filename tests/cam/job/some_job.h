// A job for the tests of this folder: half a ball on its cap.

#pragma once

#include <string>

#include "cam/job/job.h"
#include "tests/cam/setup/pieces.h"

namespace qchopper::test_pieces {

inline JobInput some_job(int rings = 8) {
    const auto halves = cut_piece(uncut(shapes::ball({100, 20, -7}, 20, rings)), {{0, 0, 1}, -6.3}, 4);
    JobInput input;
    input.piece = halves->pieces.at(0);
    input.piece.name = "AB";
    input.piece_no = 2;
    input.piece_count = 5;
    input.program_version = "0.1.0";
    for (std::size_t i = 0; i < 16; ++i) input.project_id[i] = static_cast<std::uint8_t>(17 * i);
    for (std::size_t i = 0; i < 32; ++i) input.scan_sha256.bytes[i] = static_cast<std::uint8_t>(255 - i);
    input.cell = cell();
    input.setup = choose_setup(input.piece, input.cell).setups.front();
    input.envelope = check_envelope(input.setup, input.cell);
    input.warnings = {"scaled by 0.5 on request"};
    return input;
}

inline std::string text_of(const Bytes& bytes) {
    return {bytes.begin(), bytes.end()};
}

}  // namespace qchopper::test_pieces
