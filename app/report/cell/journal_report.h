// What `qchopper journal` shows: the rows of a journal as sentences, one JSON document for programs. O(rows).

#pragma once

#include <string>
#include <vector>

#include "app/report/document.h"
#include "devices/journal/journal.h"

namespace qchopper {

struct JournalReport {
    std::string folder;
    JournalContent content;
    bool shows = true;  // the rows too
};

// What `qchopper journal export` did.
struct ExportedRows {
    std::string journal;
    std::string out;
    JournalHead head;          // number 0: there was nothing to export
    std::size_t jobs = 0;      // whose rows were exported
    std::string why_not_more;  // a sentence, or empty
};

std::vector<std::string> lines(const ExportedRows& report);
Document document(const ExportedRows& report);

std::vector<std::string> lines(const std::vector<JournalReport>& reports);
Document document(const std::vector<JournalReport>& reports);

}  // namespace qchopper
