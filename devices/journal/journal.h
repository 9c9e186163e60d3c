// The journal of one cell: what its dispatchers were about to do and what the cell answered, in a file that survives
// kill -9 and loss of power.
//
// A row that append() has written is on the disk when it returns. Rows are hash-chained: each holds the SHA-256 over
// itself and the hash of the row before, the first over the cell the journal is of. A changed, missing or inserted row
// is found; rows that are missing at the end are found by their number, which stands in the file `lock` beside the
// journal. One process writes; others may read meanwhile (tests/devices/journal/journal_test.cpp).

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "devices/journal/journal_content.h"

namespace qchopper {

// "cell 7", "the simulated cell 7 at 127.0.0.1:15020"
std::string to_text(const JournalCell& cell);
// The name of the folder of its journal: "cell-7", "simulated-7-at-127.0.0.1_15020".
std::string folder_name(const JournalCell& cell);

// Milliseconds since 1970 by the clock of this PC.
std::uint64_t unix_ms();

// Reads and verifies the journal in `folder`, also while another process writes it. Throws InputError: missing if there
// is none or it is no regular file, config with the number of the row if the chain or a row is damaged or missing.
JournalContent read_journal(const std::filesystem::path& folder);

// The only writer.
class Journal {
 public:
    // Opens the journal in `folder`, or makes both. Throws InputError: busy if another process writes it, config if it
    // is damaged as for read_journal() or the journal of another cell, missing if it is no regular file, create or io
    // if it cannot be made or read.
    Journal(const std::filesystem::path& folder, const JournalCell& cell);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    // Throws InputError (io) if the row could not be brought to the disk; then it is not in the journal.
    void append(const JournalEvent& event);

    // Appends `events` and removes the rows up to head.number, both or nothing. One of the events is of kind head and
    // holds number and hash of `head`. Throws InputError (io) if that could not be brought to the disk. Precondition:
    // the rows are on the disk elsewhere.
    void remove_exported(const JournalHead& head, const std::vector<JournalEvent>& events);

    const JournalContent& content() const;

 private:
    struct Store;
    std::unique_ptr<Store> store_;
};

// Makes `folder` and in it a journal of the rows of `content` up to number `last`, with their hashes, for
// read_journal(); it is on the disk when this returns. Throws InputError: create if the folder is there or cannot be
// made, io if it cannot be written.
void write_exported(const std::filesystem::path& folder, const JournalContent& content, std::int64_t last);

}  // namespace qchopper
