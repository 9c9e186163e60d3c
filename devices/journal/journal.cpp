// SQLite with a write-ahead log and synchronous=FULL: a commit ends with fdatasync() of the log. flock() on a file
// beside it, because SQLite lets a second writer wait and not refuse. That file also holds the number of rows: it is
// written after the sync of the row and never synced itself, so that a loss of power leaves it at most too small. A new
// journal is made aside with its tables and renamed: one without tables has lost its log. All rows are read and
// verified when it is opened, O(rows), and kept.
//
// Why the number of rows: the chain of hashes does not show that the last rows are missing, and without SQLite's log
// the file is a whole older journal or none. A mark that the log is there would refuse a journal whose log another
// program has folded in; a rollback journal needs two syncs more for each row. What deletes both files, or puts the
// whole folder back, is found by the cell's memory only (STORE_ID, counters, the number of the last CLAIM).

#include "devices/journal/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "base/error.h"
#include "devices/journal/journal_database.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// For the owner only: the journal holds the secret of the lease.
void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (!error) fs::permissions(folder, fs::perms::owner_all, error);
    if (error) {
        throw InputError(InputFault::create, folder.string() + ": cannot be made: " + error.message(),
                         "Check XDG_STATE_HOME and the rights there.");
    }
}

// Held until the descriptor is closed, by the kernel if the process dies.
class WriterLock {
 public:
    WriterLock(const fs::path& folder, const JournalCell& cell)
        : descriptor_(::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
        if (descriptor_ < 0) refuse_write(folder, "its lock file cannot be opened");
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
        ::close(descriptor_);
        throw InputError(InputFault::busy,
                         "another program on this computer drives " + to_text(cell) + " (" +
                             (folder / "lock").string() + " is locked)",
                         "Wait until it has ended.");
    }
    ~WriterLock() { ::close(descriptor_); }
    WriterLock(const WriterLock&) = delete;
    WriterLock& operator=(const WriterLock&) = delete;

    // In one write, and of a fixed length. A number that cannot be written stays too small, which does no harm.
    void note_last_row(std::int64_t number) const {
        char text[24];
        const int length = std::snprintf(text, sizeof text, "%020lld\n", static_cast<long long>(number));
        const ssize_t ignored = ::pwrite(descriptor_, text, static_cast<std::size_t>(length), 0);
        static_cast<void>(ignored);
    }

 private:
    int descriptor_;
};

const fs::path& made(const fs::path& folder) {
    make_folder(folder);
    return folder;
}

}  // namespace

std::uint64_t unix_ms() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

std::string to_text(const JournalCell& cell) {
    const std::string name = "cell " + std::to_string(cell.cell_id);
    return cell.simulated ? "the simulated " + name + " at " + cell.endpoint : name;
}

std::string folder_name(const JournalCell& cell) {
    const std::string id = std::to_string(cell.cell_id);
    if (!cell.simulated) return "cell-" + id;
    std::string where = cell.endpoint;
    for (char& c : where) {
        const bool is_portable =
            (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '-';
        if (!is_portable) c = '_';
    }
    return "simulated-" + id + "-at-" + where;
}

struct Journal::Store {
    Store(const fs::path& folder, const JournalCell& cell)
        : lock(made(folder), cell), database(with_journal(folder, cell), Database::Opens::to_write) {}
    // Under the lock.
    static const fs::path& with_journal(const fs::path& folder, const JournalCell& cell) {
        std::error_code error;
        if (fs::exists(fs::symlink_status(journal_file(folder), error))) return folder;
        if (const std::int64_t rows = last_row_noted(folder); rows > 0) {
            refuse_damaged(folder, "it is gone, and " + std::to_string(rows) + " rows were written");
        }
        make_journal(folder, cell);
        return folder;
    }
    WriterLock lock;
    Database database;
    JournalContent content;
};

JournalContent read_journal(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(journal_file(folder), error)) {
        throw InputError(InputFault::missing, journal_file(folder).string() + ": there is no journal",
                         "It is made by the first dispatch to the cell.");
    }
    Database database(folder, Database::Opens::to_read);
    return read_content(database);
}

Journal::Journal(const fs::path& folder, const JournalCell& cell) : store_(std::make_unique<Store>(folder, cell)) {
    Database& database = store_->database;
    database.run("PRAGMA journal_mode=WAL");
    database.run("PRAGMA synchronous=FULL");
    store_->content = read_content(database);
    if (store_->content.cell != cell) {
        throw InputError(InputFault::config,
                         journal_file(folder).string() + " is the journal of " + to_text(store_->content.cell) +
                             ", not of " + to_text(cell),
                         "Put back the journal of this cell, or move this one away.");
    }
}

Journal::~Journal() = default;

const JournalContent& Journal::content() const {
    return store_->content;
}

void Journal::append(const JournalEvent& event) {
    JournalContent& content = store_->content;
    JournalRow row{content.last_number() + 1, unix_ms(), event};
    row.hash = content.hash = add_row(store_->database, row, content.hash);
    content.rows.push_back(std::move(row));
    store_->lock.note_last_row(content.last_number());
}

void Journal::remove_exported(const JournalHead& head, const std::vector<JournalEvent>& events) {
    JournalContent& content = store_->content;
    JournalContent shorter{content.cell, head, {}, content.hash};
    for (const JournalRow& row : content.rows) {
        if (row.number > head.number) shorter.rows.push_back(row);
    }
    Database& database = store_->database;
    database.run("BEGIN IMMEDIATE");
    try {
        for (const JournalEvent& event : events) {
            JournalRow row{shorter.last_number() + 1, unix_ms(), event};
            row.hash = shorter.hash = add_row(database, row, shorter.hash);
            shorter.rows.push_back(std::move(row));
        }
        database.run("DROP TABLE IF EXISTS head");
        set_head(database, head);
        database.run("DELETE FROM event WHERE n <= " + std::to_string(head.number));
        database.run("COMMIT");
    } catch (...) {
        database.try_to_run("ROLLBACK");
        throw;
    }
    content = std::move(shorter);
    store_->lock.note_last_row(content.last_number());
    database.try_to_run("VACUUM");  // only gives back the room
}

}  // namespace qchopper
