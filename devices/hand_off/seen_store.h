// What a cell shows of its memory and of the commands that it has had, compared with what a journal knows.
//
// CMD_SEQ is that of the owner of an earlier CLAIM, whose last number is known from a journal. One that lost its last
// rows knows too low a number: the cell ignores commands with it (BAD_REASON STALE_SEQ), and STATUS may show the
// acknowledgement of the earlier command that had it.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "devices/journal/journal_event.h"
#include "devices/wire/blocks.h"
#include "devices/wire/bus.h"

namespace qchopper {

SeenStore seen_store(const Status& status, const Uuid& store_id);
SeenStore seen_store(const Identity& identity);

// What shows that `now` is not the memory that showed `before`, or "" if nothing does: another STORE_ID, or a counter
// that went back.
std::string loss_between(const SeenStore& before, const SeenStore& now);

// Reads IDENTITY. Nothing if it cannot be read.
std::optional<SeenStore> read_store(RegisterBus& bus);

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
