// A request to stop while the cell is frozen or silent, over real TCP: the hand-off ends within two seconds.

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/devices/wire/loopback_server.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

using rig::Folder;
using rig::Job;
using rig::make_job;
using rig::RawSocket;

// Between the dispatcher and the cell. Once frozen, STATUS no longer changes, and what is written is answered but has
// no effect. Once silent, nothing is answered.
class FreezingRelay {
 public:
    explicit FreezingRelay(std::uint16_t cell_port) : cell_port_(cell_port) {}
    std::uint16_t port() const { return server_.port; }

    std::atomic<bool> is_frozen = false;
    std::atomic<bool> is_silent = false;
    std::atomic<int> swallowed_commands = 0;

 private:
    static Bytes take(int fd, std::size_t count) {
        Bytes bytes(count);
        const ssize_t got = recv(fd, bytes.data(), count, MSG_WAITALL);
        return got == static_cast<ssize_t>(count) ? bytes : Bytes{};
    }

    void serve(int fd) {
        const RawSocket cell(cell_port_);
        for (;;) {
            Bytes request = take(fd, 6);
            if (request.empty()) return;
            const Bytes rest = take(fd, request[5] + 256U * request[4]);
            if (rest.empty()) return;
            request.insert(request.end(), rest.begin(), rest.end());
            if (is_silent) continue;
            const Bytes answer = is_frozen ? frozen_answer(request) : pass_on(cell, request);
            send(fd, answer.data(), answer.size(), MSG_NOSIGNAL);
        }
    }

    Bytes pass_on(const RawSocket& cell, const Bytes& request) {
        cell.send(request);
        Bytes answer = cell.receive(6);
        if (answer.size() < 6) return {};
        const Bytes rest = cell.receive(answer[5] + 256U * answer[4]);
        answer.insert(answer.end(), rest.begin(), rest.end());
        if (request[7] == 4 && request[9] == 0) status_ = answer;
        return answer;
    }

    Bytes frozen_answer(const Bytes& request) {
        Bytes answer = status_;
        if (request[7] == 16) {
            answer = Bytes(request.begin(), request.begin() + 12);
            answer[4] = 0;
            answer[5] = 6;
            swallowed_commands += request[9] == 0 ? 1 : 0;
        }
        answer[0] = request[0];
        answer[1] = request[1];
        return answer;
    }

    std::uint16_t cell_port_;
    Bytes status_;
    LoopbackServer server_{[this](int fd, int) { serve(fd); }};  // last: it uses the others
};

struct Left {
    JobOutcome outcome;
    double after_s = 0;  // from the request to stop to the end
    int swallowed = 0;
};

// Freezes the cell, or makes it silent, when the hand-off reports `at`, and requests to stop `wait_s` after that.
Left stop_in_standstill(const std::string& at, double wait_s, bool silent = false) {
    const Folder folder;
    CellSimOptions cell_options = rig::quick_cell(folder.path / "drop");
    std::filesystem::create_directories(cell_options.drop_folder);
    cell_options.limits.consent = at.find("consent") != std::string::npos ? Consent::ask : Consent::automatic;
    cell_options.ask = [](const std::string&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        return false;
    };
    CellSim cell(cell_options);
    cell.start();
    FreezingRelay relay(cell.port());
    const Job job = make_job(100, 100000);
    std::atomic<bool> cancelled = false;
    std::chrono::steady_clock::time_point asked;
    std::thread signal;
    Context context;
    context.cancelled = &cancelled;
    context.on_message = [&](const std::string& line) {
        if (line.find(at) == std::string::npos || signal.joinable()) return;
        (silent ? relay.is_silent : relay.is_frozen) = true;
        signal = std::thread([&] {
            std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
            asked = std::chrono::steady_clock::now();
            cancelled = true;
        });
    };
    ModbusTcpBus bus({"127.0.0.1", relay.port()});
    Left left;
    left.outcome = dispatch_job(bus, job.ticket, job.file, rig::quick_dispatch(folder.path / "drop"), context);
    left.after_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - asked).count();
    EXPECT_TRUE(signal.joinable()) << "it never reported " << at;
    if (signal.joinable()) signal.join();
    left.swallowed = relay.swallowed_commands;
    return left;
}

TEST(HandOffLeave, AFrozenCellIsLeftBeforeTheStart) {
    const Left left = stop_in_standstill("waiting for consent", 3.2);
    EXPECT_LT(left.after_s, 2.2);
    EXPECT_EQ(left.outcome.start_outcome, StartOutcome::not_started) << left.outcome.why;
    EXPECT_TRUE(left.outcome.cancelled);
    EXPECT_GE(left.swallowed, 2);  // CANCEL and RELEASE
    EXPECT_NE(left.outcome.why.find("did not confirm"), std::string::npos) << left.outcome.why;
}

TEST(HandOffLeave, AFrozenCellIsLeftWhileTheJobRuns) {
    const Left left = stop_in_standstill("the job has started", 3.2);
    EXPECT_LT(left.after_s, 2.2);
    EXPECT_EQ(left.outcome.start_outcome, StartOutcome::started) << left.outcome.why;
    EXPECT_TRUE(left.outcome.cancelled);
    EXPECT_GE(left.swallowed, 1);  // RELEASE
}

TEST(HandOffLeave, ASilentCellIsLeftBeforeAndAfterTheStart) {
    for (const double wait_s : {0.1, 1.7}) {
        const Left before = stop_in_standstill("waiting for consent", wait_s, true);
        EXPECT_LT(before.after_s, 2.2);
        EXPECT_EQ(before.outcome.start_outcome, StartOutcome::not_started) << before.outcome.why;
        const Left running = stop_in_standstill("the job has started", wait_s, true);
        EXPECT_LT(running.after_s, 2.2);
        EXPECT_EQ(running.outcome.start_outcome, StartOutcome::started) << running.outcome.why;
    }
}

}  // namespace
}  // namespace qchopper
