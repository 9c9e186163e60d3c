// Reads three journals for each address of the cell; O(rows).

#include "app/dispatch/left_open.h"

#include <algorithm>

#include "app/dispatch/state_folder.h"
#include "base/error.h"
#include "base/printable.h"
#include "devices/wire/codec.h"
#include "devices/wire/modbus_tcp.h"

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

// The real cell, and the simulated ones, of this id or without one of their own, at each address of the name.
std::vector<JournalCell> cells_at(std::uint16_t cell_id, const std::string& endpoint) {
    std::vector<JournalCell> cells{{cell_id, false, {}}};
    const auto add = [&](const JournalCell& cell) {
        if (std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
    };
    try {
        for (const std::string& address : numeric_addresses(parse_tcp_address(endpoint))) {
            add(journal_cell(cell_id, true, address));
            add(journal_cell(any_cell_id, true, address));
        }
    } catch (const InputError&) {
        // Without a state folder there are no journals; reading that of the real cell finds it too.
    }
    return cells;
}

}  // namespace

std::string left_open(const JournalJob& job) {
    if (!job.may_have_started()) return {};
    const std::string name = "the job " + to_text(job.job_id) + " (" +
                             printable(decode<WireTicket>(job.ticket).value.file_name) + ") of an earlier dispatch";
    if (job.is_started) {
        return "T" + name.substr(1) + " has STARTED, and its end is not known: the cell may still be cutting foam.";
    }
    if (job.is_settled) return "Whether " + name + " has started is UNKNOWN, and the cell no longer knows it.";
    return "Whether " + name + " has started is UNKNOWN: ask the cell, which may be cutting foam.";
}

std::string left_open(std::uint16_t cell_id, const std::string& endpoint) {
    std::string sentences;
    for (const JournalCell& cell : cells_at(cell_id, endpoint)) {
        const std::string more = left_open(cell);
        if (!more.empty()) sentences += (sentences.empty() ? "" : " ") + more;
    }
    return sentences;
}

}  // namespace qchopper
