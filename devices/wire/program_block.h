// BLOCK_NO, ALARM_BLOCK and LAST_BLOCK: which line of a robot program a number names.
//
// A line of chunk C, counted from 1 in the order of the job's manifest, is C * 1,000,000 + the line in its file; a line
// of the main program is its number alone (tests/sim/cell/program_run_test.cpp).

#pragma once

#include <algorithm>
#include <cstdint>

namespace qchopper {

constexpr std::uint32_t lines_per_block_chunk = 1'000'000;

// What does not fit is named by the last number that does: 4,293 chunks, 999,999 lines.
constexpr std::uint32_t program_block(std::uint32_t chunk, std::uint32_t line) {
    constexpr std::uint32_t most_chunks = 4293;
    return std::min(chunk, most_chunks) * lines_per_block_chunk + std::min(line, lines_per_block_chunk - 1);
}
// 0: the main program, or a cell that counts blocks in its own way.
constexpr std::uint32_t chunk_of_block(std::uint32_t block) {
    return block / lines_per_block_chunk;
}
constexpr std::uint32_t line_of_block(std::uint32_t block) {
    return block % lines_per_block_chunk;
}

}  // namespace qchopper
