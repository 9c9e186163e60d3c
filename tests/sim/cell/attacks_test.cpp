// A hand-off that begins during an attack by 50 hostile clients, and an abort during it. Outcomes are asserted, not
// times: those are in bench/link.

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "devices/hand_off/cell_control.h"
#include "devices/hand_off/first_contact.h"
#include "tests/sim/cell/attackers.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

constexpr int hostile = 50;

struct UnderAttack : testing::TestWithParam<rig::AttackName> {
    UnderAttack() {
        CellSimOptions options = rig::quick_cell(drop.path);
        options.limits.speed = 1;
        cell = std::make_unique<CellSim>(options);
        cell->start();
    }

    // Until each attacker has connected, and something was sent where something is sent.
    static void wait_for(const rig::Attackers& attackers) {
        const rig::AttackKind kind = GetParam().kind;
        const bool sends = kind != rig::AttackKind::idle && kind != rig::AttackKind::connect_and_reset;
        for (int n = 0; n < 10000; ++n) {
            if (attackers.connections() >= hostile && (!sends || attackers.bytes() >= hostile)) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        ADD_FAILURE() << "the attack did not begin";
    }

    // Sends Abort as another program does, once the job runs.
    ControlEnd abort_when_it_runs() const {
        for (int n = 0; n < 60000 && cell->status().starts_total == 0; ++n) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        const auto bus = rig::connect(*cell);
        const std::optional<Status> status = read_first_status(*bus, "the cell", {});
        ControlOrder order;
        order.command = CellCommand::abort;
        return control_cell(*bus, *status, order, {});
    }

    void hand_off(bool from_one_address, const std::filesystem::path& folder) {
        const rig::Attackers attackers(GetParam().kind, cell->port(), hostile, from_one_address);
        wait_for(attackers);
        ControlEnd abort;
        std::jthread other([&] { abort = abort_when_it_runs(); });
        const rig::Job job = rig::make_job(30000, 3600);
        const auto bus = rig::connect(*cell);
        const JobOutcome outcome = dispatch_job(*bus, job.ticket, job.file, rig::quick_dispatch(folder), {});
        other.join();
        std::string log = outcome.why + "\n";
        for (const std::string& line : outcome.log) log += line + "\n";
        EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << log;
        EXPECT_EQ(outcome.job_result, JobResult::aborted) << log;
        EXPECT_EQ(abort.kind, CommandEnd::done) << abort.why;
        EXPECT_EQ(cell->status().starts_total, 1U);
    }

    rig::Folder drop;
    std::unique_ptr<CellSim> cell;
};

TEST_P(UnderAttack, AJobStartsAndIsAborted) {
    hand_off(false, drop.path);
}

TEST_P(UnderAttack, AJobInChunksStartsAndIsAborted) {
    hand_off(false, {});
}

// No limit for one address can tell them apart: only who gives its place does.
TEST_P(UnderAttack, AJobStartsAndIsAbortedThoughAllComeFromTheAddressOfTheGoodClient) {
    hand_off(true, drop.path);
}

INSTANTIATE_TEST_SUITE_P(Server, UnderAttack, testing::ValuesIn(rig::all_attacks), [](const auto& one) {
    std::string name = one.param.name;
    std::ranges::replace(name, ' ', '_');
    return name;
});

}  // namespace
}  // namespace qchopper
