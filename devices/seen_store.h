// What a cell shows of its memory, read and compared with what it showed before.

#pragma once

#include <optional>
#include <string>

#include "devices/blocks.h"
#include "devices/bus.h"
#include "devices/journal_event.h"

namespace qchopper {

SeenStore seen_store(const Status& status, const Uuid& store_id);
SeenStore seen_store(const Identity& identity);

// What shows that `now` is not the memory that showed `before`, or "" if nothing does: another STORE_ID, or a counter
// that went back.
std::string loss_between(const SeenStore& before, const SeenStore& now);

// Reads IDENTITY. Nothing if it cannot be read.
std::optional<SeenStore> read_store(RegisterBus& bus);

}  // namespace qchopper
