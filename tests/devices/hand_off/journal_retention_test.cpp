// What stays of a journal whose first rows were exported: the same to the next dispatcher.

#include "devices/hand_off/journal_retention.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "devices/wire/codec.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using Is = JournalKind;

const JournalCell cell_7{7, false, {}};
constexpr Uuid a{1};
constexpr Uuid b{2};
constexpr Uuid c{3};
constexpr std::uint64_t always = ~std::uint64_t{0};

struct Written {
    Journal& journal;
    void add(Is kind, const Uuid& job = {}) {
        JournalEvent event;
        event.kind = kind;
        event.job_id = job;
        append(event);
    }
    void append(const JournalEvent& event) { journal.append(event); }

    // A job from its creation to `end`: "complete", "not started" or "open".
    void job(const Uuid& id, std::uint32_t epoch, const std::string& end) {
        JournalEvent event;
        event.job_id = id;
        event.file_sha256.bytes[0] = id[0];
        event.ticket = encode(WireTicket{});
        append(event);
        event.kind = Is::identity;
        event.store = {{9}, 0x0101, 4, epoch - 1, 2};
        append(event);
        event.kind = Is::claim;
        event.epoch = epoch;
        event.owner = 5;
        event.secret = 6;
        event.seq = 10 * epoch;
        append(event);
        event.kind = Is::granted;
        event.grant = 100 + epoch;
        append(event);
        if (end == "not started") {
            event.start_outcome = StartOutcome::not_started;
        } else {
            event.kind = Is::start_intent;
            append(event);
            event.kind = Is::started;
            append(event);
            if (end == "open") return;
            event.kind = Is::result;
            event.job_state = JobState::ended;
            event.job_result = JobResult::complete;
            append(event);
            event.start_outcome = StartOutcome::started;
        }
        event.kind = Is::command;
        event.command = CellCommand::release;
        append(event);
        event.kind = Is::closed;
        append(event);
    }
};

// Exports to `out` what can be.
JournalExport exported(Journal& journal, const fs::path& out, std::uint64_t before_ms = always) {
    JournalExport plan = plan_export(journal.content(), before_ms);
    if (plan.head.number == 0) return plan;
    write_exported(out, journal.content(), plan.head.number);
    journal.remove_exported(plan.head, plan.events);
    return plan;
}

TEST(JournalRetention, WhatIsLeftSaysTheSameAndTheChainGoesOnFromTheExportedRows) {
    const Folder folder;
    {
        Journal journal(folder.path / "cell", cell_7);
        Written written{journal};
        written.job(a, 1, "complete");
        written.job(b, 2, "not started");
        written.job(c, 3, "complete");
        const JournalHistory before = history_of(journal.content().rows);
        const JournalExport plan = exported(journal, folder.path / "out");
        EXPECT_EQ(plan.jobs, 3U);
        EXPECT_EQ(plan.why_not_more, "");
        const JournalHistory after = history_of(journal.content().rows);
        EXPECT_EQ(static_cast<const CellPast&>(after), before);
        ASSERT_EQ(after.jobs.size(), 2U);  // the one that was not started left nothing
        Sha256 file;
        file.bytes[0] = 1;
        ASSERT_NE(after.last_start_of(file), nullptr);  // so it is carved again only by --again
        EXPECT_TRUE(after.last_start_of(file)->is_complete());
        EXPECT_EQ(after.jobs[1].started_ms, before.jobs[2].started_ms);
        EXPECT_EQ(read_journal(folder.path / "out").hash, plan.head.hash);
        EXPECT_EQ(history_of(read_journal(folder.path / "out").rows).jobs, before.jobs);
    }
    // The next dispatcher writes on, and another reads.
    Journal again(folder.path / "cell", cell_7);
    Written{again}.job({4}, 4, "complete");
    const JournalContent read = read_journal(folder.path / "cell");
    EXPECT_EQ(read.hash, again.content().hash);
    EXPECT_EQ(read.rows.front().number, read.head.number + 1);
    EXPECT_EQ(history_of(read.rows).jobs.size(), 3U);
    // And once more: the second export begins where the first one ended.
    const JournalExport second = exported(again, folder.path / "out2");
    EXPECT_EQ(second.jobs, 1U);
    const JournalContent archive = read_journal(folder.path / "out2");
    EXPECT_EQ(archive.rows.front().number, read.head.number + 1);
    EXPECT_EQ(archive.head, read.head);
    EXPECT_EQ(history_of(read_journal(folder.path / "cell").rows).jobs.size(), 3U);
}

TEST(JournalRetention, AnOpenJobIsNeverRemovedNorWhatComesAfterIt) {
    const Folder folder;
    Journal journal(folder.path / "cell", cell_7);
    Written written{journal};
    written.job(a, 1, "complete");
    written.job(b, 2, "open");
    written.job(c, 3, "complete");
    const JournalHistory before = history_of(journal.content().rows);
    const JournalExport plan = exported(journal, folder.path / "out");
    EXPECT_EQ(plan.jobs, 1U);
    EXPECT_NE(plan.why_not_more.find("is open"), std::string::npos) << plan.why_not_more;
    const JournalHistory after = history_of(journal.content().rows);
    ASSERT_EQ(after.jobs.size(), 3U);
    EXPECT_EQ(after.jobs[1], before.jobs[1]);
    EXPECT_TRUE(after.jobs[1].is_open());
    EXPECT_EQ(plan_export(journal.content(), always).head.number, 0);
}

TEST(JournalRetention, JobsThatAreNotOldEnoughStay) {
    const Folder folder;
    Journal journal(folder.path / "cell", cell_7);
    Written{journal}.job(a, 1, "complete");
    const JournalExport plan = plan_export(journal.content(), journal.content().rows.back().unix_ms);
    EXPECT_EQ(plan.head.number, 0);
    EXPECT_NE(plan.why_not_more.find("not older"), std::string::npos) << plan.why_not_more;
}

TEST(JournalRetention, AnExportNeverWritesOverAFolder) {
    const Folder folder;
    Journal journal(folder.path / "cell", cell_7);
    Written{journal}.job(a, 1, "complete");
    fs::create_directory(folder.path / "out");
    try {
        exported(journal, folder.path / "out");
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::create);
    }
    EXPECT_EQ(read_journal(folder.path / "cell").head.number, 0);
}

TEST(JournalRetention, RowsThatAreMissingWithoutAnExportAreStillFound) {
    const Folder folder;
    Journal journal(folder.path / "cell", cell_7);
    Written written{journal};
    written.job(a, 1, "complete");
    const JournalExport plan = exported(journal, folder.path / "out");
    JournalHead other = plan.head;
    ++other.number;
    // A head of which no row tells.
    std::vector<JournalEvent> events = plan.events;
    std::erase_if(events, [](const JournalEvent& event) { return event.kind == Is::head; });
    other.hash = journal.content().rows.front().hash;
    journal.remove_exported(other, events);
    try {
        read_journal(folder.path / "cell");
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::config);
        EXPECT_NE(std::string(error.what()).find("no row says"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace qchopper
