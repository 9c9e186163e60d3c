// What journals say of the jobs that earlier dispatchers left open, while the cell cannot be asked.

#pragma once

#include <cstdint>
#include <string>

#include "devices/hand_off/journal_history.h"

namespace qchopper {

// One sentence: the job has STARTED, or whether it has is UNKNOWN. "" if it certainly has not.
std::string left_open(const JournalJob& job);

// The sentences for all open jobs, "" if there are none. Only the cell could tell whether it is the real one with the
// id of the cell file or a simulated one at `endpoint`, so the journals of both are read. A journal that cannot be read
// is named in place of its jobs.
std::string left_open(std::uint16_t cell_id, const std::string& endpoint);

}  // namespace qchopper
