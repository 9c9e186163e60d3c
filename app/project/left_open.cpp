// Reads up to three journals; O(rows).

#include "app/project/left_open.h"

#include "app/project/state_folder.h"
#include "base/error.h"
#include "devices/codec.h"

namespace qchopper {
namespace {

std::string left_open(const JournalCell& cell) {
    std::string sentences;
    try {
        for (const JournalJob& job : history_of(read_journal(journal_folder(cell)).rows).jobs) {
            const std::string sentence = job.is_open() ? left_open(job) : "";
            if (!sentence.empty()) sentences += (sentences.empty() ? "" : " ") + sentence;
        }
    } catch (const InputError& error) {
        if (error.fault == InputFault::missing || error.fault == InputFault::create) return {};
        return std::string("Whether a job of an earlier dispatch runs is UNKNOWN: ask the cell (") + error.what() +
               ").";
    }
    return sentences;
}

}  // namespace

std::string left_open(const JournalJob& job) {
    if (!job.may_have_started()) return {};
    const std::string name = "the job " + to_text(job.job_id) + " (" + decode_ticket(job.ticket).value.file_name +
                             ") of an earlier dispatch";
    if (job.is_started) return "T" + name.substr(1) + " has STARTED, and its end is not known.";
    return "Whether " + name + " has started is UNKNOWN: ask the cell.";
}

std::string left_open(std::uint16_t cell_id, const std::string& endpoint) {
    std::vector<JournalCell> cells{journal_cell(cell_id, false, endpoint), journal_cell(cell_id, true, endpoint)};
    if (cell_id != any_cell_id) cells.push_back(journal_cell(any_cell_id, true, endpoint));
    std::string sentences;
    for (const JournalCell& cell : cells) {
        const std::string more = left_open(cell);
        if (!more.empty()) sentences += (sentences.empty() ? "" : " ") + more;
    }
    return sentences;
}

}  // namespace qchopper
