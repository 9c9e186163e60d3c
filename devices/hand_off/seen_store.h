// What a cell shows of its memory, read and compared with what it showed before.

#pragma once

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

}  // namespace qchopper
