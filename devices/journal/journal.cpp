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
#include <sqlite3.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <cstdio>

#include "base/error.h"
#include "base/files/file.h"
#include "base/sha256.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr const char* format = "qchopper-journal-1";
constexpr const char* keep_it =
    "Keep the folder as it is for the inspection, and give dispatch an empty one by moving it away; the cell still "
    "refuses a file that it has carved.";

fs::path file_in(const fs::path& folder) {
    return folder / "journal.sqlite";
}

[[noreturn]] void refuse_damaged(const fs::path& folder, const std::string& why) {
    throw InputError(InputFault::config, file_in(folder).string() + " is damaged: " + why, keep_it);
}

[[noreturn]] void refuse_write(const fs::path& folder, const std::string& why) {
    throw InputError(InputFault::io, file_in(folder).string() + ": the journal cannot be written: " + why,
                     "Free space on the disk and check the rights of the folder.");
}

std::string chained(const std::string& before, std::int64_t number, std::uint64_t time_ms, const std::string& kind,
                    const std::string& text) {
    const std::string row =
        before + "\n" + std::to_string(number) + "\n" + std::to_string(time_ms) + "\n" + kind + "\n" + text;
    return to_hex(sha256({reinterpret_cast<const std::uint8_t*>(row.data()), row.size()}));
}

std::string first_hash(const JournalCell& cell) {
    return chained(format, cell.cell_id, cell.simulated ? 1 : 0, "cell", cell.endpoint);
}

class Database {
 public:
    Database(const fs::path& folder, int flags) : Database(folder, file_in(folder), flags) {}
    Database(const fs::path& folder, const fs::path& file, int flags) : folder_(folder) {
        check_regular_file(file);
        if (sqlite3_open_v2(file.c_str(), &handle_, flags, nullptr) != SQLITE_OK) {
            const std::string why = sqlite3_errmsg(handle_);
            sqlite3_close(handle_);
            throw InputError(InputFault::create, file_in(folder).string() + ": " + why,
                             "Check the rights of the folder.");
        }
        constexpr int patience_ms = 2000;  // for another process that is just ending
        sqlite3_busy_timeout(handle_, patience_ms);
    }
    ~Database() { sqlite3_close(handle_); }
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;

    void run(const char* sql) {
        if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
    }
    [[noreturn]] void fail() const {
        const int code = sqlite3_errcode(handle_);
        const std::string why = sqlite3_errmsg(handle_);
        if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) refuse_damaged(folder_, why);
        refuse_write(folder_, why);
    }
    sqlite3* handle() const { return handle_; }
    const fs::path& folder() const { return folder_; }

 private:
    fs::path folder_;
    sqlite3* handle_ = nullptr;
};

class Statement {
 public:
    Statement(Database& database, const char* sql) : database_(database) {
        if (sqlite3_prepare_v2(database.handle(), sql, -1, &statement_, nullptr) != SQLITE_OK) database.fail();
    }
    ~Statement() { sqlite3_finalize(statement_); }
    Statement(const Statement&) = delete;
    Statement& operator=(const Statement&) = delete;

    void set(int column, std::int64_t value) { sqlite3_bind_int64(statement_, column, value); }
    void set(int column, const std::string& value) {
        sqlite3_bind_text(statement_, column, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
    }
    // True while there is a row.
    bool step() {
        const int end = sqlite3_step(statement_);
        if (end == SQLITE_ROW) return true;
        if (end != SQLITE_DONE) database_.fail();
        return false;
    }
    std::int64_t number(int column) { return sqlite3_column_int64(statement_, column); }
    std::string text(int column) {
        const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
        return text == nullptr ? std::string()
                               : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
    }

 private:
    Database& database_;
    sqlite3_stmt* statement_ = nullptr;
};

bool has_tables(Database& database) {
    Statement statement(database, "SELECT count(*) FROM sqlite_master WHERE name IN ('meta', 'event')");
    return statement.step() && statement.number(0) == 2;
}

JournalCell read_cell_of(Database& database) {
    Statement statement(database, "SELECT format, cell_id, simulated, endpoint FROM meta");
    if (!statement.step()) refuse_damaged(database.folder(), "it does not say which cell it is of");
    if (statement.text(0) != format) refuse_damaged(database.folder(), "its format is not " + std::string(format));
    JournalCell cell;
    cell.cell_id = static_cast<std::uint16_t>(statement.number(1));
    cell.simulated = statement.number(2) != 0;
    cell.endpoint = statement.text(3);
    return cell;
}

JournalRow checked_row(Statement& statement, const fs::path& folder, std::int64_t number, std::string& hash) {
    const std::string where = "row " + std::to_string(number);
    if (statement.number(0) != number) refuse_damaged(folder, where + " is missing");
    JournalRow row;
    row.number = number;
    row.unix_ms = static_cast<std::uint64_t>(statement.number(1));
    const std::string kind_name = statement.text(2);
    const std::string text = statement.text(3);
    if (statement.text(4) != hash) refuse_damaged(folder, where + " does not follow the row before it");
    hash = chained(hash, number, row.unix_ms, kind_name, text);
    if (statement.text(5) != hash) refuse_damaged(folder, where + " was changed: its hash does not match");
    const std::optional<JournalKind> kind = journal_kind_from(kind_name);
    const std::optional<JournalEvent> event = kind ? event_from(*kind, text) : std::nullopt;
    if (!event) refuse_damaged(folder, where + " is no event of this version");
    row.event = *event;
    return row;
}

// 0 if it is not known.
std::size_t counted_rows(const fs::path& folder) {
    try {
        const Bytes bytes = read_file(folder / "lock", settings_limit);
        std::size_t rows = 0;
        std::from_chars(reinterpret_cast<const char*>(bytes.data()),
                        reinterpret_cast<const char*>(bytes.data() + bytes.size()), rows);
        return rows;
    } catch (const InputError&) {
        return 0;
    }
}

JournalContent read_content(Database& database) {
    if (!has_tables(database))
        refuse_damaged(database.folder(), "it is no journal, or its log journal.sqlite-wal is gone");
    const std::size_t counted = counted_rows(database.folder());  // read first: a writer may add rows meanwhile
    JournalContent content;
    content.cell = read_cell_of(database);
    content.hash = first_hash(content.cell);
    Statement statement(database, "SELECT n, t, kind, data, prev_hash, hash FROM event ORDER BY n");
    while (statement.step()) {
        const auto number = static_cast<std::int64_t>(content.rows.size()) + 1;
        content.rows.push_back(checked_row(statement, database.folder(), number, content.hash));
    }
    if (content.rows.size() < counted) {
        refuse_damaged(database.folder(), "row " + std::to_string(content.rows.size() + 1) + " is missing, and " +
                                              std::to_string(counted) +
                                              " were written: its log journal.sqlite-wal is gone, or an older copy was "
                                              "put back");
    }
    return content;
}

void make_tables(Database& database, const JournalCell& cell) {
    database.run("BEGIN IMMEDIATE");
    database.run("CREATE TABLE meta(format TEXT, cell_id INTEGER, simulated INTEGER, endpoint TEXT)");
    database.run(
        "CREATE TABLE event(n INTEGER PRIMARY KEY, t INTEGER NOT NULL, kind TEXT NOT NULL, data TEXT NOT NULL, "
        "prev_hash TEXT NOT NULL, hash TEXT NOT NULL)");
    Statement statement(database, "INSERT INTO meta VALUES(?, ?, ?, ?)");
    statement.set(1, std::string(format));
    statement.set(2, cell.cell_id);
    statement.set(3, cell.simulated ? 1 : 0);
    statement.set(4, cell.endpoint);
    statement.step();
    database.run("COMMIT");
}

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
    void note_rows(std::size_t rows) const {
        char text[24];
        const int length = std::snprintf(text, sizeof text, "%020zu\n", rows);
        const ssize_t ignored = ::pwrite(descriptor_, text, static_cast<std::size_t>(length), 0);
        static_cast<void>(ignored);
    }

 private:
    int descriptor_;
};

void sync_folder(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

void make_journal(const fs::path& folder, const JournalCell& cell) {
    const fs::path aside = folder / "journal.sqlite.new";
    std::error_code error;
    for (const char* rest : {"", "-journal"}) fs::remove(aside.string() + rest, error);  // of one that was killed
    for (const char* rest : {"-wal", "-shm"}) fs::remove(file_in(folder).string() + rest, error);  // of one removed
    {
        Database database(folder, aside, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX);
        database.run("PRAGMA synchronous=FULL");
        make_tables(database, cell);
    }
    ::chmod(aside.c_str(), 0600);
    fs::rename(aside, file_in(folder), error);
    if (error) refuse_write(folder, error.message());
    sync_folder(folder);
}

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
        : lock(made(folder), cell), database(with_journal(folder, cell), SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX) {}
    // Under the lock.
    static const fs::path& with_journal(const fs::path& folder, const JournalCell& cell) {
        std::error_code error;
        if (fs::exists(fs::symlink_status(file_in(folder), error))) return folder;
        if (const std::size_t rows = counted_rows(folder); rows > 0) {
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
    if (!fs::exists(file_in(folder), error)) {
        throw InputError(InputFault::missing, file_in(folder).string() + ": there is no journal",
                         "It is made by the first dispatch to the cell.");
    }
    Database database(folder, SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX);
    return read_content(database);
}

Journal::Journal(const fs::path& folder, const JournalCell& cell) : store_(std::make_unique<Store>(folder, cell)) {
    Database& database = store_->database;
    database.run("PRAGMA journal_mode=WAL");
    database.run("PRAGMA synchronous=FULL");
    store_->content = read_content(database);
    if (store_->content.cell != cell) {
        throw InputError(InputFault::config,
                         file_in(folder).string() + " is the journal of " + to_text(store_->content.cell) +
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
    JournalRow row{static_cast<std::int64_t>(content.rows.size()) + 1, unix_ms(), event};
    const std::string text = text_of(event);
    const std::string hash = chained(content.hash, row.number, row.unix_ms, name(event.kind), text);
    Statement statement(store_->database, "INSERT INTO event VALUES(?, ?, ?, ?, ?, ?)");
    statement.set(1, row.number);
    statement.set(2, static_cast<std::int64_t>(row.unix_ms));
    statement.set(3, std::string(name(event.kind)));
    statement.set(4, text);
    statement.set(5, content.hash);
    statement.set(6, hash);
    statement.step();
    content.hash = hash;
    content.rows.push_back(std::move(row));
    store_->lock.note_rows(content.rows.size());
}

}  // namespace qchopper
