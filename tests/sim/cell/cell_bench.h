// A controller without a server: commands go straight into the machine, and the test sets the time.

#pragma once

#include <string>
#include <vector>

#include "sim/cell/machine.h"
#include "tests/sim/cell/good_ticket.h"

namespace qchopper::bench {

constexpr std::uint32_t owner = 0x11111111;
constexpr std::uint32_t secret = 0x22222222;
constexpr Uuid job_b{0xB, 1, 2, 3};

struct Bench {
    explicit Bench(CellLimits limits = {}, CellMemory memory = {});
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    // Sends a command of `owner` under the present epoch; returns its acknowledgement.
    AckResult send(CellCommand command, const Uuid& job = {}, std::uint32_t token = 0, std::uint32_t arg0 = 0);
    AckResult send(Command command);
    AckResult claim(std::uint32_t who = owner, std::uint32_t whose_secret = secret, std::uint32_t code = 0);
    void write_ticket(const WireTicket& ticket);
    void heartbeat();
    void pass(std::int64_t ms);                                    // in steps of 10 ms, without heartbeats
    void restart(PowerCut::Store store = PowerCut::Store::stays);  // cuts the power now

    // The ways to a stored, verified, prepared, running job.
    void to_idle();
    void to_stored(const WireTicket& ticket = good_ticket());
    void to_verified(const WireTicket& ticket = good_ticket());
    void to_prepared(const WireTicket& ticket = good_ticket());
    void to_running(const WireTicket& ticket = good_ticket());
    Status status() const { return status_of(cell, now); }

    ReceivedProgram program;  // found in each job file that is verified from now on
    CellTime now{1000000, 1700000000000};
    CellHooks hooks;
    std::vector<CellMemory> saved;
    bool can_save = true;
    CellState cell;
    std::uint32_t seq = 0;
    std::uint16_t counter = 0;
};

}  // namespace qchopper::bench
