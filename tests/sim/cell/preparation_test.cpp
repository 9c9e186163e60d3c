// What is checked before a job may start: ticket against cell, consent, rehearsal.

#include "sim/cell/machine.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "tests/sim/cell/cell_bench.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::good_ticket;
using bench::job_a;

using Change = std::function<void(WireTicket&)>;

WireTicket changed_ticket(const Change& change) {
    WireTicket ticket = good_ticket();
    change(ticket);
    return ticket;
}

// PREPARE of a verified job with such a ticket: the result and its detail. PENDING if and only if somebody is asked.
std::pair<AckResult, std::uint32_t> prepare(const CellLimits& limits, const Change& change) {
    Bench bench(limits);
    bench.to_verified(changed_ticket(change));
    const AckResult result = bench.send(CellCommand::prepare, job_a);
    EXPECT_EQ(bench.cell.pending.has_value(), result == AckResult::pending);
    return {result, bench.cell.ack.detail};
}

TEST(Prepare, ChecksReachStockAndToolBeforeAnybodyIsAsked) {
    CellLimits limits;
    limits.workspace = {{-10, -10, 0}, {10, 10, 20}};
    limits.max_stock = {30, 30, 30};
    limits.tools = {{3}, {4}};
    const auto answer = [&](const Change& change) { return prepare(limits, change); };
    EXPECT_EQ(answer([](WireTicket&) {}).first, AckResult::pending);
    EXPECT_EQ(answer([](WireTicket& t) { t.box_max[2] = 2001; }), std::pair(AckResult::envelope, 155U));
    EXPECT_EQ(answer([](WireTicket& t) { t.box_min[0] = -1001; }), std::pair(AckResult::envelope, 145U));
    EXPECT_EQ(answer([](WireTicket& t) { t.stock[1] = 3001; }), std::pair(AckResult::envelope, 159U));
    EXPECT_EQ(answer([](WireTicket& t) { t.stock[0] = 1999; }), std::pair(AckResult::stock_too_small, 157U));
    EXPECT_EQ(answer([](WireTicket& t) { t.tool_no = 9; }), std::pair(AckResult::tool, 164U));
    limits = {};
    EXPECT_EQ(answer([](WireTicket& t) {
                  t.box_min[0] = INT32_MIN;
                  t.box_max[0] = INT32_MAX;
              }).first,
              AckResult::envelope);
}

TEST(Prepare, ChecksTheToolsSizeAndSpeedsAndThatNothingLiesBelowTheTable) {
    CellLimits limits;
    limits.tools = {{3, 12, 18000, 4000}, {4, 6, 24000, 6000}};
    const auto answer = [&](const Change& change) { return prepare(limits, change); };
    const auto sound = [](WireTicket& t) {
        t.tool_diameter_um = 12000;
        t.spindle_max_rpm = 24000;
        t.feed_max_mm_per_min = 6000;
    };
    EXPECT_EQ(answer(sound).first, AckResult::pending) << "at most the largest of the list";
    const auto field = [](std::uint32_t address) { return std::pair(AckResult::ticket_field, address); };
    EXPECT_EQ(answer([](WireTicket& t) { t.tool_diameter_um = 12001; }), field(165));
    EXPECT_EQ(answer([](WireTicket& t) { t.spindle_max_rpm = 24001; }), field(167));
    EXPECT_EQ(answer([](WireTicket& t) { t.feed_max_mm_per_min = 6001; }), field(168));
    EXPECT_EQ(answer([](WireTicket& t) { t.box_min[2] = -1; }), field(149));
}

TEST(Prepare, IsPendingUntilSomebodyConsents) {
    CellLimits limits;
    limits.consent = Consent::ask;
    Bench bench(limits);
    bench.to_verified();
    ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    const std::uint64_t number = bench.cell.pending->number;
    bench.heartbeat();
    bench.pass(1000);
    EXPECT_EQ(bench.cell.ack.result, AckResult::pending);
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);  // the same question, not a second one
    EXPECT_EQ(bench.cell.pending->number, number);
    consent_given(bench.cell, number + 1, true, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::pending);
    consent_given(bench.cell, number, false, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::no_consent);
    EXPECT_EQ(bench.cell.job.state, JobState::stored);
    ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    consent_given(bench.cell, bench.cell.pending->number, true, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::ok);
    const std::uint32_t token = bench.cell.job.token;
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::already);
    EXPECT_EQ(bench.cell.job.token, token);
}

TEST(Prepare, ConsentThatComesAfterTheLeaseHasGonePreparesNothing) {
    CellLimits limits;
    limits.consent = Consent::ask;
    Bench bench(limits);
    bench.to_verified();
    ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    const std::uint64_t number = bench.cell.pending->number;
    bench.pass(6000);
    consent_given(bench.cell, number, true, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.job.state, JobState::stored);
    EXPECT_EQ(bench.cell.job.token, 0U);
}

TEST(Prepare, ConsentIsForOneStartOnly) {
    Bench bench;
    bench.to_running();
    bench.pass(102000);
    EXPECT_FALSE(bench.status().has(flag::consent_present));
    EXPECT_FALSE(bench.status().has(flag::block_loaded));
}

TEST(Rehearse, GivesAReceiptThatPrepareAsksForAndMovesNothing) {
    Bench bench;
    WireTicket ticket = good_ticket();
    ticket.requirements = 1;
    bench.to_verified(ticket);
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::rehearsal_required);
    ASSERT_EQ(bench.send(CellCommand::rehearse, job_a), AckResult::pending);
    EXPECT_EQ(bench.status().unit_mode, UnitMode::rehearsal);
    EXPECT_TRUE(bench.status().has(flag::rehearsal_running));
    EXPECT_EQ(bench.send(CellCommand::start, job_a, 1), AckResult::wrong_mode);
    ASSERT_EQ(bench.send(CellCommand::rehearse, job_a), AckResult::pending);
    bench.pass(1100);
    EXPECT_EQ(bench.cell.ack.result, AckResult::ok);
    const std::uint32_t receipt = bench.cell.ack.detail;
    EXPECT_NE(receipt, 0U);
    EXPECT_EQ(bench.status().unit_mode, UnitMode::production);
    EXPECT_EQ(bench.status().job_result, JobResult::rehearsal_passed);
    EXPECT_EQ(bench.status().state, PackState::idle);
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a, 0, receipt + 1), AckResult::rehearsal_required);
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a, 0, receipt), AckResult::pending);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
}

}  // namespace
}  // namespace qchopper
