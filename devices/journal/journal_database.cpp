// Every row is verified as it is read: number, hash of the row before, own hash, grammar. O(rows).

#include "devices/journal/journal_database.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <charconv>

#include "base/error.h"
#include "base/files/file.h"
#include "base/sha256.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr const char* first_format = "qchopper-journal-1";   // also the first word of the chain
constexpr const char* headed_format = "qchopper-journal-2";  // its first rows were removed
constexpr const char* keep_it =
    "Keep the folder as it is for the inspection, and give dispatch an empty one by moving it away; the cell still "
    "refuses a file that it has carved.";

// The hash of a row, 64 digits.
std::string chained(const std::string& before, std::int64_t number, std::uint64_t time_ms, const std::string& kind,
                    const std::string& text) {
    const std::string row =
        before + "\n" + std::to_string(number) + "\n" + std::to_string(time_ms) + "\n" + kind + "\n" + text;
    return to_hex(sha256({reinterpret_cast<const std::uint8_t*>(row.data()), row.size()}));
}

std::string first_hash(const JournalCell& cell) {
    return chained(first_format, cell.cell_id, cell.simulated ? 1 : 0, "cell", cell.endpoint);
}

bool has_table(Database& database, const char* name) {
    Statement statement(database, "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = ?");
    statement.set(1, std::string(name));
    return statement.step() && statement.number(0) == 1;
}

void check_format(const fs::path& folder, const std::string& format, bool has_head) {
    if (format != first_format && format != headed_format) {
        throw InputError(InputFault::config,
                         journal_file(folder).string() + " is a journal of another version: its format is \"" + format +
                             "\", and this program reads " + first_format + " and " + headed_format,
                         "Read it with the program that wrote it.");
    }
    if (has_head != (format == headed_format)) {
        refuse_damaged(folder, "format and tables disagree on whether its first rows were exported");
    }
}

JournalCell read_cell_of(Database& database) {
    Statement statement(database, "SELECT format, cell_id, simulated, endpoint FROM meta");
    if (!statement.step()) refuse_damaged(database.folder(), "it does not say which cell it is of");
    check_format(database.folder(), statement.text(0), has_table(database, "head"));
    JournalCell cell;
    cell.cell_id = static_cast<std::uint16_t>(statement.number(1));
    cell.simulated = statement.number(2) != 0;
    cell.endpoint = statement.text(3);
    return cell;
}

JournalHead read_head_of(Database& database) {
    if (!has_table(database, "head")) return {};
    Statement statement(database, "SELECT n, hash FROM head");
    if (!statement.step() || statement.number(0) <= 0) {
        refuse_damaged(database.folder(), "it does not say which rows were exported");
    }
    return {statement.number(0), statement.text(1)};
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
    row.hash = hash;
    return row;
}

// The rows say themselves that those before them were exported.
void check_head(const JournalContent& content, const fs::path& folder) {
    if (content.head.number == 0) return;
    for (const JournalRow& row : content.rows) {
        if (row.event.kind == JournalKind::head && row.event.rows == content.head.number &&
            to_hex(row.event.file_sha256) == content.head.hash) {
            return;
        }
    }
    refuse_damaged(folder, "its rows up to " + std::to_string(content.head.number) +
                               " are missing, and no row says that they were exported");
}

void sync_folder(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

}  // namespace

Database::Database(const fs::path& folder, const fs::path& file, Opens opens) : folder_(folder) {
    check_regular_file(file);
    const int how = opens == Opens::to_read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE;
    const int flags = SQLITE_OPEN_NOMUTEX | how | (opens == Opens::new_file ? SQLITE_OPEN_CREATE : 0);
    if (sqlite3_open_v2(file.c_str(), &handle_, flags, nullptr) != SQLITE_OK) {
        const std::string why = sqlite3_errmsg(handle_);
        sqlite3_close(handle_);
        throw InputError(InputFault::create, journal_file(folder).string() + ": " + why,
                         "Check the rights of the folder.");
    }
    constexpr int patience_ms = 2000;  // for another process that is just ending
    sqlite3_busy_timeout(handle_, patience_ms);
}

Database::~Database() {
    sqlite3_close(handle_);
}

void Database::run(const std::string& sql) {
    if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

void Database::try_to_run(const std::string& sql) {
    sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr);
}

void Database::fail() const {
    const int code = sqlite3_errcode(handle_);
    const std::string why = sqlite3_errmsg(handle_);
    if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) refuse_damaged(folder_, why);
    refuse_write(folder_, why);
}

Statement::Statement(Database& database, const char* sql) : database_(database) {
    if (sqlite3_prepare_v2(database.handle(), sql, -1, &statement_, nullptr) != SQLITE_OK) database.fail();
}

Statement::~Statement() {
    sqlite3_finalize(statement_);
}

void Statement::set(int column, std::int64_t value) {
    sqlite3_bind_int64(statement_, column, value);
}

void Statement::set(int column, const std::string& value) {
    sqlite3_bind_text(statement_, column, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
}

bool Statement::step() {
    const int end = sqlite3_step(statement_);
    if (end == SQLITE_ROW) return true;
    if (end != SQLITE_DONE) database_.fail();
    return false;
}

std::int64_t Statement::number(int column) {
    return sqlite3_column_int64(statement_, column);
}

std::string Statement::text(int column) {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return text == nullptr ? std::string()
                           : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
}

fs::path journal_file(const fs::path& folder) {
    return folder / "journal.sqlite";
}

void refuse_damaged(const fs::path& folder, const std::string& why) {
    throw InputError(InputFault::config, journal_file(folder).string() + " is damaged: " + why, keep_it);
}

void refuse_write(const fs::path& folder, const std::string& why) {
    throw InputError(InputFault::io, journal_file(folder).string() + ": the journal cannot be written: " + why,
                     "Free space on the disk and check the rights of the folder.");
}

std::int64_t last_row_noted(const fs::path& folder) {
    try {
        const Bytes bytes = read_file(folder / "lock", settings_limit);
        std::int64_t number = 0;
        std::from_chars(reinterpret_cast<const char*>(bytes.data()),
                        reinterpret_cast<const char*>(bytes.data() + bytes.size()), number);
        return number;
    } catch (const InputError&) {
        return 0;
    }
}

std::string hash_before_rows(const JournalContent& content) {
    return content.head.number == 0 ? first_hash(content.cell) : content.head.hash;
}

JournalContent read_content(Database& database) {
    if (!has_table(database, "meta") || !has_table(database, "event"))
        refuse_damaged(database.folder(), "it is no journal, or its log journal.sqlite-wal is gone");
    const std::int64_t noted = last_row_noted(database.folder());  // read first: a writer may add rows meanwhile
    database.run("BEGIN");                                         // one state of head and rows
    JournalContent content;
    content.cell = read_cell_of(database);
    content.head = read_head_of(database);
    content.hash = hash_before_rows(content);
    {
        Statement statement(database, "SELECT n, t, kind, data, prev_hash, hash FROM event ORDER BY n");
        while (statement.step()) {
            content.rows.push_back(checked_row(statement, database.folder(), content.last_number() + 1, content.hash));
        }
    }
    database.run("COMMIT");
    check_head(content, database.folder());
    if (content.last_number() < noted) {
        refuse_damaged(database.folder(), "row " + std::to_string(content.last_number() + 1) + " is missing, and " +
                                              std::to_string(noted) +
                                              " were written: its log journal.sqlite-wal is gone, or an older copy was "
                                              "put back");
    }
    return content;
}

void set_head(Database& database, const JournalHead& head) {
    database.run("CREATE TABLE head(n INTEGER, hash TEXT)");
    Statement statement(database, "INSERT INTO head VALUES(?, ?)");
    statement.set(1, head.number);
    statement.set(2, head.hash);
    statement.step();
    database.run("UPDATE meta SET format = 'qchopper-journal-2'");
}

namespace {

// Of a new journal, and its head if that is not 0.
void make_tables(Database& database, const JournalCell& cell, const JournalHead& head) {
    database.run("BEGIN IMMEDIATE");
    database.run("CREATE TABLE meta(format TEXT, cell_id INTEGER, simulated INTEGER, endpoint TEXT)");
    database.run(
        "CREATE TABLE event(n INTEGER PRIMARY KEY, t INTEGER NOT NULL, kind TEXT NOT NULL, data TEXT NOT NULL, "
        "prev_hash TEXT NOT NULL, hash TEXT NOT NULL)");
    {
        Statement statement(database, "INSERT INTO meta VALUES(?, ?, ?, ?)");
        statement.set(1, std::string(first_format));
        statement.set(2, cell.cell_id);
        statement.set(3, cell.simulated ? 1 : 0);
        statement.set(4, cell.endpoint);
        statement.step();
    }
    if (head.number != 0) set_head(database, head);
    database.run("COMMIT");
}

}  // namespace

std::string add_row(Database& database, const JournalRow& row, const std::string& hash_before) {
    const std::string text = text_of(row.event);
    std::string hash = chained(hash_before, row.number, row.unix_ms, name(row.event.kind), text);
    Statement statement(database, "INSERT INTO event VALUES(?, ?, ?, ?, ?, ?)");
    statement.set(1, row.number);
    statement.set(2, static_cast<std::int64_t>(row.unix_ms));
    statement.set(3, std::string(name(row.event.kind)));
    statement.set(4, text);
    statement.set(5, hash_before);
    statement.set(6, hash);
    statement.step();
    return hash;
}

void make_journal(const fs::path& folder, const JournalCell& cell, const JournalHead& head) {
    const fs::path aside = folder / "journal.sqlite.new";
    std::error_code error;
    for (const char* rest : {"", "-journal"}) fs::remove(aside.string() + rest, error);  // of one that was killed
    for (const char* rest : {"-wal", "-shm"})
        fs::remove(journal_file(folder).string() + rest, error);  // of one removed
    {
        Database database(folder, aside, Database::Opens::new_file);
        database.run("PRAGMA synchronous=FULL");
        make_tables(database, cell, head);
    }
    ::chmod(aside.c_str(), 0600);
    fs::rename(aside, journal_file(folder), error);
    if (error) refuse_write(folder, error.message());
    sync_folder(folder);
}

}  // namespace qchopper
