// Commands of another program to a cell that runs a job, or that is free.

#include "devices/hand_off/cell_control.h"

#include <gtest/gtest.h>

#include <thread>

#include "devices/hand_off/first_contact.h"
#include "sim/cell/script.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

using Kind = ControlEnd::Kind;

struct Controlled {
    explicit Controlled(double speed = 100, std::uint32_t takeover_code = 0) {
        CellSimOptions options = rig::quick_cell(folder.path);
        options.limits.speed = speed;
        options.limits.takeover_code = takeover_code;
        cell = std::make_unique<CellSim>(options);
        cell->start();
    }
    ControlEnd send(ControlOrder order) const {
        const auto bus = rig::connect(*cell);
        const HandOffInput input = read_status_block(*bus);
        return control_cell(*bus, *input.status, order, {});
    }
    ControlEnd send(CellCommand command) const {
        ControlOrder order;
        order.command = command;
        return send(order);
    }
    void perform(const std::string& line) const {
        for (const ScriptLine& one : parse_script(line + "\n", "test")) cell->perform(one);
    }
    bool comes_to(PackState state) const {
        for (int n = 0; n < 3000 && cell->status().state != state; ++n) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return cell->status().state == state;
    }
    rig::Folder folder;
    std::unique_ptr<CellSim> cell;
};

// A dispatcher in a thread of its own.
struct RunningJob {
    RunningJob(const Controlled& rig, DispatchOptions options)
        : thread([this, &rig, options] {
              const auto bus = rig::connect(*rig.cell);
              const rig::Job job = rig::make_job(100, 200);
              outcome = dispatch_job(*bus, job.ticket, job.file, options, {});
          }) {}
    JobOutcome outcome;
    std::jthread thread;
};

TEST(Fault, F51_AbortGetsThroughBesideEightSilentConnections) {
    const Controlled rig;
    std::vector<std::unique_ptr<rig::RawSocket>> silent;
    for (int n = 0; n < 8; ++n) silent.push_back(std::make_unique<rig::RawSocket>(rig.cell->port()));
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    const auto bus = rig::connect(*rig.cell);
    const std::optional<Status> status = read_first_status(*bus, "the cell", {});  // tries for two seconds
    ASSERT_TRUE(status.has_value());
    ControlOrder order;
    order.command = CellCommand::abort;
    EXPECT_EQ(control_cell(*bus, *status, order, {}).kind, Kind::done);
    EXPECT_TRUE(rig.comes_to(PackState::aborted));
}

TEST(CellControl, HoldUnholdAndStopBesideADispatchThatGoesOn) {
    const Controlled rig(10);
    DispatchOptions options = rig::quick_dispatch(rig.folder.path);
    std::atomic<CellCommand> wanted = CellCommand::none;
    RequestAnswer answer;
    options.request = [&] { return wanted.exchange(CellCommand::none); };
    std::atomic<bool> is_answered = false;
    options.answer_request = [&](const RequestAnswer& given) {
        answer = given;
        is_answered = true;
    };
    RunningJob running(rig, options);
    ASSERT_TRUE(rig.comes_to(PackState::execute));
    EXPECT_EQ(rig.send(CellCommand::hold).kind, Kind::done);
    ASSERT_TRUE(rig.comes_to(PackState::held));
    // With a lease of its own it would have to wait for the dispatcher, which passes the command on instead.
    const ControlEnd busy = rig.send(CellCommand::unhold);
    EXPECT_EQ(busy.kind, Kind::refused);
    EXPECT_EQ(busy.result, AckResult::lease_busy);
    EXPECT_NE(busy.why.find("dispatcher 0x"), std::string::npos) << busy.why;
    wanted = CellCommand::unhold;
    ASSERT_TRUE(rig.comes_to(PackState::execute));
    for (int n = 0; n < 2000 && !is_answered; ++n) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(answer.end, CommandEnd::done);
    EXPECT_EQ(rig.send(CellCommand::stop).kind, Kind::done);
    running.thread.join();
    EXPECT_EQ(running.outcome.start_outcome, StartOutcome::started) << running.outcome.why;
    EXPECT_EQ(running.outcome.job_result, JobResult::stopped);
    EXPECT_EQ(rig.cell->status().starts_total, 1U);
}

// Between the look at the cell and the command the job changed: it is not the one that was meant.
TEST(Fault, F45_ALateCommandForAnotherJobIsRefusedAndTheJobRunsOn) {
    const Controlled rig(10);
    const RunningJob running(rig, rig::quick_dispatch(rig.folder.path));
    ASSERT_TRUE(rig.comes_to(PackState::execute));
    const auto bus = rig::connect(*rig.cell);
    Status before = *read_status_block(*bus).status;
    before.job_id[0] ^= 1;
    for (const CellCommand command : {CellCommand::stop, CellCommand::hold}) {
        ControlOrder order;
        order.command = command;
        const ControlEnd end = control_cell(*bus, before, order, {});
        EXPECT_EQ(end.kind, Kind::refused) << name(command) << end.why;
        EXPECT_EQ(end.result, AckResult::wrong_job) << name(command);
        EXPECT_EQ(rig.cell->status().state, PackState::execute);
    }
    EXPECT_EQ(rig.send(CellCommand::stop).kind, Kind::done);
}

TEST(Fault, F46_AbortOfAProgramWithoutLeaseIsAccepted) {
    const Controlled rig(10);
    RunningJob running(rig, rig::quick_dispatch(rig.folder.path));
    ASSERT_TRUE(rig.comes_to(PackState::execute));
    EXPECT_EQ(rig.send(CellCommand::abort).kind, Kind::done);
    running.thread.join();
    EXPECT_EQ(running.outcome.start_outcome, StartOutcome::started);
    EXPECT_EQ(running.outcome.job_state, JobState::aborted);
    // Back to Idle: Clear with consent, which this cell gives by itself, then Reset.
    ASSERT_TRUE(rig.comes_to(PackState::aborted)) << name(rig.cell->status().state);
    const ControlEnd cleared = rig.send(CellCommand::clear);
    EXPECT_EQ(cleared.kind, Kind::done) << cleared.why;
    ASSERT_TRUE(rig.comes_to(PackState::stopped));
    EXPECT_EQ(rig.send(CellCommand::reset).kind, Kind::done);
    EXPECT_TRUE(rig.comes_to(PackState::idle));
    EXPECT_FALSE(rig.cell->status().has(flag::lease_held));
}

TEST(CellControl, UnderLocalControlNothingIsSent) {
    const Controlled rig;
    rig.perform("panel local");
    for (const CellCommand command : {CellCommand::hold, CellCommand::unhold, CellCommand::stop, CellCommand::abort,
                                      CellCommand::clear, CellCommand::reset, CellCommand::claim}) {
        const ControlEnd end = rig.send(command);
        EXPECT_EQ(end.kind, Kind::refused) << name(command);
        EXPECT_EQ(end.result, AckResult::local_control);
        EXPECT_NE(end.why.find("LOCAL_CONTROL"), std::string::npos);
    }
    EXPECT_EQ(rig.cell->status().ack_seq, 0U);
}

TEST(CellControl, WithoutAJobThereIsNothingToHold) {
    const Controlled rig;
    for (const CellCommand command : {CellCommand::hold, CellCommand::unhold, CellCommand::stop}) {
        EXPECT_EQ(rig.send(command).result, AckResult::wrong_state) << name(command);
    }
    EXPECT_EQ(rig.cell->status().ack_seq, 0U);
}

TEST(CellControl, ACellThatLostItsMemoryGetsNoCommandThatNeedsALease) {
    const Controlled rig;
    ControlOrder order;
    order.command = CellCommand::reset;
    order.past.store = SeenStore{{1, 2, 3}, map_version, 1, 0, 0};
    const ControlEnd end = rig.send(order);
    EXPECT_EQ(end.kind, Kind::refused);
    EXPECT_NE(end.why.find("CELL_STORE_LOST"), std::string::npos) << end.why;
    EXPECT_EQ(rig.cell->status().epoch_held, 0U);
}

TEST(Fault, F34_ATakeoverWithTheCodeOfThePanelEndsTheLeaseOfTheOther) {
    const Controlled rig(10, 4711);
    RunningJob running(rig, rig::quick_dispatch(rig.folder.path));
    ASSERT_TRUE(rig.comes_to(PackState::execute));
    ControlOrder order;
    order.command = CellCommand::claim;
    order.takeover_code = 1;
    EXPECT_EQ(rig.send(order).result, AckResult::lease_busy);
    order.takeover_code = 4711;
    EXPECT_EQ(rig.send(order).kind, Kind::done);
    EXPECT_FALSE(rig.cell->status().has(flag::lease_held));
    EXPECT_EQ(rig.send(CellCommand::stop).kind, Kind::done);
    running.thread.join();
    EXPECT_EQ(running.outcome.start_outcome, StartOutcome::started) << running.outcome.why;
    EXPECT_EQ(rig.cell->status().starts_total, 1U);
}

}  // namespace
}  // namespace qchopper
