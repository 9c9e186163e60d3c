// The whole hand-off over real TCP on loopback; the reference is the cell's own STARTS_TOTAL and memory of jobs.

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "base/error.h"
#include "devices/hand_off/first_contact.h"
#include "devices/wire/device_error.h"
#include "sim/cell/script.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

using rig::connect;
using rig::Folder;
using rig::Job;
using rig::make_job;
using rig::quick_cell;
using rig::quick_dispatch;

// A quick cell with a drop folder and a store of its own, and a way to dispatch jobs to it.
struct Rig {
    explicit Rig(CellSimOptions given = {}) : cell_options(std::move(given)) {
        std::filesystem::create_directories(drop);
        CellSimOptions quick = quick_cell(drop);
        cell_options.drop_folder = drop;
        cell_options.store_folder = folder.path / "store";
        cell_options.limits.speed = quick.limits.speed;
        cell_options.limits.acting_ms = quick.limits.acting_ms;
        restart();
        cell_options.port = cell->port();
    }
    // Off and on again: the same address, and the memory in the store.
    void restart() {
        cell.reset();
        cell = std::make_unique<CellSim>(cell_options);
        cell->start();
    }
    JobOutcome dispatch(const Job& job, const DispatchOptions& options, const Context& context = {}) const {
        const auto bus = connect(*cell);
        return dispatch_job(*bus, job.ticket, job.file, options, context);
    }
    Folder folder;
    std::filesystem::path drop = folder.path / "drop";
    CellSimOptions cell_options;
    std::unique_ptr<CellSim> cell;
};

std::string whole(const JobOutcome& outcome) {
    std::string text = std::string(describe(outcome.start_outcome)) + ": " + outcome.why + "\n";
    for (const std::string& line : outcome.log) text += line + "\n";
    return text;
}

void expect_complete(const JobOutcome& outcome) {
    EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << whole(outcome);
    EXPECT_EQ(outcome.job_state, JobState::ended) << whole(outcome);
    EXPECT_EQ(outcome.job_result, JobResult::complete);
    EXPECT_EQ(outcome.starts, 1U);
    EXPECT_TRUE(outcome.starts_known);
    EXPECT_TRUE(outcome.is_complete());
}

TEST(HandOffOverTcp, AJobRunsToItsEndAndStartsOnce) {
    const Rig rig;
    const Job job = make_job();
    std::vector<std::size_t> progress;
    Context context;
    context.on_progress = [&](const Progress& now) { progress.push_back(now.done); };
    const JobOutcome outcome = rig.dispatch(job, quick_dispatch(rig.drop), context);
    expect_complete(outcome);
    EXPECT_TRUE(outcome.simulated);
    EXPECT_EQ(outcome.cell_id, any_cell_id);
    EXPECT_NEAR(outcome.elapsed_s, 20, 0.01);
    const Status after = rig.cell->status();
    EXPECT_EQ(after.starts_total, 1U);
    EXPECT_EQ(after.state, PackState::idle);
    EXPECT_EQ(after.job_id, Uuid{});
    EXPECT_FALSE(after.has(flag::lease_held));
    EXPECT_TRUE(std::filesystem::exists(rig.drop / "piece-1.qjob"));
    ASSERT_GE(progress.size(), 2U);
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    EXPECT_LT(progress.front(), progress.back());
}

TEST(HandOffOverTcp, JobsFollowOneAnotherEachWithAStartOfItsOwn) {
    const Rig rig;
    const Job job = make_job(100, 2);
    for (std::uint32_t n = 1; n <= 3; ++n) {
        expect_complete(rig.dispatch(job, quick_dispatch(rig.drop)));
        EXPECT_EQ(rig.cell->status().starts_total, n);
    }
}

TEST(HandOffOverTcp, WithoutADropFolderTheFileGoesInChunks) {
    const Rig rig;
    const Job job = make_job(100001, 2);
    expect_complete(rig.dispatch(job, quick_dispatch({})));
    EXPECT_TRUE(std::filesystem::is_empty(rig.drop));
}

TEST(HandOffOverTcp, ARehearsalComesBeforeTheStart) {
    const Rig rig;
    const Job job = make_job(100, 2);
    DispatchOptions options = quick_dispatch(rig.drop);
    options.rehearse = true;
    expect_complete(rig.dispatch(job, options));
}

TEST(HandOffOverTcp, WithoutConsentNothingStartsAndTheReportNamesTheReason) {
    CellSimOptions options;
    options.limits.consent = Consent::never;
    const Rig rig(options);
    const Job job = make_job();
    const JobOutcome outcome = rig.dispatch(job, quick_dispatch(rig.drop));
    EXPECT_EQ(outcome.start_outcome, StartOutcome::not_started) << whole(outcome);
    EXPECT_EQ(outcome.refusal, AckResult::no_consent);
    EXPECT_NE(outcome.why.find("did not consent"), std::string::npos) << outcome.why;
    EXPECT_FALSE(outcome.to_do.empty());
    EXPECT_EQ(rig.cell->status().starts_total, 0U);
    EXPECT_EQ(rig.cell->status().job_id, Uuid{});
    EXPECT_FALSE(rig.cell->status().has(flag::lease_held));
}

TEST(HandOffOverTcp, TheOperatorIsAskedAndMayTakeTime) {
    CellSimOptions options;
    options.limits.consent = Consent::ask;
    std::string asked;
    options.ask = [&asked](const std::string& question) {
        asked = question;
        std::this_thread::sleep_for(std::chrono::milliseconds(1200));
        return true;
    };
    const Rig rig(options);
    const Job job = make_job(100, 2);
    expect_complete(rig.dispatch(job, quick_dispatch(rig.drop)));
    EXPECT_NE(asked.find("piece-1.qjob"), std::string::npos) << asked;
}

TEST(HandOffOverTcp, NobodyAnswersTheQuestionInTime) {
    CellSimOptions options;
    options.limits.consent = Consent::ask;
    options.ask = [](const std::string&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));
        return true;  // too late: nothing may come of it
    };
    const Rig rig(options);
    const Job job = make_job(100, 2);
    DispatchOptions quick = quick_dispatch(rig.drop);
    quick.timings.consent_s = 0.3;
    const JobOutcome outcome = rig.dispatch(job, quick);
    EXPECT_EQ(outcome.start_outcome, StartOutcome::not_started) << whole(outcome);
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    EXPECT_EQ(rig.cell->status().starts_total, 0U);
    EXPECT_EQ(rig.cell->status().job_state, JobState::none);
}

TEST(HandOffOverTcp, AFileThatTheCellDoesNotFindIsNamed) {
    const Rig rig;
    const Job job = make_job();
    std::filesystem::create_directories(rig.folder.path / "elsewhere");
    const JobOutcome outcome = rig.dispatch(job, quick_dispatch(rig.folder.path / "elsewhere"));
    EXPECT_EQ(outcome.start_outcome, StartOutcome::not_started) << whole(outcome);
    EXPECT_EQ(outcome.refusal, AckResult::file_missing);
    EXPECT_EQ(rig.cell->status().starts_total, 0U);
}

TEST(HandOffOverTcp, AFileChangedOnTheWayIsRefused) {
    // Somebody overwrites the file in the drop folder as soon as it is there.
    const Rig rig;
    const Job job = make_job();
    DispatchOptions options = quick_dispatch(rig.drop);
    options.journal = [&](const JournalEvent& event) {
        if (event.kind == JournalKind::command && event.command == CellCommand::verify) {
            std::fstream file(rig.drop / "piece-1.qjob", std::ios::in | std::ios::out | std::ios::binary);
            file.put('!');
        }
    };
    const JobOutcome outcome = rig.dispatch(job, options);
    EXPECT_EQ(outcome.start_outcome, StartOutcome::not_started) << whole(outcome);
    EXPECT_EQ(outcome.refusal, AckResult::hash_mismatch);
    EXPECT_EQ(rig.cell->status().starts_total, 0U);
}

TEST(HandOffOverTcp, AFileOtherThanItsTicketIsNotEvenSent) {
    const Rig rig;
    Job job = make_job();
    job.ticket.file_sha256.bytes[0] ^= 1;
    EXPECT_THROW(rig.dispatch(job, quick_dispatch(rig.drop)), InputError);
    job = make_job();
    job.file.clear();
    EXPECT_THROW(rig.dispatch(job, quick_dispatch(rig.drop)), InputError);
    EXPECT_EQ(rig.cell->status().ack_seq, 0U);
}

TEST(HandOffOverTcp, AJobBeyondTheReachIsRefusedWithTheReason) {
    CellSimOptions options;
    options.limits.workspace = {{-10, -10, 0}, {10, 10, 10}};
    const Rig rig(options);
    const Job job = make_job();
    const JobOutcome outcome = rig.dispatch(job, quick_dispatch(rig.drop));
    EXPECT_EQ(outcome.start_outcome, StartOutcome::not_started);
    EXPECT_EQ(outcome.refusal, AckResult::envelope) << whole(outcome);
    EXPECT_NE(outcome.why.find("reach"), std::string::npos);
}

TEST(HandOffOverTcp, NothingListensIsAnErrorWithinTwoAndAHalfSeconds) {
    std::uint16_t port = 0;
    const Folder folder;
    {
        CellSim cell(quick_cell(folder.path));
        cell.start();
        port = cell.port();
    }
    const Job job = make_job();
    const auto began = std::chrono::steady_clock::now();
    ModbusTcpBus bus({"127.0.0.1", port});
    try {
        dispatch_job(bus, job.ticket, job.file, quick_dispatch(folder.path), {});
        FAIL() << "nobody listened";
    } catch (const DeviceError& error) {
        EXPECT_EQ(error.fault, DeviceFault::unreachable);
        EXPECT_FALSE(error.to_do.empty());
    }
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::milliseconds(2500));
}

DeviceFault fault_of(const Rig& rig, const DispatchOptions& options) {
    const Job job = make_job(100, 2);
    try {
        const JobOutcome outcome = rig.dispatch(job, options);
        ADD_FAILURE() << whole(outcome);
    } catch (const DeviceError& error) {
        return error.fault;
    }
    return DeviceFault::protocol;
}

TEST(HandOffOverTcp, AnotherCellThanTheOneWantedIsRefusedBeforeAnythingIsSent) {
    const Rig rig;
    DispatchOptions options = quick_dispatch(rig.drop);
    options.cell_id = 7;
    EXPECT_EQ(fault_of(rig, options), DeviceFault::refused);
    options = quick_dispatch(rig.drop);
    options.want_simulated = false;
    EXPECT_EQ(fault_of(rig, options), DeviceFault::refused);
    EXPECT_EQ(rig.cell->status().ack_seq, 0U);
    EXPECT_TRUE(std::filesystem::is_empty(rig.drop));
}

TEST(HandOffOverTcp, ASecondDispatcherFindsTheCellBusy) {
    const Rig rig;
    const Job job = make_job(100, 100);
    std::atomic<bool> second_was_refused = false;
    bool asked = false;
    Context context;
    context.on_progress = [&](const Progress&) {
        if (asked) return;
        asked = true;
        const Job other_job = make_job();
        try {
            rig.dispatch(other_job, quick_dispatch(rig.drop));
        } catch (const DeviceError& error) {
            second_was_refused = error.fault == DeviceFault::busy;
        }
    };
    expect_complete(rig.dispatch(job, quick_dispatch(rig.drop), context));
    EXPECT_TRUE(second_was_refused);
    EXPECT_EQ(rig.cell->status().starts_total, 1U);
}

TEST(HandOffOverTcp, QueriesOfAnotherClientOvertakeTheAcknowledgementsAndNothingIsDoneTwice) {
    const Rig rig;
    const Job job = make_job(100, 20);
    std::atomic<bool> ends = false;
    std::thread other([&] {
        const auto bus = connect(*rig.cell);
        Command query;
        query.command = CellCommand::query;
        query.owner = 4711;
        query.job_id = Uuid{9};
        while (!ends) {
            ++query.seq;
            EXPECT_TRUE(bus->write_holding(command_block.base, encode(query)).is_ok());
            std::this_thread::sleep_for(std::chrono::milliseconds(7));
        }
    });
    DispatchOptions options = quick_dispatch(rig.drop);
    options.timings.resend_s = 0.02;
    const JobOutcome outcome = rig.dispatch(job, options);
    ends = true;
    other.join();
    expect_complete(outcome);
    EXPECT_EQ(rig.cell->status().starts_total, 1U);
}

void turn_power(CellSim& cell, const std::string& how) {
    for (const ScriptLine& line : parse_script("power " + how + "\n", "test")) cell.perform(line);
}

TEST(HandOffOverTcp, TheFirstStatusIsAskedForAgainAndWhatFailedIsNamed) {
    const Rig rig;
    turn_power(*rig.cell, "off");  // it closes each connection at once
    ModbusTcpBus bus({"127.0.0.1", rig.cell->port()});
    try {
        read_first_status(bus, "cell-1", {});
        FAIL() << "the cell was off";
    } catch (const DeviceError& error) {
        EXPECT_EQ(error.fault, DeviceFault::unreachable);
        EXPECT_NE(std::string(error.what()).find("cell-1: the cell does not answer"), std::string::npos)
            << error.what();
    }
    std::thread leaving([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(600));
        turn_power(*rig.cell, "on");
    });
    const std::optional<Status> status = read_first_status(bus, "cell-1", {});
    leaving.join();
    ASSERT_TRUE(status.has_value());
    EXPECT_TRUE(status->has(flag::simulated));
}

// Read again within the two seconds of the first contact, whichever bit is wrong: MAGIC and VERSION too.
TEST(HandOffOverTcp, AFlippedBitInTheFirstStatusIsReadAgain) {
    const Rig rig;
    const auto arm = [&](std::size_t bit, int times) {
        const std::string line = "fault flip-status " + std::to_string(bit) + " times " + std::to_string(times);
        rig.cell->perform(*parse_script_line(line, 1, "test"));
    };
    const auto bus = connect(*rig.cell);
    for (std::size_t bit = 0; bit < 16 * status_block.count; ++bit) {
        arm(bit, 1);
        EXPECT_TRUE(read_first_status(*bus, "cell-1", {}).has_value()) << bit;
    }
    for (const std::size_t bit : {0U, 15U, 24U, 40U, 1500U, 1536U, 1590U}) {
        arm(bit, 4);
        EXPECT_TRUE(read_first_status(*bus, "cell-1", {}).has_value()) << bit;
        rig.cell->perform(*parse_script_line("fault clear", 1, "test"));
    }
}

TEST(HandOffOverTcp, AskedToStopBeforeTheFirstStatusThereIsNone) {
    const Rig rig;
    const std::atomic<bool> cancelled = true;
    Context context;
    context.cancelled = &cancelled;
    const auto bus = connect(*rig.cell);
    EXPECT_FALSE(read_first_status(*bus, "cell-1", context).has_value());
    const Job job = make_job();
    const JobOutcome outcome = rig.dispatch(job, quick_dispatch(rig.drop), context);
    EXPECT_EQ(outcome.start_outcome, StartOutcome::not_started);
    EXPECT_TRUE(outcome.cancelled);
    EXPECT_EQ(rig.cell->status().ack_seq, 0U);
}

TEST(HandOffOverTcp, AJobIdThatHasRunIsTakenUpAndNotStartedAgain) {
    const Rig rig;
    const Job job = make_job(100, 2);
    DispatchOptions options = quick_dispatch(rig.drop);
    options.job_id = Uuid{1, 2, 3};
    expect_complete(rig.dispatch(job, options));
    expect_complete(rig.dispatch(job, options));
    EXPECT_EQ(rig.cell->status().starts_total, 1U);
    const Job other = make_job(200, 2);
    const JobOutcome outcome = rig.dispatch(other, options);
    EXPECT_EQ(outcome.start_outcome, StartOutcome::not_started) << whole(outcome);
    EXPECT_EQ(outcome.refusal, AckResult::job_id_reused);
    EXPECT_EQ(rig.cell->status().starts_total, 1U);
}

TEST(HandOffOverTcp, CancelledBeforeTheStartTheCellConfirmsThatItDroppedTheJob) {
    CellSimOptions cell_options;
    cell_options.limits.consent = Consent::ask;
    cell_options.ask = [](const std::string&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(800));
        return true;
    };
    const Rig rig(cell_options);
    const Job job = make_job();
    std::atomic<bool> cancelled = false;
    Context context;
    context.cancelled = &cancelled;
    context.on_message = [&](const std::string& line) {
        if (line.find("waiting for consent") != std::string::npos) cancelled = true;
    };
    const JobOutcome outcome = rig.dispatch(job, quick_dispatch(rig.drop), context);
    EXPECT_EQ(outcome.start_outcome, StartOutcome::not_started) << whole(outcome);
    EXPECT_TRUE(outcome.cancelled);
    EXPECT_NE(whole(outcome).find("the cell has dropped the job"), std::string::npos) << whole(outcome);
    EXPECT_EQ(rig.cell->status().job_state, JobState::none);
    EXPECT_EQ(rig.cell->status().starts_total, 0U);
}

TEST(HandOffOverTcp, CancelledWhileItRunsTheJobRunsOnByItself) {
    const Rig rig;
    const Job job = make_job(100, 100);
    std::atomic<bool> cancelled = false;
    Context context;
    context.cancelled = &cancelled;
    context.on_progress = [&](const Progress&) { cancelled = true; };
    const JobOutcome outcome = rig.dispatch(job, quick_dispatch(rig.drop), context);
    EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << whole(outcome);
    EXPECT_TRUE(outcome.cancelled);
    EXPECT_NE(outcome.why.find("runs on"), std::string::npos) << outcome.why;
    EXPECT_EQ(rig.cell->status().job_state, JobState::running);
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    EXPECT_EQ(rig.cell->status().job_state, JobState::ended);
}

TEST(HandOffOverTcp, CancelledWithStopTheMachineStops) {
    const Rig rig;
    const Job job = make_job(100, 1000);
    std::atomic<bool> cancelled = false;
    Context context;
    context.cancelled = &cancelled;
    context.on_progress = [&](const Progress&) { cancelled = true; };
    DispatchOptions options = quick_dispatch(rig.drop);
    options.stop_when_cancelled = true;
    const JobOutcome outcome = rig.dispatch(job, options, context);
    EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << whole(outcome);
    EXPECT_EQ(outcome.job_state, JobState::aborted) << whole(outcome);
    EXPECT_EQ(outcome.job_result, JobResult::stopped);
    EXPECT_FALSE(outcome.is_complete());
    EXPECT_EQ(outcome.starts, 1U);
}

TEST(HandOffOverTcp, ACellRestartedWhileTheJobRunsReportsThePowerCut) {
    Rig rig;
    const Job job = make_job(100, 100000);
    bool restarted = false;
    Context context;
    context.on_progress = [&](const Progress&) {
        if (!restarted) rig.restart();
        restarted = true;
    };
    const JobOutcome outcome = rig.dispatch(job, quick_dispatch(rig.drop), context);
    EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << whole(outcome);
    EXPECT_EQ(outcome.job_state, JobState::aborted) << whole(outcome);
    EXPECT_EQ(outcome.job_result, JobResult::power_loss);
    EXPECT_EQ(outcome.starts, 1U);
    EXPECT_EQ(rig.cell->status().starts_total, 1U);
    EXPECT_EQ(rig.cell->status().boot_count, 2U);
    EXPECT_EQ(rig.cell->status().state, PackState::aborted);
    // The next job needs the machine cleared, to which the cell's operator consents here.
    expect_complete(rig.dispatch(make_job(100, 2), quick_dispatch(rig.drop)));
    EXPECT_EQ(rig.cell->status().starts_total, 2U);
}

TEST(HandOffOverTcp, ALinkLostAtAnyStepEndsWithARightReportAndOneStart) {
    // The connection is cut once, just before the action of the n-th row of the journal.
    for (int cut_at = 1; cut_at <= 12; ++cut_at) {
        Rig rig;
        DispatchOptions options = quick_dispatch(rig.drop);
        int rows = 0;
        options.journal = [&](const JournalEvent&) {
            if (++rows == cut_at + 2) rig.restart();
        };
        const JobOutcome outcome = rig.dispatch(make_job(100, 2), options);
        EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << cut_at << whole(outcome);
        EXPECT_EQ(rig.cell->status().starts_total, 1U) << cut_at << whole(outcome);
        EXPECT_EQ(outcome.starts, 1U) << cut_at << whole(outcome);
    }
}

}  // namespace
}  // namespace qchopper
