// The SQLite file of a journal, its tables, and rows that are verified as they are read: for the sources of this
// folder.
//
// Table `meta` holds format and cell, `event` the rows, and `head`, where the first rows were exported and removed,
// number and hash of the last one of them: there the chain goes on.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "devices/journal/journal_content.h"

struct sqlite3;
struct sqlite3_stmt;

namespace qchopper {

std::filesystem::path journal_file(const std::filesystem::path& folder);

// Each throws InputError: config, and io.
[[noreturn]] void refuse_damaged(const std::filesystem::path& folder, const std::string& why);
[[noreturn]] void refuse_write(const std::filesystem::path& folder, const std::string& why);

// What run() and the steps of a Statement throw: InputError, config if the file is damaged, else io.
class Database {
 public:
    enum class Opens { to_read, to_write, new_file };
    Database(const std::filesystem::path& folder, Opens opens) : Database(folder, journal_file(folder), opens) {}
    // `file` is what becomes the journal of the folder.
    Database(const std::filesystem::path& folder, const std::filesystem::path& file, Opens opens);
    ~Database();
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;

    void run(const std::string& sql);
    // The same, and whether it worked is not looked at.
    void try_to_run(const std::string& sql);
    [[noreturn]] void fail() const;
    sqlite3* handle() const { return handle_; }
    const std::filesystem::path& folder() const { return folder_; }

 private:
    std::filesystem::path folder_;
    sqlite3* handle_ = nullptr;
};

class Statement {
 public:
    Statement(Database& database, const char* sql);
    ~Statement();
    Statement(const Statement&) = delete;
    Statement& operator=(const Statement&) = delete;

    void set(int column, std::int64_t value);
    void set(int column, const std::string& value);
    // True while there is a row.
    bool step();
    std::int64_t number(int column);
    std::string text(int column);

 private:
    Database& database_;
    sqlite3_stmt* statement_ = nullptr;
};

// Precondition: inside of a transaction, and no head in the file.
void set_head(Database& database, const JournalHead& head);
// The hash of the added row.
std::string add_row(Database& database, const JournalRow& row, const std::string& hash_before);
// The journal as it is in this file, verified. Throws InputError as read_journal() does.
JournalContent read_content(Database& database);
// The hash that the first row follows.
std::string hash_before_rows(const JournalContent& content);
// Makes the file of a journal without rows, aside and renamed, so that it is there with its tables or not at all; for
// the owner only. Throws InputError (io).
void make_journal(const std::filesystem::path& folder, const JournalCell& cell, const JournalHead& head = {});
// The number of the last row as the file `lock` has it; 0 if it is not known.
std::int64_t last_row_noted(const std::filesystem::path& folder);

}  // namespace qchopper
