// Environment and names of folders. O(folders), and a look-up in the name service for each other name of a journal.

#include "app/dispatch/state_folder.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <vector>

#include "base/error.h"
#include "devices/wire/modbus_tcp.h"

namespace qchopper {

namespace fs = std::filesystem;

namespace {

// When the journal was written last; nothing if there is none.
std::optional<fs::file_time_type> written_at(const JournalCell& cell) {
    std::optional<fs::file_time_type> latest;
    for (const char* file : {"journal.sqlite", "journal.sqlite-wal"}) {
        std::error_code error;
        const fs::file_time_type at = fs::last_write_time(journal_folder(cell) / file, error);
        if (!error && (!latest || at > *latest)) latest = at;
    }
    return latest;
}

// "localhost:15020" of "simulated-7-at-localhost_15020": of a folder with the id and the port of `cell`, else "".
std::string endpoint_of(const std::string& folder, const JournalCell& cell) {
    const std::string port = cell.endpoint.substr(cell.endpoint.rfind(':') + 1);
    const std::string head = "simulated-" + std::to_string(cell.cell_id) + "-at-";
    const std::string tail = "_" + port;
    if (folder.size() <= head.size() + tail.size() || !folder.starts_with(head) || !folder.ends_with(tail)) return {};
    const std::string host = folder.substr(head.size(), folder.size() - head.size() - tail.size());
    return host.find('_') == std::string::npos ? host + ":" + port : std::string();  // an IPv6 address is numeric
}

bool has_journal(const fs::path& folder) {
    std::error_code error;
    return fs::exists(folder / "journal.sqlite", error);
}

bool stands_for(const std::string& endpoint, const std::string& address) {
    const std::vector<std::string> addresses = numeric_addresses(parse_tcp_address(endpoint));
    return std::find(addresses.begin(), addresses.end(), address) != addresses.end();
}

}  // namespace

fs::path state_folder() {
    const char* state = std::getenv("XDG_STATE_HOME");
    if (state != nullptr && state[0] == '/') return fs::path(state) / "qchopper";
    const char* home = std::getenv("HOME");
    if (home == nullptr || home[0] != '/') {
        throw InputError(InputFault::create,
                         "there is no folder for the journal: neither XDG_STATE_HOME nor HOME is set",
                         "Set XDG_STATE_HOME to a folder that stays.");
    }
    return fs::path(home) / ".local" / "state" / "qchopper";
}

std::filesystem::path journal_folder(const JournalCell& cell) {
    return state_folder() / folder_name(cell);
}

JournalCell journal_cell(std::uint16_t cell_id, bool simulated, const std::string& address) {
    JournalCell cell{cell_id, simulated, simulated ? address : std::string()};
    if (!simulated) return cell;
    std::error_code error;
    auto newest = written_at(cell);
    std::vector<std::string> names;
    for (fs::directory_iterator entry(state_folder(), error), end; !error && entry != end; entry.increment(error)) {
        names.push_back(entry->path().filename().string());
    }
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) {
        const JournalCell known{cell_id, true, endpoint_of(name, cell)};
        if (known.endpoint.empty() || folder_name(known) != name) continue;
        const auto at = written_at(known);
        if (!at || (newest && *at <= *newest) || !stands_for(known.endpoint, address)) continue;
        newest = at;
        cell = known;
    }
    return cell;
}

std::vector<fs::path> journal_folders(const fs::path& wanted) {
    const fs::path state = state_folder();
    if (!wanted.empty()) return {has_journal(wanted) ? wanted : state / wanted};
    std::vector<fs::path> folders;
    std::error_code error;
    for (fs::directory_iterator entry(state, error), end; !error && entry != end; entry.increment(error)) {
        if (has_journal(entry->path())) folders.push_back(entry->path());
    }
    std::sort(folders.begin(), folders.end());
    return folders;
}

}  // namespace qchopper
