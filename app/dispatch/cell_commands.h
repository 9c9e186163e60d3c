// Commands to a cell outside of a dispatch, and its status, with the journal that this computer keeps of the cell.
//
// A command that needs the lease of the cell goes into the journal before it is sent. Where a running dispatcher of
// this user holds the journal, it is asked to pass Unhold and Clear; for the others it has to end first. A lost memory
// of the cell is accepted by a person only.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/dispatch/contact_cell.h"
#include "app/dispatch/operator.h"
#include "app/store/project_context.h"
#include "devices/journal/journal_event.h"
#include "devices/wire/blocks.h"

namespace qchopper {

struct CellStatusReport {
    std::string endpoint;
    Status status;
    std::optional<SeenStore> store;  // as the cell shows it; nothing if it cannot be read
    bool has_journal = false;        // of this cell, on this computer
    std::string store_loss;          // what shows that the cell lost its memory, or empty
};

struct CellControlReport {
    std::string endpoint;
    std::string action;  // "hold"
    std::string end;     // "done", "refused", "unknown"
    std::string why;
    std::string result;  // "LOCAL_CONTROL", or empty
    Sentence note;       // what the operator must know of the action, or empty
    Sentence to_do;      // empty if it was done
    bool simulated = false;
    std::string state;  // of the machine, last read
};

// hold, stop or abort: what runs in the cell is to stand.
bool is_to_stand(const std::string& action);

// What the cell says of itself, its memory compared with the one that the journal knows.
CellStatusReport cell_status(ContactedCell& cell);

// `action`: hold, unhold, stop, abort, clear, reset or take-over; `takeover_code`, given at the cell's panel, of the
// last one. Throws InputError: (use) another action, (busy) a dispatcher holds the cell and does not pass this on.
CellControlReport send_command(ContactedCell& cell, const std::string& action, std::uint32_t takeover_code,
                               const Context& context);

// Accepts the memory that the cell has now. What the journal has open is settled with it: what became of these jobs
// only the operator knows, who is warned of each. At a real cell the operator is asked, unless `is_confirmed`. Throws
// DeviceError (protocol) if the memory cannot be read, and what `person` throws.
CellControlReport accept_store(ContactedCell& cell, bool is_confirmed, const Operator& person,
                               const ProjectContext& context);

}  // namespace qchopper
