// The processes that hand jobs over are scripts of the shell here, whose arguments name the job as those of dispatch
// do.

#include "app/console/cells/dispatch_queue.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "app/dispatch/dispatch_project.h"
#include "base/error.h"
#include "base/files/temporary_folder.h"
#include "devices/journal/job_outcome.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// What dispatch prints of one job.
std::string printed(const char* start, bool is_complete, const std::string& why) {
    return std::string("{\"progress\":\"% of the job\",\"done\":2,\"total\":100,\"elapsed_s\":1.0,\"left_s\":null}\n") +
           "{\n \"schema\": \"qchopper-dispatch-2\",\n \"jobs\": [\n  {\n   \"start_outcome\": \"" + start +
           "\",\n   \"ended_complete\": " + (is_complete ? "true" : "false") + ",\n   \"why\": \"" + why +
           "\"\n  }\n ]\n}\n{\"message\":\"a line after it\"}\n";
}

std::string printed_error(const std::string& unchanged) {
    return "{\n \"schema\": \"qchopper-error-1\",\n \"error\": \"no drop folder\",\n \"unchanged\": \"" + unchanged +
           "\"\n}\n";
}

QueueEntry entry(const std::string& id, const std::string& output, const std::string& before = "") {
    QueueEntry made;
    made.id = id;
    made.piece = id;
    made.job = "job-of-" + id;
    made.words = {"sh", "-c", before + "printf '%s' \"$0\"", output, made.job};
    return made;
}

struct Queue : ::testing::Test {
    TemporaryFolder folder{"queue"};
    CellView cell;

    std::unique_ptr<DispatchQueue> queue() {
        cell.link = CellLinkState::connected;
        return std::make_unique<DispatchQueue>(
            folder.path(), [this](const QueueEntry&) { return cell; }, [] {});
    }
    static std::vector<EntryState> states(const DispatchQueue& queue) {
        std::vector<EntryState> all;
        for (const QueueEntry& e : queue.all()) all.push_back(e.state);
        return all;
    }
    static bool comes_to(const DispatchQueue& queue, const std::vector<EntryState>& wanted) {
        const Clock::time_point until = Clock::now() + 20s;
        while (states(queue) != wanted && Clock::now() < until) std::this_thread::sleep_for(20ms);
        return states(queue) == wanted;
    }
};

TEST(EntryStates, FollowWhatTheCellSays) {
    CellView cell;
    EXPECT_EQ(state_while_sent(cell), EntryState::sending);
    cell.job_state = JobState::running;
    EXPECT_EQ(state_while_sent(cell), EntryState::carving);
    for (const PackState held : {PackState::held, PackState::holding, PackState::suspended}) {
        cell.state = held;
        EXPECT_EQ(state_while_sent(cell), EntryState::held);
    }
    cell.asks = true;
    EXPECT_EQ(state_while_sent(cell), EntryState::asks);
}

TEST(EntryStates, AnEndIsToldByTheLastDocument) {
    const QueueEntry sent;
    const auto end = [&](const std::string& output) { return ended_by(sent, output); };
    EXPECT_EQ(end(printed(describe(StartOutcome::started), true, "")).state, EntryState::ended);
    EXPECT_EQ(end(printed(describe(StartOutcome::started), true, "")).why, "complete");
    EXPECT_EQ(end(printed(describe(StartOutcome::started), false, "stopped")).state, EntryState::ended);
    EXPECT_EQ(end(printed(describe(StartOutcome::started), false, "stopped")).why, "stopped");
    EXPECT_EQ(end(printed(describe(StartOutcome::not_started), false, "no consent")).state, EntryState::not_started);
    EXPECT_EQ(end(printed(describe(StartOutcome::unknown), false, "")).state, EntryState::unknown);
    EXPECT_EQ(end("{\n \"refused\": [\"too little is proven\"],\n \"jobs\": []\n}\n").state, EntryState::not_started);
    EXPECT_EQ(end(printed_error(nothing_started)).state, EntryState::not_started);
    EXPECT_EQ(end(printed_error("What became of it is UNKNOWN.")).state, EntryState::unknown);
    for (const char* output : {"", "{", "{\n", "{\n \"jobs\": 3\n}\n", "{\n \"jobs\": [3]\n}\n", "killed\n"}) {
        EXPECT_EQ(end(output).state, EntryState::unknown) << output;
    }
}

TEST_F(Queue, TheNextJobBeginsAfterOneThatEndedComplete) {
    const auto q = queue();
    q->add({entry("A", printed("STARTED", true, "")), entry("B", printed("STARTED", true, ""))});
    EXPECT_TRUE(comes_to(*q, {EntryState::ended, EntryState::ended}));
    EXPECT_FALSE(q->is_paused());
}

TEST_F(Queue, AfterAnyOtherEndAPersonDecides) {
    const auto q = queue();
    q->add({entry("A", printed("STARTED", false, "stopped")), entry("B", printed("STARTED", true, ""))});
    EXPECT_TRUE(comes_to(*q, {EntryState::ended, EntryState::waiting}));
    std::this_thread::sleep_for(1s);
    EXPECT_EQ(states(*q).back(), EntryState::waiting);
    EXPECT_TRUE(q->is_paused());
    q->go_on();
    EXPECT_TRUE(comes_to(*q, {EntryState::ended, EntryState::ended}));
}

TEST_F(Queue, AProcessThatIsKilledLeavesUnknown) {
    const auto q = queue();
    q->add({entry("A", "", "kill -9 $$; "), entry("B", "")});
    EXPECT_TRUE(comes_to(*q, {EntryState::unknown, EntryState::waiting}));
}

TEST_F(Queue, WhatWaitsCanBeRemovedAndPaused) {
    const auto q = queue();
    q->pause();
    q->add({entry("A", printed("STARTED", true, ""))});
    std::this_thread::sleep_for(600ms);
    EXPECT_EQ(states(*q), std::vector{EntryState::waiting});
    EXPECT_TRUE(q->remove("A"));
    EXPECT_FALSE(q->remove("A"));
    EXPECT_FALSE(q->remove("B"));
    q->go_on();
    std::this_thread::sleep_for(600ms);
    EXPECT_EQ(states(*q), std::vector{EntryState::removed});
}

TEST_F(Queue, ANewQueueFollowsWhatRunsAndBeginsNothing) {
    const fs::path go = folder.path() / "go";
    const std::string until_told = "while [ ! -e '" + go.string() + "' ]; do sleep 0.05; done; ";
    {
        const auto q = queue();
        q->add({entry("A", printed("STARTED", true, ""), until_told), entry("B", printed("STARTED", true, ""))});
        EXPECT_TRUE(comes_to(*q, {EntryState::sending, EntryState::waiting}));
    }
    cell.job_state = JobState::running;
    const auto q = queue();
    EXPECT_TRUE(comes_to(*q, {EntryState::carving, EntryState::not_handed_over}));
    std::ofstream(go) << "now";
    EXPECT_TRUE(comes_to(*q, {EntryState::ended, EntryState::not_handed_over}));
}

TEST_F(Queue, WhatEndedWhileNobodyFollowedIsReadFromItsOutput) {
    {
        const auto q = queue();
        q->add({entry("A", printed("STARTED", true, ""), "sleep 0.6; ")});
        EXPECT_TRUE(comes_to(*q, {EntryState::sending}));
    }
    std::this_thread::sleep_for(1500ms);
    const auto q = queue();
    EXPECT_TRUE(comes_to(*q, {EntryState::ended}));
    EXPECT_EQ(q->all().front().why, "complete");
}

TEST_F(Queue, AnotherServerOfTheFolderIsRefusedWithWhoHoldsIt) {
    auto q = queue();
    q->pause();
    q->add({entry("A", printed("STARTED", true, ""))});
    try {
        const auto second = queue();
        ADD_FAILURE() << "two servers hand over";
    } catch (const InputError& e) {
        EXPECT_EQ(e.fault, InputFault::busy);
        EXPECT_NE(std::string(e.what()).find("process " + std::to_string(::getpid())), std::string::npos) << e.what();
    }
    EXPECT_EQ(states(*q), std::vector{EntryState::waiting}) << "nothing was taken from it";
    q.reset();
    EXPECT_EQ(states(*queue()), std::vector{EntryState::not_handed_over});
}

TEST_F(Queue, OtherFilesOfItsFolderAreLeftAlone) {
    std::ofstream(folder.path() / "notes.json") << "[1, 2]";
    const auto q = queue();
    EXPECT_TRUE(q->all().empty());
    EXPECT_TRUE(fs::exists(folder.path() / "notes.json"));
}

}  // namespace
}  // namespace qchopper
