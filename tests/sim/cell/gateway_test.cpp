// A gateway between PC and cell that hides what happens to its own connection to the cell: the PC's connection stays,
// and the restart or the new memory of the cell shows in STATUS and IDENTITY only.

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>
#include <utility>

#include "sim/cell/script.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

enum class Gateway {
    repeats,  // it connects anew and sends the request once more, also if the cell may have handled it already
    reports   // it connects anew, and answers exception 0x0B (no answer of the target) to that request
};

class GatewayBus : public RegisterBus {
 public:
    // `on_lost` is called at every lost connection to the cell.
    GatewayBus(const CellSim& cell, Gateway kind, std::function<void()> on_lost)
        : bus_(rig::connect(cell)), kind_(kind), on_lost_(std::move(on_lost)) {}
    BusAnswer read_input(std::uint16_t address, std::uint16_t count) override {
        return pass([&] { return bus_->read_input(address, count); });
    }
    BusAnswer read_holding(std::uint16_t address, std::uint16_t count) override {
        return pass([&] { return bus_->read_holding(address, count); });
    }
    BusAnswer write_holding(std::uint16_t address, std::span<const std::uint16_t> registers) override {
        return pass([&] { return bus_->write_holding(address, registers); });
    }
    int hidden() const { return hidden_; }  // lost connections that the PC was not told of

 private:
    BusAnswer pass(const std::function<BusAnswer()>& request) {
        BusAnswer answer = request();
        for (int i = 0; i < 500 && answer.end == BusEnd::lost; ++i) {
            on_lost_();
            if (kind_ == Gateway::reports) return {BusEnd::exception, 0x0B, {}, "gateway target failed to respond"};
            ++hidden_;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            answer = request();
        }
        return answer;
    }
    std::unique_ptr<ModbusTcpBus> bus_;
    Gateway kind_;
    std::function<void()> on_lost_;
    int hidden_ = 0;
};

struct Seen {
    JobOutcome outcome;
    std::uint32_t starts_before = 0;  // STARTS_TOTAL when the power was cut
    std::uint32_t starts_total = 0;   // at the end, of the memory that the cell has then
    int hidden = 0;
};

// The power of the cell is cut at a point of the dispatch, and comes back by `back` once the gateway has noticed.
Seen dispatched(Gateway kind, const std::string& point, const std::string& back) {
    const rig::Folder folder;
    std::filesystem::create_directory(folder.path / "drop");
    CellSim cell(rig::quick_cell(folder.path / "drop"));
    cell.start();
    const auto perform = [&](const std::string& text) {
        for (const ScriptLine& line : parse_script(text + "\n", "test")) cell.perform(line);
    };
    bool is_off = false;
    GatewayBus bus(cell, kind, [&] {
        if (std::exchange(is_off, false)) perform(back);
    });
    Seen seen;
    DispatchOptions options = rig::quick_dispatch(folder.path / "drop");
    bool is_done = false;
    options.journal = [](const JournalEvent&) {};
    options.at_point = [&](const std::string& now) {
        if (is_done || now != point) return;
        is_done = is_off = true;
        seen.starts_before = cell.status().starts_total;
        perform("power off");
    };
    const rig::Job job = rig::make_job(500, 200);
    seen.outcome = dispatch_job(bus, job.ticket, job.file, options, {});
    seen.starts_total = cell.status().starts_total;
    seen.hidden = bus.hidden();
    EXPECT_TRUE(is_done) << point;
    return seen;
}

const std::string start_arrived = "after_start_sent";
const std::string running = "after_started";

TEST(Gateway, ARestartBeforeTheStartThatItHidesIsSeenAndTheJobStartsOnce) {
    for (const std::string point : {"after_claim_sent", "after_store_sent", "after_put_file", "before_start_intent"}) {
        const Seen seen = dispatched(Gateway::repeats, point, "power on");
        EXPECT_GT(seen.hidden, 0) << point;
        EXPECT_EQ(seen.outcome.start_outcome, StartOutcome::started) << point << ": " << seen.outcome.why;
        EXPECT_EQ(seen.outcome.job_result, JobResult::complete) << point << ": " << seen.outcome.why;
        EXPECT_EQ(seen.starts_total, 1U) << point;
    }
}

TEST(Gateway, ARestartAfterTheStartThatItHidesIsAPowerLossAndNoSecondStart) {
    for (const std::string& point : {start_arrived, running}) {
        const Seen seen = dispatched(Gateway::repeats, point, "power on");
        EXPECT_GT(seen.hidden, 0) << point;
        EXPECT_EQ(seen.outcome.start_outcome, StartOutcome::started) << point << ": " << seen.outcome.why;
        EXPECT_EQ(seen.outcome.job_result, JobResult::power_loss) << point << ": " << seen.outcome.why;
        EXPECT_EQ(seen.starts_total, 1U) << point;
    }
}

TEST(Gateway, AnEmptiedCellThatItHidesGetsNoSecondStart) {
    for (const std::string& point : {start_arrived, running}) {
        const Seen seen = dispatched(Gateway::repeats, point, "power store-lost");
        EXPECT_GT(seen.hidden, 0) << point;
        EXPECT_TRUE(seen.outcome.store_is_lost) << point << ": " << seen.outcome.why;
        EXPECT_EQ(seen.outcome.start_outcome, point == running ? StartOutcome::started : StartOutcome::unknown)
            << seen.outcome.why;
        EXPECT_EQ(seen.starts_before, 1U) << point;
        EXPECT_EQ(seen.starts_total, 0U) << point;
    }
    const Seen stored = dispatched(Gateway::repeats, "after_store_sent", "power store-lost");
    EXPECT_EQ(stored.outcome.start_outcome, StartOutcome::not_started) << stored.outcome.why;
    EXPECT_EQ(stored.starts_before + stored.starts_total, 0U);
    // START goes to the emptied cell, through the gateway: the PC cannot know.
    const Seen sent = dispatched(Gateway::repeats, "before_start_intent", "power store-lost");
    EXPECT_EQ(sent.outcome.start_outcome, StartOutcome::unknown) << sent.outcome.why;
    EXPECT_EQ(sent.starts_before + sent.starts_total, 0U);
}

// The word is right, and the hand-off ends with it: the next dispatch takes the job up.
TEST(Gateway, WhatItReportsEndsTheHandOffWithTheRightWord) {
    const Seen early = dispatched(Gateway::reports, "after_store_sent", "power on");
    EXPECT_EQ(early.outcome.start_outcome, StartOutcome::not_started) << early.outcome.why;
    EXPECT_NE(early.outcome.why.find("gateway"), std::string::npos) << early.outcome.why;
    EXPECT_EQ(early.starts_total, 0U);
    for (const std::string& point : {start_arrived, running}) {
        const Seen seen = dispatched(Gateway::reports, point, "power on");
        EXPECT_EQ(seen.outcome.start_outcome, StartOutcome::started) << point << ": " << seen.outcome.why;
        EXPECT_EQ(seen.starts_total, 1U) << point;
    }
}

}  // namespace
}  // namespace qchopper
