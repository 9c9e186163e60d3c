// The link between a real ModbusTcpBus and a real server goes wrong at START, in every way that the proxy knows: the
// job starts once, and the report says so.

#include "tests/sim/cell/fault_proxy.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <chrono>

#include "base/error.h"
#include "devices/wire/device_error.h"
#include "tests/devices/wire/loopback_server.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

using rig::LinkFault;
using rig::Way;

double seconds_of(const std::function<void()>& act) {
    const auto began = std::chrono::steady_clock::now();
    act();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

struct Behind {
    Behind() {
        std::filesystem::create_directory(drop);
        cell = std::make_unique<CellSim>(rig::quick_cell(drop));
        cell->start();
        proxy = std::make_unique<rig::TcpFaultProxy>(cell->port());
    }
    JobOutcome dispatch() const { return dispatch(rig::make_job(500, 20), rig::quick_dispatch(drop)); }
    JobOutcome dispatch(const rig::Job& job, const DispatchOptions& options) const {
        ModbusTcpBus bus({"127.0.0.1", proxy->port()});
        return dispatch_job(bus, job.ticket, job.file, options, {});
    }
    rig::Folder folder;
    std::filesystem::path drop = folder.path / "drop";
    std::unique_ptr<CellSim> cell;
    std::unique_ptr<rig::TcpFaultProxy> proxy;
};

void expect_one_start(LinkFault fault, std::int64_t number) {
    for (const Way way : {Way::to_cell, Way::to_pc}) {
        Behind behind;
        bool is_next = false;  // the answer after START
        behind.proxy->arm(way == Way::to_cell ? fault : LinkFault::none, Way::to_cell, number,
                          [&is_next](const Bytes& frame) {
                              is_next = rig::is_command(CellCommand::start)(frame);
                              return is_next;
                          });
        if (way == Way::to_pc) {
            behind.proxy->arm(fault, Way::to_pc, number, [&is_next](const Bytes&) { return is_next; });
        }
        const JobOutcome outcome = behind.dispatch();
        EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << rig::name(fault) << ": " << outcome.why;
        EXPECT_EQ(behind.cell->status().starts_total, 1U) << rig::name(fault);
    }
}

TEST(Fault, F06_F07_TheConnectionIsResetAtStartBeforeAndAfterItTookEffect) {
    expect_one_start(LinkFault::reset, 0);
}
TEST(Fault, F09_AStartThatComesTwiceStartsOnce) {
    expect_one_start(LinkFault::duplicate, 0);
}
TEST(Fault, F10_ARecordedFrameOnAnotherConnectionStartsNothing) {
    expect_one_start(LinkFault::replay, 0);
}
TEST(Fault, F03_F05_AStartOrItsAnswerIsLateOrGetsStuck) {
    expect_one_start(LinkFault::delay, 300);
    expect_one_start(LinkFault::hold, 1500);
    expect_one_start(LinkFault::merge, 0);
    expect_one_start(LinkFault::half_open, 0);
}
TEST(Fault, F13_AStartOrItsAnswerIsCutOff) {
    expect_one_start(LinkFault::drop_after, 9);
}
TEST(Fault, F04_F54_AStartOrItsAnswerComesByteByByte) {
    expect_one_start(LinkFault::split, 1);
}
TEST(Fault, F19_F20_AStartOrItsAnswerHasWrongBitsOrSwappedWords) {
    expect_one_start(LinkFault::flip_bit, 8 * 30 + 3);
    expect_one_start(LinkFault::swap_words, 0);
}

// Frame by frame on its way there or back; the cell verifies the hash of the whole file.
TEST(Fault, F39_ChunksThatAreLostDoubledLateOrDamagedMakeTheRightFile) {
    const auto is_chunk = [](const Bytes& frame) {
        return frame.size() > 10 && frame[7] == 16 && frame[8] == 1 && frame[9] == 44;
    };
    const std::pair<LinkFault, std::int64_t> faults[] = {{LinkFault::hold, 300}, {LinkFault::duplicate, 0},
                                                         {LinkFault::reset, 0},  {LinkFault::flip_bit, 8 * 40},
                                                         {LinkFault::replay, 0}, {LinkFault::drop_after, 20}};
    Behind behind;
    for (const auto& [fault, number] : faults) {
        behind.proxy->arm(fault, Way::to_cell, number, [is_chunk, chunks = 0](const Bytes& frame) mutable {
            return is_chunk(frame) && ++chunks == 3;
        });
    }
    const rig::Job job = rig::make_job(232 * 30 + 7, 20);
    const JobOutcome outcome = behind.dispatch(job, rig::quick_dispatch({}));
    EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << outcome.why;
    EXPECT_EQ(outcome.job_result, JobResult::complete);
    EXPECT_EQ(behind.cell->status().starts_total, 1U);
}

TEST(Fault, F08_AStartOfADeadConnectionThatComesAfterTheNextClaimIsStale) {
    Behind behind;
    behind.proxy->arm(LinkFault::hold, Way::to_cell, 4000, rig::is_command(CellCommand::start));
    EXPECT_EQ(behind.dispatch().start_outcome, StartOutcome::started);
    EXPECT_EQ(behind.cell->status().starts_total, 1U);
    std::this_thread::sleep_for(std::chrono::milliseconds(4500));
    EXPECT_EQ(behind.cell->status().starts_total, 1U);
}

// Nothing was sent: an error and a closed journal entry.
void expect_unreachable(std::uint16_t port) {
    const rig::Folder folder;
    std::filesystem::create_directory(folder.path / "drop");
    const rig::Job job = rig::make_job(500, 20);
    DispatchOptions options = rig::quick_dispatch(folder.path / "drop");
    std::vector<JournalEvent> events;
    options.journal = [&events](const JournalEvent& event) { events.push_back(event); };
    ModbusTcpBus bus({"127.0.0.1", port});
    try {
        dispatch_job(bus, job.ticket, job.file, options, {});
        ADD_FAILURE() << "something answered";
    } catch (const DeviceError& error) {
        EXPECT_EQ(error.fault, DeviceFault::unreachable) << error.what();
    }
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events.back().kind, JournalKind::closed);
    EXPECT_EQ(events.back().start_outcome, StartOutcome::not_started);
}

TEST(Fault, F01_NothingListensAndNothingIsSent) {
    const int taken = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const std::uint16_t port = bind_to_loopback(taken);  // bound, and nobody listens
    EXPECT_LT(seconds_of([&] { expect_unreachable(port); }), 3);
    close(taken);
}

TEST(Fault, F02_AConnectionThatIsNeverMadeEndsInTime) {
    const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const std::uint16_t port = bind_to_loopback(listener);
    ASSERT_EQ(listen(listener, 0), 0);
    std::vector<int> full;  // the queue of connections that nobody accepts: after it, SYN is dropped
    for (int i = 0; i < 4; ++i) {
        full.push_back(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(port);
        static_cast<void>(connect(full.back(), reinterpret_cast<sockaddr*>(&address), sizeof address));
    }
    const double took_s = seconds_of([&] { expect_unreachable(port); });
    EXPECT_GT(took_s, 1.5) << "the connection was not held up";
    EXPECT_LT(took_s, 4.5);
    for (const int fd : full) close(fd);
    close(listener);
}

}  // namespace
}  // namespace qchopper
