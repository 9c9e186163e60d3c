// Every command in every state, against a table that was written by hand from the documents, not from the code.

#include "devices/wire/packml.h"

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <memory>
#include <sstream>

#include "tests/sim/cell/cell_bench.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::job_a;
using bench::job_b;

// A number: OK, and the machine goes there. ok: OK and it stays. pe PENDING, al ALREADY, -- WRONG_STATE,
// bo BUSY_OTHER_JOB, af ALREADY_FINISHED, uj UNKNOWN_JOB. The cell has a prepared job in Idle; a finished one in
// Clearing, Stopped, Aborting, Aborted, Resetting and Complete; a running or held one elsewhere. STORE brings another
// job.
constexpr const char* expected_table = R"(
              Re St Sp Ho Uh Su Us Ab Cl Co  CL RE ST VE PR CA QU CR RH SM QF
1  Clearing   -- af -- -- -- -- -- 8  al --  ok ok bo af af af ok ok af -- ok
2  Stopped    15 af -- -- -- -- -- 8  al --  ok ok bo af af af ok ok af ok ok
3  Starting   -- al 7  10 -- -- -- 8  -- --  ok ok bo -- -- -- ok -- -- -- ok
4  Idle       al 3  -- -- -- -- -- 8  -- --  ok ok bo al al ok ok -- -- ok uj
5  Suspended  -- al 7  10 -- al 14 8  -- --  ok ok bo -- -- -- ok -- -- -- ok
6  Execute    -- al 7  10 -- 13 -- 8  -- 16  ok ok bo -- -- -- ok -- -- -- ok
7  Stopping   -- al al -- -- -- -- 8  -- --  ok ok bo -- -- -- ok -- -- -- ok
8  Aborting   -- af -- -- -- -- -- al -- --  ok ok bo af af af ok -- af -- ok
9  Aborted    -- af -- -- -- -- -- al pe --  ok ok bo af af af ok ok af ok ok
10 Holding    -- al 7  al -- -- -- 8  -- --  ok ok bo -- -- -- ok -- -- -- ok
11 Held       -- al 7  al pe -- -- 8  -- --  ok ok bo -- -- -- ok -- -- -- ok
12 Unholding  -- al 7  10 al -- -- 8  -- --  ok ok bo -- -- -- ok -- -- -- ok
13 Suspending -- al 7  10 -- al -- 8  -- --  ok ok bo -- -- -- ok -- -- -- ok
14 Unsuspending -- al 7 10 -- -- al 8 -- --  ok ok bo -- -- -- ok -- -- -- ok
15 Resetting  al af -- -- -- -- -- 8  -- --  ok ok bo af af af ok ok af -- ok
16 Completing -- al 7  -- -- -- -- 8  -- al  ok ok bo -- -- -- ok -- -- -- ok
17 Complete   15 af -- -- -- -- -- 8  -- --  ok ok bo af af af ok ok af -- ok
)";

std::array<std::array<std::string, 21>, last_pack_state + 1> expected() {
    std::array<std::array<std::string, 21>, last_pack_state + 1> table;
    std::istringstream in(expected_table);
    std::string word;
    for (int head = 0; head < 21; ++head) in >> word;
    for (std::uint16_t n = 1; n <= last_pack_state; ++n) {
        int number = 0;
        in >> number >> word;
        EXPECT_EQ(number, n);
        EXPECT_EQ(word, name(static_cast<PackState>(n)));
        for (std::string& cell : table[n]) in >> cell;
    }
    return table;
}

// A cell in `state` with the job that belongs there; nothing ends by itself.
std::unique_ptr<Bench> cell_in(PackState state) {
    CellLimits limits;
    limits.acting_ms = 1000000000;
    limits.consent = Consent::ask;
    auto whole = std::make_unique<Bench>();
    Bench& bench = *whole;
    bench.to_prepared();
    bench.cell.limits = limits;
    bench.cell.state = state;
    bench.cell.state_since_ms = bench.now.steady_ms;
    if (state == PackState::idle) return whole;
    const bool is_active = has_active_job(state);
    bench.cell.job.token = 0;
    bench.cell.job.state = is_active ? JobState::running : JobState::ended;
    bench.cell.memory.jobs[job_a].state = bench.cell.job.state;
    bench.cell.memory.jobs[job_a].starts = 1;
    bench.cell.memory.jobs[job_a].file_sha256 = bench::good_digest();
    return whole;
}

AckResult send(Bench& bench, CellCommand command) {
    switch (command) {
        case CellCommand::reset:
        case CellCommand::clear:
        case CellCommand::release:
            return bench.send(command);
        case CellCommand::set_mode:
            return bench.send(command, {}, 0, 2);
        case CellCommand::query_file:
            return bench.send(command);
        case CellCommand::claim:
            return bench.claim();
        case CellCommand::store:
            bench.write_ticket(bench::good_ticket(job_b));
            return bench.send(command, job_b);
        case CellCommand::start:
            return bench.send(command, job_a, bench.cell.job.token);
        default:
            return bench.send(command, job_a);
    }
}

AckResult result_of(const std::string& word) {
    if (word == "--") return AckResult::wrong_state;
    if (word == "al") return AckResult::already;
    if (word == "pe") return AckResult::pending;
    if (word == "bo") return AckResult::busy_other_job;
    if (word == "uj") return AckResult::unknown_job;
    if (word == "af") return AckResult::already_finished;
    return AckResult::ok;
}

TEST(Fault, F44_EveryCommandInEveryStateDoesWhatTheTableSays) {
    const auto table = expected();
    for (std::uint16_t n = 1; n <= last_pack_state; ++n) {
        for (std::size_t c = 0; c < all_commands.size(); ++c) {
            const auto whole = cell_in(static_cast<PackState>(n));
            Bench& bench = *whole;
            const std::string& word = table[n][c];
            const AckResult result = send(bench, all_commands[c]);
            const bool moves = std::isdigit(static_cast<unsigned char>(word[0])) != 0;
            const auto to = static_cast<PackState>(moves ? std::stoi(word) : n);
            EXPECT_EQ(name(result), std::string(name(result_of(word)))) << name(all_commands[c]) << " in " << n;
            EXPECT_EQ(name(bench.cell.state), std::string(name(to))) << name(all_commands[c]) << " in " << n;
        }
    }
}

TEST(Fault, F43_StartMovesNothingInAnyStateButIdle) {
    for (std::uint16_t n = 1; n <= last_pack_state; ++n) {
        if (static_cast<PackState>(n) == PackState::idle) continue;
        const auto whole = cell_in(PackState::idle);
        Bench& bench = *whole;
        bench.cell.state = static_cast<PackState>(n);
        EXPECT_EQ(bench.send(CellCommand::start, job_a, bench.cell.job.token), AckResult::wrong_state) << n;
        EXPECT_EQ(bench.cell.state, static_cast<PackState>(n));
        EXPECT_EQ(bench.cell.memory.starts_total, 0U);
    }
}

TEST(PackML, ActingStatesEndByThemselvesAndWaitingStatesDoNot) {
    const std::array<int, last_pack_state + 1> next{0, 2, 0, 6, 0, 0, 16, 2, 9, 0, 11, 0, 6, 5, 6, 4, 17, 0};
    for (std::uint16_t n = 0; n <= last_pack_state; ++n) {
        EXPECT_EQ(static_cast<int>(after_done(static_cast<PackState>(n))), next[n]) << n;
    }
}

TEST(PackML, NumbersThatAreNoStateOrNoCommandMeetARefusal) {
    for (const std::uint16_t n : {0, 18, 100, 65535}) {
        for (const CellCommand command : all_commands) {
            EXPECT_EQ(transition(static_cast<PackState>(n), command).kind, TransitionKind::refused)
                << n << name(command);
        }
    }
    for (std::uint16_t n = 1; n <= last_pack_state; ++n) {
        for (const std::uint16_t c : {0, 11, 99, 111, 65535}) {
            EXPECT_EQ(transition(static_cast<PackState>(n), static_cast<CellCommand>(c)).kind, TransitionKind::refused);
        }
    }
}

}  // namespace
}  // namespace qchopper
