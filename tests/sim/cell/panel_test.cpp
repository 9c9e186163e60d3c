// What a person at the cell does, and power cuts; in time that is counted.

#include "sim/cell/panel.h"

#include <gtest/gtest.h>

#include "tests/sim/cell/cell_bench.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::good_ticket;
using bench::job_a;
using bench::job_b;

CellLimits asking() {
    CellLimits limits;
    limits.consent = Consent::ask;
    return limits;
}

void answer(Bench& bench, bool yes) {
    ASSERT_TRUE(bench.cell.pending.has_value());
    consent_given(bench.cell, bench.cell.pending->number, yes, bench.now, bench.hooks);
}

TEST(Panel, TheDoorAbortsWhatMovesAndNotWhatIsHeld) {
    Bench bench;
    bench.to_running();
    bench.pass(1000);
    ASSERT_EQ(bench.send(CellCommand::hold, job_a), AckResult::ok);
    bench.pass(300);
    open_door(bench.cell, true, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.state, PackState::held);
    EXPECT_TRUE(bench.status().has(flag::safety_open));
    EXPECT_EQ(bench.send(CellCommand::unhold, job_a), AckResult::safety_open);
    open_door(bench.cell, false, bench.now, bench.hooks);
    ASSERT_EQ(bench.send(CellCommand::unhold, job_a), AckResult::pending);
    bench.pass(300);
    EXPECT_EQ(bench.cell.state, PackState::execute);
    open_door(bench.cell, true, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.state, PackState::aborting);
    EXPECT_EQ(bench.status().alarm_text, "door opened");
    EXPECT_EQ(bench.cell.memory.jobs.at(job_a).result, JobResult::aborted);
}

TEST(Panel, UnderLocalControlWhatActsIsRefusedAndWhatAsksIsAnswered) {
    for (const CellCommand command : all_commands) {
        Bench bench;
        bench.to_verified();
        set_local_control(bench.cell, true, bench.hooks);
        const bool acts = command == CellCommand::abort || command == CellCommand::prepare ||
                          command == CellCommand::verify || command == CellCommand::rehearse ||
                          command == CellCommand::set_mode;
        const bool has_no_job = command == CellCommand::set_mode || command == CellCommand::query_file;
        if (!acts && command != CellCommand::query && command != CellCommand::query_file) continue;
        const AckResult result = bench.send(command, has_no_job ? Uuid{} : job_a, 0, 2);
        EXPECT_EQ(result == AckResult::local_control, acts) << name(command) << " " << name(result);
    }
}

TEST(Panel, ThePanelEndsAPreparationButNotAJob) {
    Bench prepared;
    prepared.to_prepared();
    const std::uint32_t token = prepared.cell.job.token;
    set_local_control(prepared.cell, true, prepared.hooks);
    EXPECT_TRUE(prepared.status().has(flag::local_control));
    EXPECT_EQ(prepared.send(CellCommand::start, job_a, token), AckResult::local_control);
    set_local_control(prepared.cell, false, prepared.hooks);
    EXPECT_EQ(prepared.send(CellCommand::start, job_a, token), AckResult::token_bad);
    Bench running;
    running.to_running();
    running.pass(1000);
    set_local_control(running.cell, true, running.hooks);
    EXPECT_EQ(running.send(CellCommand::stop, job_a), AckResult::local_control);
    EXPECT_EQ(running.send(CellCommand::hold, job_a), AckResult::local_control);
    EXPECT_EQ(running.send(CellCommand::abort, job_a), AckResult::local_control);
    EXPECT_EQ(running.cell.state, PackState::execute);
}

TEST(Panel, ATokenDiesWithTheBlock) {
    Bench bench;
    bench.to_prepared();
    const std::uint32_t token = bench.cell.job.token;
    set_block(bench.cell, BlockOnTable::moved, bench.hooks);
    EXPECT_EQ(bench.send(CellCommand::start, job_a, token), AckResult::token_bad);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
}

TEST(Panel, ALaterPartIsAskedForTheSameBlockNotMoved) {
    Bench bench(asking());
    WireTicket ticket = good_ticket();
    ticket.part = 2;
    ticket.parts = 3;
    bench.to_verified(ticket);
    ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    const std::string& question = bench.cell.pending->question;
    EXPECT_NE(question.find("part 2 of 3"), std::string::npos) << question;
    EXPECT_NE(question.find("same block, not moved since part 1"), std::string::npos) << question;
}

TEST(Panel, AutomaticConsentLooksAtTheBlock) {
    const auto prepare = [](BlockOnTable block, std::uint16_t part) {
        Bench bench;
        WireTicket ticket = good_ticket();
        ticket.part = part;
        ticket.parts = part == 0 ? std::uint16_t{0} : std::uint16_t{3};
        bench.to_verified(ticket);
        set_block(bench.cell, block, bench.hooks);
        EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
        bench.pass(10);
        return bench.cell.ack.result;
    };
    for (const std::uint16_t part : {0, 1, 2, 3}) {
        const bool is_first = part <= 1;
        EXPECT_EQ(prepare(BlockOnTable::unknown, part), AckResult::ok);
        EXPECT_EQ(prepare(BlockOnTable::none, part), AckResult::no_consent);
        EXPECT_EQ(prepare(BlockOnTable::moved, part), AckResult::no_consent);
        EXPECT_EQ(prepare(BlockOnTable::fresh, part), is_first ? AckResult::ok : AckResult::no_consent);
        EXPECT_EQ(prepare(BlockOnTable::used, part), is_first ? AckResult::no_consent : AckResult::ok);
    }
}

TEST(Panel, AFileThatWasStartedBeforeIsNamedInTheQuestion) {
    Bench bench(asking());
    JobRecord before;
    before.state = JobState::ended;
    before.starts = 1;
    before.file_sha256 = bench::good_digest();
    bench.cell.memory.jobs[job_b] = before;
    bench.to_verified();
    ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    EXPECT_NE(bench.cell.pending->question.find("started 1 times before"), std::string::npos);
}

TEST(Fault, F23_TheCellRestartsBeforePrepare) {
    Bench bench;
    bench.to_verified();
    bench.restart();
    EXPECT_EQ(bench.cell.state, PackState::stopped);
    EXPECT_EQ(bench.status().job_state, JobState::none);
    EXPECT_FALSE(bench.status().has(flag::lease_held));
    EXPECT_EQ(bench.send(CellCommand::query, job_a), AckResult::unknown_job);
}

TEST(Fault, F23_TheCellRestartsAfterPrepare) {
    Bench bench;
    bench.to_prepared();
    const std::uint32_t token = bench.cell.job.token;
    bench.restart();
    EXPECT_EQ(bench.send(CellCommand::start, job_a, token), AckResult::not_owner);
    ASSERT_EQ(bench.claim(), AckResult::ok);
    EXPECT_EQ(bench.send(CellCommand::start, job_a, token), AckResult::unknown_job);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
}

TEST(Fault, F23_TheCellRestartsAfterStartAndDuringExecute) {
    for (const std::int64_t after_ms : {0, 100, 5000}) {
        Bench bench;
        bench.to_running();
        bench.pass(after_ms);
        bench.restart();
        EXPECT_EQ(bench.cell.state, PackState::aborted);
        bench.pass(200000);
        EXPECT_EQ(bench.cell.state, PackState::aborted) << "nothing starts by itself";
        ASSERT_EQ(bench.send(CellCommand::query, job_a), AckResult::ok);
        EXPECT_EQ(bench.cell.answer.result, JobResult::power_loss);
        EXPECT_EQ(bench.cell.answer.starts, 1U);
        EXPECT_EQ(bench.cell.memory.starts_total, 1U);
    }
}

TEST(Fault, F23_TheCellRestartsAfterTheEnd) {
    Bench bench;
    bench.to_running();
    bench.pass(102000);
    bench.restart();
    EXPECT_EQ(bench.cell.state, PackState::stopped);
    ASSERT_EQ(bench.send(CellCommand::query, job_a), AckResult::ok);
    EXPECT_EQ(bench.cell.answer.result, JobResult::complete);
}

// Power is cut before and after each write of the memory and at each line of the log of a whole job.
TEST(Fault, F23_APowerCutAtAnyEventLeavesOneStartOrNone) {
    bool started_and_not = false;
    std::uint32_t least = 1;
    for (std::int64_t event = 1; event < 60; ++event) {
        Bench bench;
        bench.hooks.save = [&bench](const CellMemory& memory) {
            bench.saved.push_back(memory);
            return true;
        };
        const auto is_cut = [&bench] { return bench.cell.power.lost; };
        arm(bench.cell, {Fault::power_cut, event}, bench.now);
        bench.claim();
        if (!is_cut()) bench.send(CellCommand::reset);
        bench.pass(300);
        bench.write_ticket(good_ticket());
        if (!is_cut()) bench.send(CellCommand::store, job_a);
        if (!is_cut()) bench.send(CellCommand::verify, job_a);
        if (!is_cut() && bench.cell.pending) {
            const FileCheck right{FileCheck::End::ok, 1000, bench::good_digest()};
            file_checked(bench.cell, bench.cell.pending->number, right, bench.now, bench.hooks);
        }
        if (!is_cut()) bench.send(CellCommand::prepare, job_a);
        if (!is_cut()) bench.pass(10);
        if (!is_cut()) bench.send(CellCommand::start, job_a, bench.cell.job.token);
        if (!is_cut()) bench.pass(102000);
        const bool was_cut = is_cut();
        bench.restart();
        const std::uint32_t starts = bench.cell.memory.starts_total;
        EXPECT_LE(starts, 1U);
        EXPECT_EQ(bench.cell.memory.jobs.contains(job_a), starts == 1) << event;
        if (!was_cut) break;
        started_and_not = started_and_not || starts > least;
        least = std::min(least, starts);
        EXPECT_LT(event, 59) << "there are more events than this test tries";
    }
    EXPECT_TRUE(started_and_not);
}

TEST(Fault, F29_WithoutHeartbeatsOfThePcTheTicketDecides) {
    for (const LinkLoss policy : {LinkLoss::go_on, LinkLoss::hold}) {
        Bench bench;
        WireTicket ticket = good_ticket();
        ticket.on_link_loss = policy;
        bench.to_running(ticket);
        bench.heartbeat();
        bench.pass(2400);
        EXPECT_FALSE(bench.status().has(flag::watchdog_expired));
        bench.pass(400);
        EXPECT_TRUE(bench.status().has(flag::watchdog_expired));
        bench.pass(1000);
        EXPECT_EQ(bench.cell.state, policy == LinkLoss::hold ? PackState::held : PackState::execute);
    }
}

TEST(Fault, F31_AJumpOfTheTimeOfDayMovesNoLeaseNoTokenAndNoJob) {
    for (const std::int64_t jump_s : {86400, -86400}) {
        Bench plain;
        Bench jumped;
        for (Bench* bench : {&plain, &jumped}) bench->to_prepared();
        arm(jumped.cell, {Fault::clock_jump, jump_s}, jumped.now);
        Status shown = jumped.status();
        EXPECT_EQ(static_cast<std::int64_t>(shown.cell_time_ms - plain.status().cell_time_ms), 1000 * jump_s);
        shown.cell_time_ms = plain.status().cell_time_ms;
        EXPECT_EQ(shown, plain.status());
        for (Bench* bench : {&plain, &jumped}) {
            ASSERT_EQ(bench->send(CellCommand::start, job_a, bench->cell.job.token), AckResult::ok);
            bench->pass(102000);
            EXPECT_EQ(bench->cell.job.result, JobResult::complete);
        }
        EXPECT_EQ(jumped.cell.state_since_ms, plain.cell.state_since_ms);
    }
}

TEST(Fault, F32_TheHeartbeatOfTheCellWraps) {
    Bench bench;
    arm(bench.cell, {Fault::heartbeat_at, 65530}, bench.now);
    EXPECT_EQ(bench.status().heartbeat, 65530);
    bench.pass(5000);
    EXPECT_EQ(bench.status().heartbeat, 4);
}

TEST(Fault, F32_ThePcsHeartbeatWraps) {
    Bench bench;
    bench.to_idle();
    bench.counter = 65530;
    for (int n = 0; n < 20; ++n) {
        bench.heartbeat();
        bench.pass(1000);
    }
    EXPECT_TRUE(bench.cell.lease.has_value());
    EXPECT_LT(bench.counter, 20);
}

TEST(Fault, F32_NumbersOfCommandsNearTheirEnd) {
    Bench bench;
    bench.seq = 0xFFFFFFFD;
    EXPECT_EQ(bench.claim(), AckResult::ok);
    EXPECT_EQ(bench.send(CellCommand::reset), AckResult::ok);
    ASSERT_EQ(bench.seq, 0xFFFFFFFF);
    // There is no number after the last one: the owner needs another OWNER, and gets the cell when the lease has ended.
    Command next{bench.cell.memory.epoch_held, 0, CellCommand::release, {}, 0, 0, 0, {}, bench::owner};
    receive_command(bench.cell, encode(next), bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.bad_reason, AckResult::stale_seq);
    next.seq = 1;
    receive_command(bench.cell, encode(next), bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.bad_reason, AckResult::stale_seq);
    bench.pass(6000);
    bench.seq = 0;
    EXPECT_EQ(bench.claim(bench::owner + 1), AckResult::ok);
}

TEST(Fault, F38_AStoreThatIsFullAndADiskThatCannotBeWritten) {
    Bench bench;
    bench.to_idle();
    bench.write_ticket(good_ticket());
    arm(bench.cell, {Fault::store_full}, bench.now);
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::store_full);
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::ok);
    arm(bench.cell, {Fault::disk_full}, bench.now);
    EXPECT_EQ(bench.claim(), AckResult::store_io);
    EXPECT_EQ(bench.claim(), AckResult::ok);
}

TEST(Fault, F42_NoConsent) {
    Bench bench;
    bench.to_verified();
    arm(bench.cell, {Fault::no_consent}, bench.now);
    ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    bench.pass(10);
    EXPECT_EQ(bench.cell.ack.result, AckResult::no_consent);
    EXPECT_EQ(bench.cell.job.state, JobState::stored);
    EXPECT_EQ(bench.status().token, 0U);
}

TEST(Fault, F42_TheDoorIsOpenedAfterConsentWasGiven) {
    Bench bench;
    bench.to_verified();
    arm(bench.cell, {Fault::door_after_consent}, bench.now);
    ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    bench.pass(10);
    EXPECT_EQ(bench.cell.job.state, JobState::stored);
    for (const std::uint32_t token : {0U, 1U}) {
        EXPECT_EQ(bench.send(CellCommand::start, job_a, token), AckResult::safety_open);
    }
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::safety_open);
    open_door(bench.cell, false, bench.now, bench.hooks);
    EXPECT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
}

TEST(Fault, F42_TheDoorIsOpenedWhileConsentIsAsked) {
    Bench bench(asking());
    bench.to_verified();
    ASSERT_EQ(bench.send(CellCommand::prepare, job_a), AckResult::pending);
    open_door(bench.cell, true, bench.now, bench.hooks);
    EXPECT_EQ(bench.cell.ack.result, AckResult::safety_open);
    EXPECT_FALSE(bench.cell.pending.has_value());
}

TEST(Fault, F42_AnExpiredToken) {
    Bench bench;
    bench.to_prepared();
    const std::uint32_t token = bench.cell.job.token;
    for (int s = 0; s < 121; ++s) {
        bench.heartbeat();
        bench.pass(1000);
    }
    EXPECT_EQ(bench.send(CellCommand::start, job_a, token), AckResult::token_expired);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
}

TEST(Fault, F59_AnEmergencyStopNeedsClearResetAndANewJob) {
    Bench bench(asking());
    bench.to_running();
    arm(bench.cell, {Fault::e_stop_at, 40}, bench.now);
    for (int n = 0; n < 10; ++n) {
        bench.heartbeat();
        bench.pass(1000);
    }
    EXPECT_EQ(bench.cell.state, PackState::aborted);
    EXPECT_EQ(bench.status().alarm_text, "emergency stop");
    EXPECT_EQ(bench.status().alarm_block, 40U);
    EXPECT_EQ(bench.cell.memory.jobs.at(job_a).last_block, 40U);
    EXPECT_EQ(bench.send(CellCommand::clear), AckResult::safety_open);
    press_e_stop(bench.cell, false, bench.now, bench.hooks);
    bench.pass(1000);
    EXPECT_EQ(bench.cell.state, PackState::aborted);
    ASSERT_EQ(bench.send(CellCommand::clear), AckResult::pending);
    answer(bench, true);
    bench.pass(300);
    EXPECT_EQ(bench.cell.state, PackState::stopped);
    EXPECT_FALSE(bench.status().has(flag::fault));
    EXPECT_EQ(bench.send(CellCommand::start, job_a, 1), AckResult::already_finished);
    EXPECT_EQ(bench.send(CellCommand::clear_result, job_a), AckResult::ok);
    EXPECT_EQ(bench.send(CellCommand::reset), AckResult::ok);
    bench.pass(300);
    EXPECT_EQ(bench.cell.state, PackState::idle);
    bench.write_ticket(good_ticket());
    EXPECT_EQ(bench.send(CellCommand::store, job_a), AckResult::job_id_reused);
    bench.write_ticket(good_ticket(job_b));
    EXPECT_EQ(bench.send(CellCommand::store, job_b), AckResult::ok);
}

TEST(Fault, F60_AnotherJobNeedsAnotherConsentAndAnotherBlock) {
    Bench bench;
    set_block(bench.cell, BlockOnTable::fresh, bench.hooks);
    bench.to_running();
    bench.pass(102000);
    ASSERT_EQ(bench.cell.job.result, JobResult::complete);
    EXPECT_EQ(bench.cell.surroundings.block, BlockOnTable::used);
    ASSERT_EQ(bench.claim(), AckResult::ok);
    ASSERT_EQ(bench.send(CellCommand::clear_result, job_a), AckResult::ok);
    bench.to_verified(good_ticket(job_b));
    ASSERT_EQ(bench.send(CellCommand::prepare, job_b), AckResult::pending);
    bench.pass(10);
    EXPECT_EQ(bench.cell.ack.result, AckResult::no_consent);
    EXPECT_EQ(bench.cell.memory.starts_total, 1U);
    set_block(bench.cell, BlockOnTable::fresh, bench.hooks);
    ASSERT_EQ(bench.send(CellCommand::prepare, job_b), AckResult::pending);
    bench.pass(10);
    EXPECT_EQ(bench.cell.ack.result, AckResult::ok);
}

TEST(Panel, AToolThatBreaksAtABlockEndsTheJobThere) {
    for (const double speed : {1.0, 100.0}) {
        CellLimits limits;
        limits.speed = speed;
        Bench fine(limits);
        fine.to_running();
        Bench coarse(limits);
        coarse.to_running();
        for (Bench* bench : {&fine, &coarse}) arm(bench->cell, {Fault::tool_fault, 200}, bench->now);
        fine.pass(30000);
        coarse.now.steady_ms += 30000;
        pass_time(coarse.cell, coarse.now, coarse.hooks);
        for (const Bench* bench : {&fine, &coarse}) {
            EXPECT_EQ(bench->cell.state, PackState::aborted);
            EXPECT_EQ(bench->cell.memory.jobs.at(job_a).result, JobResult::tool);
            EXPECT_EQ(bench->cell.memory.jobs.at(job_a).last_block, 200U);
        }
        EXPECT_EQ(fine.cell.state_since_ms, coarse.cell.state_since_ms);
        EXPECT_EQ(fine.status().job_result, JobResult::tool);
    }
}

}  // namespace
}  // namespace qchopper
