// CMD_SEQ of the owner of an earlier CLAIM, whose last number is known from a journal.
//
// A journal that lost its last rows knows too low a number: the cell ignores commands with it (BAD_REASON STALE_SEQ),
// and STATUS may show the acknowledgement of the earlier command that had it.

#pragma once

#include <cstdint>

#include "devices/wire/blocks.h"

namespace qchopper {

// More than one owner ever sends.
constexpr std::uint32_t skipped_numbers = 1U << 16U;

// `last_known`, or the number of a later command of this owner if STATUS shows its acknowledgement.
std::uint32_t number_after(const Status& status, std::uint32_t owner, std::uint32_t last_known);

// The cell has ignored a command because of its number since it showed `bad_frames_before`. That may have been the
// repetition of an older frame.
bool has_refused_number(std::uint16_t bad_frames_before, const Status& now);

// The acknowledgement in STATUS is that of a CLAIM and, if it was granted, of one with this epoch or a higher one.
bool is_answer_to_claim(const Status& status, std::uint32_t epoch);

}  // namespace qchopper
