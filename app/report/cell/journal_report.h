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

std::vector<std::string> lines(const std::vector<JournalReport>& reports);
Document document(const std::vector<JournalReport>& reports);

}  // namespace qchopper
