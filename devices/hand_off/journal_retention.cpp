// Places where no job has rows on both sides, from the last one down, until one is found after which history_of() says
// the same as before. O(rows) for each.

#include "devices/hand_off/journal_retention.h"

#include <algorithm>
#include <map>

#include "base/text.h"
#include "devices/wire/registers.h"

namespace qchopper {
namespace {

// What takes the place of the removed rows: the head, the memory that the cell showed last, the jobs.
std::vector<JournalEvent> events_for(const JournalHistory& history, const std::vector<const JournalJob*>& removed,
                                     const JournalHead& head) {
    std::vector<JournalEvent> events;
    if (history.store) {
        JournalEvent store;
        store.kind = JournalKind::identity;
        store.store = *history.store;
        events.push_back(store);
    }
    events.push_back(head_event(history, head));
    for (const JournalJob* job : removed) {
        if (job->may_have_started()) events.push_back(exported_event(*job));
    }
    return events;
}

bool is_same_to_a_dispatcher(const JournalHistory& before, const JournalHistory& after,
                             const std::vector<const JournalJob*>& removed) {
    if (static_cast<const CellPast&>(before) != after || before.lease_may_live != after.lease_may_live) return false;
    std::size_t at = 0;
    for (const JournalJob& job : before.jobs) {
        const bool is_removed = std::ranges::find(removed, &job) != removed.end();
        if (is_removed && !job.may_have_started()) continue;
        if (at == after.jobs.size()) return false;
        JournalJob wanted = job;
        wanted.is_exported = is_removed;
        if (is_removed) wanted.start_boots = 0;  // asked for only while its START is open
        if (after.jobs[at++] != wanted) return false;
    }
    return at == after.jobs.size();
}

struct JobRows {
    std::int64_t first = 0;
    std::int64_t last = 0;
    std::uint64_t last_ms = 0;
};

using Extents = std::map<Uuid, JobRows>;

// Rows without a job belong to none.
Extents extents_of(const JournalContent& content) {
    Extents extents;
    for (const JournalRow& row : content.rows) {
        const Uuid& id = row.event.job_id;
        if (id == Uuid{} || row.event.kind == JournalKind::exported) continue;
        JobRows& extent = extents[id];
        if (extent.first == 0) extent.first = row.number;
        extent.last = row.number;
        extent.last_ms = row.unix_ms;
    }
    return extents;
}

// An archive begins where the one before ended, and holds the row that says so.
std::int64_t lowest_place(const JournalContent& content) {
    for (auto row = content.rows.rbegin(); row != content.rows.rend(); ++row) {
        if (row->event.kind == JournalKind::head) return row->number;
    }
    return 0;
}

std::string why_stays(const JournalJob& job, const JobRows& extent, std::uint64_t before_ms) {
    const std::string which = "job " + to_text(job.job_id).substr(0, 8) + " of " + utc_text(job.created_ms);
    if (job.is_open()) return which + " is open: its rows, from " + std::to_string(extent.first) + " on, stay";
    return which + " has rows that are not older than " + utc_text(before_ms) + ": from row " +
           std::to_string(extent.first) + " on they stay";
}

std::string hash_at(const JournalContent& content, std::int64_t number) {
    for (const JournalRow& row : content.rows) {
        if (row.number == number) return row.hash;
    }
    return {};
}

}  // namespace

JournalExport plan_export(const JournalContent& content, std::uint64_t before_ms) {
    const JournalHistory history = history_of(content.rows);
    const Extents extents = extents_of(content);
    JournalExport plan;
    std::int64_t end = content.last_number();  // the rows after it stay
    for (const JournalJob& job : history.jobs) {
        if (job.is_exported) continue;
        const JobRows& extent = extents.at(job.job_id);
        if ((!job.is_open() && extent.last_ms < before_ms) || extent.first > end) continue;
        end = extent.first - 1;
        plan.why_not_more = why_stays(job, extent, before_ms);
    }
    for (std::int64_t place = end; place > lowest_place(content); --place) {
        const bool is_whole = std::ranges::none_of(
            extents, [&](const auto& one) { return one.second.first <= place && one.second.last > place; });
        const bool ends_a_job = std::ranges::any_of(extents, [&](const auto& one) { return one.second.last == place; });
        if (!is_whole || !ends_a_job) continue;
        std::vector<const JournalJob*> removed;
        for (const JournalJob& job : history.jobs) {
            if (job.is_exported || extents.at(job.job_id).last <= place) removed.push_back(&job);
        }
        const JournalHead head{place, hash_at(content, place)};
        const std::vector<JournalEvent> events = events_for(history, removed, head);
        std::vector<JournalRow> rows;
        for (const JournalRow& row : content.rows) {
            if (row.number > place) rows.push_back(row);
        }
        for (const JournalEvent& event : events) rows.push_back({0, 0, event, {}});
        if (!is_same_to_a_dispatcher(history, history_of(rows), removed)) continue;
        plan.head = head;
        plan.events = events;
        plan.jobs = static_cast<std::size_t>(
            std::ranges::count_if(removed, [](const JournalJob* job) { return !job->is_exported; }));
        return plan;
    }
    return plan;
}

}  // namespace qchopper
