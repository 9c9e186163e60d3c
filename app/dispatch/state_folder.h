// Where the journals of cells lie: in the user's state folder, by the XDG base directory specification.
//
// That is $XDG_STATE_HOME/qchopper, or ~/.local/state/qchopper if that is not set or not an absolute path. All
// functions throw InputError (create) if HOME is not set either. Not in a project: two projects must not drive one
// cell.

#pragma once

#include <filesystem>
#include <vector>

#include "devices/journal/journal.h"

namespace qchopper {

std::filesystem::path state_folder();

// The folder of the journal of a cell, whether it exists or not.
std::filesystem::path journal_folder(const JournalCell& cell);

// The cell that shows this id, as its journal names it. A simulated one is told apart by the numeric address
// ("127.0.0.1:15020") from which it answers; where there is a journal already under a name of that address
// ("localhost:15020"), it is that one, and of several the one that was written last. Resolves the names of the journals
// that are there.
JournalCell journal_cell(std::uint16_t cell_id, bool simulated, const std::string& address);

// Of all journals that are there, by name; or of the one that is named, as a path or as a name in the state folder,
// whether it exists or not.
std::vector<std::filesystem::path> journal_folders(const std::filesystem::path& wanted);

}  // namespace qchopper
