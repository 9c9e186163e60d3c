#include "app/console/worker/worker_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "app/store/project_folder.h"
#include "app/store/replay.h"
#include "tests/app/console/worked.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// The processes that hold a project.
std::vector<pid_t> workers_of(const fs::path& project) {
    std::vector<pid_t> found;
    std::error_code error;
    for (fs::directory_iterator entry("/proc", error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        std::ifstream file(entry->path() / "cmdline");
        std::ostringstream words;
        words << file.rdbuf();
        const bool is_worker = words.str().find("console-worker") != std::string::npos;
        if (is_worker && words.str().find(project.string()) != std::string::npos) found.push_back(std::stoi(name));
    }
    return found;
}

struct Workers : ::testing::Test {
    WorkerProcesses processes{[](const fs::path& folder) {
        return std::vector<std::string>{QCHOPPER_PROGRAM, "console-worker", folder.string(),
                                        "--json",         "--progress",     "json"};
    }};

    WorkerAnswer show(const WorkedProject& p) { return processes.ask(p.project, {WorkerTask::show, {}, {}}); }
    WorkerAnswer rank(const WorkedProject& p, const std::string& lane) {
        return processes.ask(p.project, {WorkerTask::ask, {}, R"({"rank":{"top":2}})"}, lane);
    }
    void signal(const WorkedProject& p, int number) const {
        const std::vector<pid_t> all = workers_of(p.project);
        ASSERT_EQ(all.size(), 1U);
        ::kill(all.front(), number);
    }
};

bool comes_true(const auto& condition, std::chrono::milliseconds limit = 20s) {
    const Clock::time_point until = Clock::now() + limit;
    while (!condition()) {
        if (Clock::now() > until) return false;
        std::this_thread::sleep_for(5ms);
    }
    return true;
}

TEST_F(Workers, TheNewestQuestionOfALaneIsAnsweredAndOlderOnesThatWaitAreNot) {
    const WorkedProject p;
    ASSERT_EQ(show(p).status, 200U);
    signal(p, SIGSTOP);
    std::vector<std::thread> threads;
    std::vector<std::atomic<unsigned>> status(5);
    const auto ask = [&](std::size_t i, const std::string& lane) {
        threads.emplace_back([&, i, lane] { status[i] = rank(p, lane).status; });
        std::this_thread::sleep_for(100ms);
    };
    ask(0, "rank-1");  // is being answered
    ask(1, "rank-1");
    ask(2, "rank-2");
    ask(3, "");
    ask(4, "rank-1");  // takes the place of 1
    EXPECT_TRUE(comes_true([&] { return status[1] == 409; }));
    EXPECT_EQ(status[4], 0U);
    signal(p, SIGCONT);
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(status[0], 200U);
    EXPECT_EQ(status[1], 409U);
    EXPECT_EQ(status[2], 200U) << "the lane of another window";
    EXPECT_EQ(status[3], 200U) << "of no lane";
    EXPECT_EQ(status[4], 200U);
}

TEST_F(Workers, OneThatIsKilledWhileNothingIsAskedIsStartedAgainUnseen) {
    const WorkedProject p;
    ASSERT_EQ(show(p).status, 200U);
    for (int i = 0; i < 3; ++i) {
        signal(p, SIGKILL);
        ASSERT_TRUE(comes_true([&] { return workers_of(p.project).empty(); }));
        EXPECT_EQ(show(p).status, 200U);
    }
}

TEST_F(Workers, ADecisionWhoseProcessIsKilledIsSaidAndNotMadeAgain) {
    const WorkedProject p;
    ASSERT_EQ(show(p).status, 200U);
    const std::string before = p.revision();
    signal(p, SIGSTOP);
    std::atomic<unsigned> status = 0;
    const std::string body = Json{{"weights", {{"fragility", 77}}}}.dump();
    std::thread asker([&] { status = processes.ask(p.project, {WorkerTask::decide, before, body}).status; });
    std::this_thread::sleep_for(200ms);
    signal(p, SIGKILL);
    asker.join();
    EXPECT_EQ(status, 500U);
    EXPECT_EQ(p.revision(), before);
    EXPECT_EQ(rank(p, "").status, 200U);
}

TEST_F(Workers, AQuestionWhoseProcessIsKilledIsAskedOfAnotherOne) {
    const WorkedProject p;
    ASSERT_EQ(show(p).status, 200U);
    signal(p, SIGSTOP);
    std::atomic<unsigned> status = 0;
    std::thread asker([&] { status = rank(p, "").status; });
    std::this_thread::sleep_for(200ms);
    signal(p, SIGKILL);
    asker.join();
    EXPECT_EQ(status, 200U);
}

TEST_F(Workers, AKillAtAnyMomentLeavesEachDecisionWholeOrNotAtAll) {
    const WorkedProject p;
    std::mt19937 random(7);
    int answered = 0;
    int lost = 0;
    for (int kills = 0; kills < kills_wanted(); ++kills) {
        ASSERT_EQ(show(p).status, 200U);
        const std::vector<pid_t> worker = workers_of(p.project);
        ASSERT_EQ(worker.size(), 1U);
        const auto wait = std::chrono::microseconds(random() % 60'000);
        std::thread killer([&] {
            std::this_thread::sleep_for(wait);
            ::kill(worker.front(), SIGKILL);
        });
        for (int i = 0; i < 4; ++i) {
            const std::string before = p.revision();
            const Project stood = load_project(p.project);
            const std::string undo = undo_text(stood.history);
            const bool cuts = stood.cuts.size() < 2 || random() % 2 == 0;
            const std::string body =
                undo.empty() || cuts
                    ? Json{{"weights", {{"fragility", 1 + static_cast<double>(random() % 100)}}}}.dump()
                    : Json{{"undo", undo}}.dump();
            const std::string cut =
                Json{{"cut", {{"plane", {0, 1, 0, static_cast<double>(random() % 40) - 20}}}}}.dump();
            const WorkerAnswer answer = processes.ask(
                p.project, {WorkerTask::decide, before, i % 2 == 0 && stood.cuts.size() < 3 ? cut : body});
            const Project now = load_project(p.project);  // is whole
            if (answer.status == 200) {
                ++answered;
                EXPECT_EQ(Json::parse(answer.document).at("revision"), p.revision());
            } else if (answer.status == 500) {
                ++lost;
                const std::size_t old = stood.history.committed;
                const std::size_t is = now.history.committed;
                EXPECT_TRUE(is == old || is + 1 == old || is == old + 1);
                if (is == old) {
                    EXPECT_EQ(p.revision(), before);
                }
            } else {
                EXPECT_EQ(answer.status, 409U) << answer.document;
                EXPECT_EQ(p.revision(), before);
            }
        }
        killer.join();
        ASSERT_TRUE(comes_true([&] {
            const std::vector<pid_t> left = workers_of(p.project);
            return std::ranges::find(left, worker.front()) == left.end();
        }));
    }
    EXPECT_GT(answered, 20);
    RecordProperty("lost", lost);
    EXPECT_EQ(show(p).status, 200U);
}

TEST_F(Workers, TwoAreHeldAndTheOneUsedLastStays) {
    const WorkedProject a;
    const WorkedProject b;
    const WorkedProject c;
    ASSERT_EQ(show(a).status, 200U);
    ASSERT_EQ(show(b).status, 200U);
    ASSERT_EQ(show(a).status, 200U);
    ASSERT_EQ(show(c).status, 200U);
    EXPECT_TRUE(comes_true([&] { return workers_of(b.project).empty(); }));
    EXPECT_EQ(workers_of(a.project).size(), 1U);
    EXPECT_EQ(workers_of(c.project).size(), 1U);
}

TEST_F(Workers, OneAtWorkIsNotEndedForAnotherProject) {
    const WorkedProject a;
    const WorkedProject b;
    const WorkedProject c;
    ASSERT_EQ(show(a).status, 200U);
    ASSERT_EQ(show(b).status, 200U);
    signal(a, SIGSTOP);
    signal(b, SIGSTOP);
    std::atomic<unsigned> status_a = 0;
    std::atomic<unsigned> status_b = 0;
    std::thread ask_a([&] { status_a = rank(a, "").status; });
    std::thread ask_b([&] { status_b = rank(b, "").status; });
    std::this_thread::sleep_for(200ms);
    EXPECT_EQ(show(c).status, 503U);
    EXPECT_TRUE(workers_of(c.project).empty());
    signal(a, SIGCONT);
    signal(b, SIGCONT);
    ask_a.join();
    ask_b.join();
    EXPECT_EQ(status_a, 200U);
    EXPECT_EQ(status_b, 200U);
    EXPECT_EQ(show(c).status, 200U);
}

TEST_F(Workers, WhoIsIdleIsEndedAndStartedAgainWhenAsked) {
    const WorkedProject p;
    ASSERT_EQ(show(p).status, 200U);
    processes.end_idle(1h);
    EXPECT_EQ(workers_of(p.project).size(), 1U);
    processes.end_idle(0s);
    EXPECT_TRUE(comes_true([&] { return workers_of(p.project).empty(); }));
    EXPECT_EQ(show(p).status, 200U);
}

TEST_F(Workers, ThoseThatEndWhenIdleLoseNoRequest) {
    const WorkedProject p;
    std::atomic<bool> is_over = false;
    std::thread ender([&] {
        while (!is_over) {
            processes.end_idle(0s);
            std::this_thread::sleep_for(3ms);
        }
    });
    for (int i = 0; i < 30; ++i) EXPECT_EQ(show(p).status, 200U);
    is_over = true;
    ender.join();
}

TEST_F(Workers, AnEndEndsAllAndAnswersWhoWaits) {
    const WorkedProject p;
    ASSERT_EQ(show(p).status, 200U);
    signal(p, SIGSTOP);
    std::vector<std::thread> threads;
    std::vector<std::atomic<unsigned>> status(4);
    for (std::size_t i = 0; i < status.size(); ++i) threads.emplace_back([&, i] { status[i] = rank(p, "").status; });
    std::this_thread::sleep_for(200ms);
    const Clock::time_point begin = Clock::now();
    processes.end();
    for (std::thread& thread : threads) thread.join();
    EXPECT_LT(Clock::now() - begin, 2s);
    for (const auto& one : status) EXPECT_TRUE(one == 500 || one == 503) << one;
    EXPECT_TRUE(comes_true([&] { return workers_of(p.project).empty(); }));
    EXPECT_EQ(show(p).status, 503U);
}

TEST(WorkerProcesses, AProgramThatIsNotThereIsSaid) {
    for (const std::string& program : {std::string("/no/such/program"), std::string("false"), std::string("true")}) {
        WorkerProcesses none([&](const fs::path&) { return std::vector<std::string>{program}; });
        EXPECT_EQ(none.ask("/tmp", {}).status, 500U) << program;
    }
}

}  // namespace
}  // namespace qchopper
