// Events as text and back.

#include "devices/journal/journal_event.h"

#include <gtest/gtest.h>

#include <set>

namespace qchopper {
namespace {

JournalEvent full_event() {
    JournalEvent event;
    event.job_id = {1, 2, 3};
    event.file_sha256.bytes.fill(0xAB);
    event.ticket = {1, 0xFFFF, 0};
    event.epoch = 4;
    event.seq = 0xFFFFFFFF;
    event.owner = 6;
    event.secret = 7;
    event.command = CellCommand::prepare;
    event.token = 8;
    event.receipt = 9;
    event.progress = 10000;
    event.refusal = AckResult::no_consent;
    event.job_state = JobState::ended;
    event.job_result = JobResult::complete;
    event.starts = 1;
    event.start_outcome = StartOutcome::unknown;
    event.store = {{9, 9}, 0x0101, 11, 12, 13};
    event.created_ms = 0xFFFFFFFFFFFFFFFF;
    event.started_ms = 1795824000000;
    event.marks = 0xFFFF;
    event.rows = 14;
    return event;
}

TEST(JournalEvent, EveryKindComesBackFromItsText) {
    std::set<std::string> names;
    for (std::size_t kind = 0; kind < journal_kinds; ++kind) {
        JournalEvent event = full_event();
        event.kind = static_cast<JournalKind>(kind);
        const std::string text = text_of(event);
        EXPECT_FALSE(text.empty());
        names.insert(name(event.kind));
        ASSERT_EQ(journal_kind_from(name(event.kind)), event.kind);
        const std::optional<JournalEvent> back = event_from(event.kind, text);
        ASSERT_TRUE(back.has_value()) << text;
        EXPECT_EQ(text_of(*back), text);
        EXPECT_FALSE(describe(event).empty());
    }
    EXPECT_EQ(names.size(), journal_kinds);
    EXPECT_FALSE(journal_kind_from("START").has_value());
}

TEST(JournalEvent, ARowHoldsWhatItsKindLists) {
    JournalEvent event = full_event();
    event.kind = JournalKind::start_intent;
    EXPECT_EQ(text_of(event), "job=01020300000000000000000000000000 epoch=4 seq=4294967295 owner=6 token=8");
    event.kind = JournalKind::closed;
    EXPECT_EQ(text_of(event), "job=01020300000000000000000000000000 verdict=2");
    event.kind = JournalKind::head;
    event.file_sha256 = {};
    EXPECT_EQ(text_of(event),
              "rows=14 hash=" + std::string(64, '0') + " epoch=4 seq=4294967295 owner=6 secret=7 grant=0 marks=65535");
    event.kind = JournalKind::exported;
    EXPECT_TRUE(text_of(event).ends_with("created=18446744073709551615 started=1795824000000 ended=0"));
    JournalEvent ticket = full_event();
    ticket.kind = JournalKind::created;
    EXPECT_EQ(event_from(JournalKind::created, text_of(ticket))->ticket, ticket.ticket);
}

TEST(JournalEvent, AnyOtherTextIsRefused) {
    const std::string job = "job=01020300000000000000000000000000";
    for (const std::string& text : std::vector<std::string>{
             std::string(), job, job + " verdict=3", job + " verdict=02", job + " verdict=+1", job + " verdict=1 ",
             job + "  verdict=1", job + " verdict=1 more=2", "verdict=1 " + job, job + " verdict=-1", job + " verdict=",
             "job=0102030000000000000000000000000g verdict=1", "job=01 verdict=1", job + " verdict=4294967296"}) {
        EXPECT_FALSE(event_from(JournalKind::closed, text).has_value()) << text;
    }
    EXPECT_TRUE(event_from(JournalKind::closed, job + " verdict=1").has_value());
}

}  // namespace
}  // namespace qchopper
