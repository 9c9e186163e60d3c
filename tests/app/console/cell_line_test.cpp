#include "app/console/cells/cell_line.h"

#include <gtest/gtest.h>

#include <future>

#include "base/files/temporary_folder.h"
#include "devices/wire/program_block.h"
#include "sim/cell/cell_sim.h"

namespace qchopper {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

bool comes_true(const auto& condition) {
    const Clock::time_point until = Clock::now() + 20s;
    while (!condition() && Clock::now() < until) std::this_thread::sleep_for(20ms);
    return condition();
}

struct Line : ::testing::Test {
    Line() { ::setenv("XDG_STATE_HOME", state.path().c_str(), 1); }

    TemporaryFolder state{"state"};
    std::atomic<int> changes = 0;

    std::unique_ptr<CellLine> line(std::uint16_t port) {
        return std::make_unique<CellLine>("id", "127.0.0.1:" + std::to_string(port), "a cell", std::nullopt,
                                          [this](const CellView&) { ++changes; });
    }
};

TEST(CellView, SaysWhereTheProgramIsWhileTheJobRuns) {
    Status status;
    status.job_id = Uuid{1};
    status.job_state = JobState::running;
    status.block_no = program_block(3, 812);
    status.tool_no = 2;
    CellView view;
    take_status(status, view);
    EXPECT_EQ(view.program_chunk, 3U);
    EXPECT_EQ(view.program_line, 812U);
    EXPECT_EQ(view.tool, 2U);
    EXPECT_NE(to_json(view).find("\"program_line\":812"), std::string::npos) << to_json(view);
    status.block_no = 812;  // of a job without a program
    take_status(status, view);
    EXPECT_FALSE(view.program_chunk || view.program_line || view.tool);
    status.block_no = program_block(3, 812);
    status.job_state = JobState::ended;
    take_status(status, view);
    EXPECT_FALSE(view.program_chunk || view.program_line || view.tool);
    EXPECT_NE(to_json(view).find("\"program_line\":null"), std::string::npos) << to_json(view);
}

TEST_F(Line, ShowsWhatTheCellSaysOfItself) {
    CellSim sim(CellSimOptions{});
    sim.start();
    const auto l = line(sim.port());
    EXPECT_TRUE(comes_true([&] { return l->view().link == CellLinkState::connected; }));
    const CellView view = l->view();
    EXPECT_EQ(view.kind, CellKind::simulated);
    EXPECT_EQ(view.state, sim.status().state);
    EXPECT_FALSE(view.job);
    EXPECT_LT(*view.read_ms_ago, 20'000);
    EXPECT_TRUE(comes_true([&] { return changes > 0; })) << "it is told after the view is there";
}

TEST_F(Line, ACellThatIsNotThereIsNoErrorAndIsFoundWhenItComes) {
    CellSimOptions options;
    {
        CellSim sim(options);
        sim.start();
        options.port = sim.port();
    }
    const auto l = line(options.port);
    std::this_thread::sleep_for(300ms);
    EXPECT_EQ(l->view().link, CellLinkState::never);
    EXPECT_EQ(l->hold().status, 502U);
    CellSim sim(options);
    sim.start();
    EXPECT_TRUE(comes_true([&] { return l->view().link == CellLinkState::connected; }));
    sim.stop();
    EXPECT_TRUE(comes_true([&] { return l->view().link == CellLinkState::lost; }));
    EXPECT_EQ(l->view().kind, CellKind::simulated);  // what was read last, with its age
}

TEST_F(Line, HoldIsAnsweredByTheCell) {
    CellSim sim(CellSimOptions{});
    sim.start();
    const auto l = line(sim.port());
    EXPECT_TRUE(comes_true([&] { return l->view().link == CellLinkState::connected; }));
    const WorkerAnswer answer = l->hold();  // nothing runs: the cell refuses it, and that is an answer
    EXPECT_EQ(answer.status, 200U);
    EXPECT_NE(answer.document.find("\"action\": \"hold\""), std::string::npos) << answer.document;
}

TEST_F(Line, ACommandForAnotherJobThanTheOneInTheCellIsNotSent) {
    CellSim sim(CellSimOptions{});
    sim.start();
    const auto l = line(sim.port());
    EXPECT_TRUE(comes_true([&] { return l->view().link == CellLinkState::connected; }));
    const Status before = sim.status();
    const WorkerAnswer answer = l->command("stop", "7f0c9a1e-5c1f-4d0a-9c2e-0123456789ab");
    EXPECT_EQ(answer.status, 409U);
    EXPECT_EQ(sim.status().ack_seq, before.ack_seq);
    EXPECT_EQ(l->command("stop", "").status, 200U);
}

TEST_F(Line, ACommandThatWaitsForThePersonAtTheCellDelaysNeitherTheReadingNorAnother) {
    CellSimOptions options;
    options.limits.consent = Consent::ask;
    std::promise<void> answered;
    options.ask = [over = answered.get_future().share()](const std::string&) {
        over.wait();
        return true;
    };
    CellSim sim(options);
    sim.start();
    const auto l = line(sim.port());
    const auto is_in = [&](PackState wanted) { return comes_true([&] { return l->view().state == wanted; }); };
    EXPECT_TRUE(comes_true([&] { return l->view().link == CellLinkState::connected; }));
    ASSERT_EQ(l->command("abort", "").status, 200U);
    ASSERT_TRUE(is_in(PackState::aborted));
    std::future<WorkerAnswer> clear = std::async(std::launch::async, [&] { return l->command("clear", ""); });
    ASSERT_TRUE(comes_true([&] { return sim.status().ack_result == AckResult::pending; }));
    for (int i = 0; i < 10; ++i) {
        std::this_thread::sleep_for(200ms);
        EXPECT_EQ(clear.wait_for(0s), std::future_status::timeout);
        EXPECT_LT(*l->view().read_ms_ago, 1'500);
    }
    EXPECT_EQ(l->command("abort", "").status, 200U);
    // Its answer is not in STATUS any more, and so it waits no longer.
    EXPECT_EQ(clear.wait_for(20s), std::future_status::ready);
    answered.set_value();
    const WorkerAnswer end = clear.get();
    EXPECT_EQ(end.status, 200U);
    EXPECT_NE(end.document.find("\"unknown\""), std::string::npos) << end.document;
}

}  // namespace
}  // namespace qchopper
