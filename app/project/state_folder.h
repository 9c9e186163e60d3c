// Where the journals of cells lie: in the user's state folder, by the XDG base directory specification.
//
// Not in a project: two projects must not drive one cell.

#pragma once

#include <filesystem>

#include "devices/journal.h"

namespace qchopper {

// $XDG_STATE_HOME/qchopper, or ~/.local/state/qchopper if that is not set or not an absolute path. Throws InputError
// (create) if HOME is not set either.
std::filesystem::path state_folder();

// The folder of the journal of a cell, whether it exists or not.
std::filesystem::path journal_folder(const JournalCell& cell);

// The cell at `endpoint` ("127.0.0.1:15020") that shows this id. A simulated one is told apart by its address.
JournalCell journal_cell(std::uint16_t cell_id, bool simulated, const std::string& endpoint);

}  // namespace qchopper
