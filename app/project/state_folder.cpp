// Environment and names only.

#include "app/project/state_folder.h"

#include <cstdlib>

#include "base/error.h"

namespace qchopper {

std::filesystem::path state_folder() {
    const char* state = std::getenv("XDG_STATE_HOME");
    if (state != nullptr && state[0] == '/') return std::filesystem::path(state) / "qchopper";
    const char* home = std::getenv("HOME");
    if (home == nullptr || home[0] != '/') {
        throw InputError(InputFault::create,
                         "there is no folder for the journal: neither XDG_STATE_HOME nor HOME is set",
                         "Set XDG_STATE_HOME to a folder that stays.");
    }
    return std::filesystem::path(home) / ".local" / "state" / "qchopper";
}

std::filesystem::path journal_folder(const JournalCell& cell) {
    return state_folder() / folder_name(cell);
}

JournalCell journal_cell(std::uint16_t cell_id, bool simulated, const std::string& endpoint) {
    return {cell_id, simulated, simulated ? endpoint : std::string()};
}

}  // namespace qchopper
