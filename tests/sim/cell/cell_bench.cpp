#include "tests/sim/cell/cell_bench.h"

#include <gtest/gtest.h>

#include "sim/cell/panel.h"

namespace qchopper::bench {

Bench::Bench(CellLimits limits, CellMemory memory) {
    hooks.save = [this](const CellMemory& what) {
        if (can_save) saved.push_back(what);
        return can_save;
    };
    cell = boot(limits, std::move(memory), 42, now, hooks);
    cell.store_free_kib = 1000000;
}

AckResult Bench::send(Command command) {
    command.seq = ++seq;
    receive_command(cell, encode(command), now, hooks);
    EXPECT_EQ(cell.ack.seq, seq);
    return cell.ack.result;
}

AckResult Bench::send(CellCommand what, const Uuid& job, std::uint32_t token, std::uint32_t arg0) {
    Command command;
    command.command = what;
    command.epoch = cell.memory.epoch_held;
    command.owner = owner;
    command.job_id = job;
    command.token = token;
    command.arg0 = arg0;
    command.file_sha256 = good_digest();
    return send(command);
}

AckResult Bench::claim(std::uint32_t who, std::uint32_t whose_secret, std::uint32_t code) {
    Command command;
    command.command = CellCommand::claim;
    command.epoch = cell.memory.epoch_held + 1;
    command.owner = who;
    command.arg0 = code;
    command.arg1 = whose_secret;
    return send(command);
}

void Bench::write_ticket(const WireTicket& ticket) {
    cell.ticket_draft = encode(ticket);
}

void Bench::heartbeat() {
    receive_heartbeat(cell, encode(Heartbeat{cell.memory.epoch_held, owner, ++counter}), now);
}

void Bench::pass(std::int64_t ms) {
    for (std::int64_t done = 0; done < ms; done += 10) {
        now.steady_ms += 10;
        now.unix_ms += 10;
        pass_time(cell, now, hooks);
    }
}

void Bench::restart(PowerCut::Store store) {
    note_block(cell, now);
    const CellMemory kept = saved.empty() ? CellMemory{} : saved.back();
    cell = power_on(cell, memory_after(store, kept), 43, now, hooks);
}

void Bench::to_idle() {
    ASSERT_EQ(claim(), AckResult::ok);
    ASSERT_EQ(send(CellCommand::reset), AckResult::ok);
    pass(300);
    ASSERT_EQ(cell.state, PackState::idle);
}

void Bench::to_stored(const WireTicket& ticket) {
    to_idle();
    write_ticket(ticket);
    ASSERT_EQ(send(CellCommand::store, ticket.job_id), AckResult::ok);
}

void Bench::to_verified(const WireTicket& ticket) {
    to_stored(ticket);
    ASSERT_EQ(send(CellCommand::verify, ticket.job_id), AckResult::pending);
    file_checked(cell, cell.pending->number, {FileCheck::End::ok, ticket.file_size, ticket.file_sha256, program}, now,
                 hooks);
    ASSERT_EQ(cell.ack.result, AckResult::ok);
}

void Bench::to_prepared(const WireTicket& ticket) {
    to_verified(ticket);
    ASSERT_EQ(send(CellCommand::prepare, ticket.job_id), AckResult::pending);
    if (cell.limits.consent == Consent::ask) consent_given(cell, cell.pending->number, true, now, hooks);
    pass(10);
    ASSERT_EQ(cell.ack.result, AckResult::ok);
    ASSERT_NE(cell.job.token, 0U);
}

void Bench::to_running(const WireTicket& ticket) {
    to_prepared(ticket);
    ASSERT_EQ(send(CellCommand::start, ticket.job_id, cell.job.token), AckResult::ok);
}

}  // namespace qchopper::bench
