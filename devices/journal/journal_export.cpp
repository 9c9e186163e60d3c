// A journal of its own for rows that are exported, written in one transaction. O(rows).

#include "base/error.h"
#include "devices/journal/journal.h"
#include "devices/journal/journal_database.h"

namespace qchopper {

namespace fs = std::filesystem;

void write_exported(const fs::path& folder, const JournalContent& content, std::int64_t last) {
    std::error_code error;
    if (!fs::create_directory(folder, error)) {
        throw InputError(InputFault::create,
                         folder.string() + (error ? ": cannot be made: " + error.message() : " is there already"),
                         "Name a folder that is not there, in one that is.");
    }
    fs::permissions(folder, fs::perms::owner_all, error);
    make_journal(folder, content.cell, content.head);
    Database database(folder, Database::Opens::to_write);
    database.run("PRAGMA synchronous=FULL");
    database.run("BEGIN IMMEDIATE");
    std::string hash = hash_before_rows(content);
    for (const JournalRow& row : content.rows) {
        if (row.number <= last) hash = add_row(database, row, hash);
    }
    database.run("COMMIT");
}

}  // namespace qchopper
