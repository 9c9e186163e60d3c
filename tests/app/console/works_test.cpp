#include "app/console/works.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "tests/folder.h"

namespace qchopper {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

WorkOrder shell(const std::string& script, const std::string& of = "p") {
    return {WorkKind::prepare, of, {"sh", "-c", script}};
}

// A program that does not look at SIGTERM.
constexpr const char* deaf = "trap '' TERM; while :; do sleep 0.05; done";

bool comes_true(const auto& condition, std::chrono::milliseconds limit = 20s) {
    const Clock::time_point until = Clock::now() + limit;
    while (!condition()) {
        if (Clock::now() > until) return false;
        std::this_thread::sleep_for(5ms);
    }
    return true;
}

struct WorksTest : ::testing::Test {
    std::atomic<int> told = 0;
    Works works{[this](const Work&) { ++told; }};

    std::string begin(const std::string& script) {
        const std::optional<std::string> id = works.begin(shell(script));
        EXPECT_TRUE(id);
        return id.value_or("");
    }
    WorkState state(const std::string& id) const { return works.find(id)->state; }
    Work end_of(const std::string& id) const {
        EXPECT_TRUE(comes_true([&] { return is_over(state(id)); }));
        return *works.find(id);
    }
};

TEST_F(WorksTest, WhatACommandPrintsIsItsResult) {
    const Work done = end_of(begin("echo '{\"a\":1}'"));
    EXPECT_EQ(done.state, WorkState::done);
    EXPECT_EQ(done.result.text, "{\"a\":1}\n");
    EXPECT_EQ(end_of(begin("echo '{\"a\":1}'; exit 1")).state, WorkState::done) << "a demand that is not met";
}

TEST_F(WorksTest, AnErrorIsItsDocument) {
    const Work failed = end_of(begin("echo '{\"error\":\"no\"}'; exit 2"));
    EXPECT_EQ(failed.state, WorkState::failed);
    EXPECT_EQ(failed.error.text, "{\"error\":\"no\"}\n");
    EXPECT_EQ(failed.result.text, "");
}

TEST_F(WorksTest, WhoEndsWithoutAnAnswerIsLost) {
    for (const char* script : {"kill -9 $$", "exit 0", "echo no json", "echo '{\"a\":'", "exit 3", "kill -SEGV $$",
                               "echo '{}'; echo '{}'"}) {
        const Work lost = end_of(begin(script));
        EXPECT_EQ(lost.state, WorkState::lost) << script;
        EXPECT_FALSE(lost.error.text.empty());
    }
    EXPECT_EQ(end_of(*works.begin({WorkKind::guide, "p", {"/no/such/program"}})).state, WorkState::lost);
}

TEST_F(WorksTest, AResultThatCannotBeMadeIsAFailureAndNoCrash) {
    WorkOrder order = shell("echo '{}'");
    order.result = [](const JsonText&) -> JsonText { throw std::runtime_error("the disk is full"); };
    const Work failed = end_of(*works.begin(order));
    EXPECT_EQ(failed.state, WorkState::failed);
    EXPECT_NE(failed.error.text.find("the disk is full"), std::string::npos);
    EXPECT_EQ(end_of(begin("echo '{}'")).state, WorkState::done);
}

TEST_F(WorksTest, ProgressAndMessagesAreSeen) {
    const std::string id = begin(
        "echo '{\"progress\":\"planes\",\"done\":3,\"total\":9,\"elapsed_s\":1,\"left_s\":2}' >&2;"
        "for i in $(seq 1 30); do echo \"{\\\"message\\\":\\\"line $i\\\"}\" >&2; done; echo no json >&2;"
        "echo '{\"progress\":5,\"done\":7,\"total\":-1}' >&2; echo '[1]' >&2; echo '{\"warning\":7}' >&2;"
        "while [ ! -e /nowhere ]; do sleep 0.05; done");
    EXPECT_TRUE(comes_true([&] { return works.find(id)->messages.size() == 20; }));
    const Work work = *works.find(id);
    EXPECT_EQ(work.what, "planes");
    EXPECT_EQ(work.done, 3U);
    EXPECT_EQ(work.total, 9U);
    EXPECT_EQ(work.remaining_s, 2);
    EXPECT_EQ(work.messages.back(), "line 30");
    std::this_thread::sleep_for(200ms);
    EXPECT_EQ(state(id), WorkState::running) << "a line that is wrong ends nothing";
    EXPECT_TRUE(works.stop(id));
    EXPECT_EQ(end_of(id).state, WorkState::stopped);
}

TEST_F(WorksTest, OneRunsAtATimeInTheirOrder) {
    const Folder folder;
    const std::string log = (folder.path / "log").string();
    std::vector<std::string> ids;
    for (int i = 0; i < 5; ++i) {
        const std::string n = std::to_string(i);
        ids.push_back(begin("echo b" + n + " >> " + log + "; sleep 0.05; echo e" + n + " >> " + log + "; echo '{}'"));
    }
    for (const std::string& id : ids) EXPECT_EQ(end_of(id).state, WorkState::done);
    WorkOrder read = shell("printf '\"'; tr '\\n' ' ' < " + log + "; printf '\"'");
    EXPECT_EQ(end_of(*works.begin(read)).result.text, "\"b0 e0 b1 e1 b2 e2 b3 e3 b4 e4 \"\n");
    EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), 5U);
}

TEST_F(WorksTest, AStopIsAnsweredByTheCommand) {
    const std::string id = begin("trap 'echo \"{}\"; exit 143' TERM; while :; do sleep 0.05; done");
    EXPECT_TRUE(comes_true([&] { return state(id) == WorkState::running; }));
    std::this_thread::sleep_for(200ms);
    const Clock::time_point begun = Clock::now();
    EXPECT_TRUE(works.stop(id));
    EXPECT_EQ(state(id), WorkState::stopping);
    EXPECT_EQ(end_of(id).state, WorkState::stopped);
    EXPECT_LT(Clock::now() - begun, 1500ms);
    EXPECT_TRUE(works.stop(id)) << "again";
    EXPECT_EQ(state(id), WorkState::stopped);
    EXPECT_FALSE(works.stop("W99"));
    EXPECT_FALSE(works.stop(""));
}

TEST_F(WorksTest, WhoDoesNotAnswerAStopIsKilledWithinTwoAndAHalfSeconds) {
    const std::string id = begin(deaf);
    std::this_thread::sleep_for(300ms);
    const Clock::time_point begun = Clock::now();
    EXPECT_TRUE(works.stop(id));
    EXPECT_EQ(end_of(id).state, WorkState::stopped);
    EXPECT_LT(Clock::now() - begun, 2500ms);
    EXPECT_GE(Clock::now() - begun, 1900ms) << "it had its time to save";
}

TEST_F(WorksTest, WhoWaitsIsStoppedAtOnceAndNeverRuns) {
    const Folder folder;
    const std::string first = begin("while :; do sleep 0.05; done");
    const std::string second = begin("touch " + (folder.path / "ran").string() + "; echo '{}'");
    EXPECT_EQ(state(second), WorkState::queued);
    EXPECT_TRUE(works.stop(second));
    EXPECT_EQ(state(second), WorkState::stopped);
    EXPECT_TRUE(works.stop(first));
    end_of(first);
    std::this_thread::sleep_for(100ms);
    EXPECT_FALSE(std::filesystem::exists(folder.path / "ran"));
}

TEST_F(WorksTest, EightWaitAndTheNextIsRefused) {
    const std::string first = begin("while :; do sleep 0.05; done");
    EXPECT_TRUE(comes_true([&] { return state(first) == WorkState::running; }));
    for (int i = 0; i < 8; ++i) EXPECT_TRUE(works.begin(shell("echo '{}'", "q" + std::to_string(i)))) << i;
    EXPECT_FALSE(works.begin(shell("echo '{}'")));
    EXPECT_TRUE(works.is_busy("p"));
    EXPECT_TRUE(works.is_busy("q7"));
    EXPECT_FALSE(works.is_busy("q8"));
    EXPECT_TRUE(works.stop(first));
    EXPECT_TRUE(comes_true([&] { return !works.is_busy("q7"); }));
    EXPECT_FALSE(works.is_busy("p"));
}

TEST_F(WorksTest, ThirtyTwoThatAreOverAreKept) {
    std::string last;
    for (int i = 0; i < 40; ++i) {
        last = begin("echo '{}'");
        end_of(last);
    }
    EXPECT_LE(works.all().size(), 33U);
    EXPECT_GE(works.all().size(), 32U);
    EXPECT_EQ(works.all().front().id, last);
    EXPECT_FALSE(works.find("W1"));
}

TEST(Works, ItsEndStopsWhatRunsWithinTwoSeconds) {
    for (const char* script : {deaf, "while :; do sleep 0.05; done"}) {
        auto works = std::make_unique<Works>([](const Work&) {});
        ASSERT_TRUE(works->begin(shell(script)));
        ASSERT_TRUE(works->begin(shell(script)));
        std::this_thread::sleep_for(300ms);
        const Clock::time_point begun = Clock::now();
        works.reset();
        EXPECT_LT(Clock::now() - begun, 1700ms);
    }
}

TEST(Works, AProcessThatLeavesItsOutputsToAnotherIsNotWaitedForWithoutEnd) {
    Works works([](const Work&) {});
    const std::string id = *works.begin(shell("trap '' TERM; sleep 30 & while :; do sleep 0.05; done"));
    std::this_thread::sleep_for(300ms);
    const Clock::time_point begun = Clock::now();
    works.stop(id);
    EXPECT_TRUE(comes_true([&] { return is_over(works.find(id)->state); }));
    EXPECT_LT(Clock::now() - begun, 4s);
}

}  // namespace
}  // namespace qchopper
