// What a journal holds: its cell, its rows with their hashes, and where its chain begins.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "devices/journal/journal_event.h"

namespace qchopper {

struct JournalCell {
    std::uint16_t cell_id = 0;
    bool simulated = false;
    std::string endpoint;  // "127.0.0.1:15020" of a simulated cell; empty for a real one, which its id names alone
    bool operator==(const JournalCell&) const = default;
};

struct JournalRow {
    std::int64_t number = 0;    // from 1, without gaps; after an export from the number after its last row
    std::uint64_t unix_ms = 0;  // nothing is decided by it
    JournalEvent event;
    std::string hash{};  // over it and the row before, 64 digits
};

// Where the chain goes on: the last row that was exported and removed.
struct JournalHead {
    std::int64_t number = 0;  // 0: none was
    std::string hash;         // 64 digits
    bool operator==(const JournalHead&) const = default;
};

struct JournalContent {
    JournalCell cell;
    JournalHead head;
    std::vector<JournalRow> rows;
    std::string hash;  // of the last row, 64 digits

    std::int64_t last_number() const { return rows.empty() ? head.number : rows.back().number; }
};

}  // namespace qchopper
