// Which first rows of a journal can be exported and removed, and what of them must stay for the next dispatcher.
//
// Rows go only with whole jobs: those that are closed, and older than a time. The rows that take their place say the
// same to a dispatcher: history_of() gives the same cell and the same jobs that are left, and of each removed job that
// started or may have, file, ticket, end and times (tests/devices/hand_off/journal_retention_test.cpp). What stays
// unsaid are the jobs that were not started.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "devices/hand_off/journal_history.h"

namespace qchopper {

struct JournalExport {
    JournalHead head;                  // number 0: nothing can be exported
    std::vector<JournalEvent> events;  // for Journal::remove_exported()
    std::size_t jobs = 0;              // that are removed
    std::string why_not_more;          // a sentence: what keeps the rows after head, or empty
};

// What to export of `content`: jobs whose last row is older than before_ms. O(rows) for each place that is tried, which
// is the last one that can be as a rule.
JournalExport plan_export(const JournalContent& content, std::uint64_t before_ms);

}  // namespace qchopper
