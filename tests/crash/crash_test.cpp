// kill -9 of a dispatcher at named points, then one of ten things that a cell may do, then the next dispatcher.
//
// The judge is the cell: STARTS_TOTAL is 1 at the end, whatever happened in between: no job is lost, none is started
// twice. What the second dispatcher reports has to agree with it. The journal lies on a memory file system if there is
// one: that it is synced is the subject of sync_order_test.cpp.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <functional>
#include <sstream>
#include <thread>

#include "devices/hand_off/cell_control.h"
#include "devices/hand_off/first_contact.h"
#include "devices/journal/journal.h"
#include "sim/cell/script.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr std::array points{"after_created",           "after_read_identity",   "after_identity",
                            "after_stage_file",        "before_claim_intent",   "after_claim_intent",
                            "after_claim_sent",        "after_query_intent",    "after_query_sent",
                            "after_query_file_intent", "after_query_file_sent", "after_reset_intent",
                            "after_reset_sent",        "after_write_ticket",    "after_write_signature",
                            "after_store_intent",      "after_store_sent",      "after_put_file",
                            "after_verify_intent",     "after_verify_sent",     "after_prepare_intent",
                            "after_prepare_sent",      "before_start_intent",   "after_start_intent",
                            "after_start_sent",        "before_started",        "after_started",
                            "before_result",           "after_result",          "after_clear_result_intent",
                            "after_clear_result_sent", "after_release_intent",  "after_release_sent",
                            "before_closed",           "after_closed"};
static_assert(points.size() >= 20);

struct Ran {
    int killed_by = 0;
    std::string out;
};

// The folder of one trial: state of both sides in memory, if the computer has such a file system.
class TrialFolder {
 public:
    TrialFolder() {
        std::string name = (fs::exists("/dev/shm") ? "/dev/shm" : "/tmp") + std::string("/qchopper-crash-XXXXXX");
        if (::mkdtemp(name.data()) != nullptr) path = name;
    }
    ~TrialFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    TrialFolder(const TrialFolder&) = delete;
    TrialFolder& operator=(const TrialFolder&) = delete;
    fs::path path;
};

class Trial {
 public:
    Trial() {
        fs::create_directories(drop());
        options_ = rig::quick_cell(drop());
        options_.store_folder = folder_.path / "store";
        options_.limits.takeover_code = 4711;
        restart();
    }

    fs::path drop() const { return folder_.path / "drop"; }
    fs::path state() const { return folder_.path / "state"; }
    CellSim& cell() { return *cell_; }

    void restart() {
        cell_.reset();
        cell_ = std::make_unique<CellSim>(options_);
        cell_->start();
        options_.port = cell_->port();
    }

    Ran dispatch(const std::string& point) {
        int ends[2];
        EXPECT_EQ(::pipe2(ends, O_CLOEXEC), 0);
        std::vector<std::string> words{QCHOPPER_DISPATCH_ONCE, std::to_string(cell_->port()), state().string(),
                                       drop().string()};
        if (!point.empty()) words.push_back(point);
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        const pid_t pid = ::fork();
        if (pid == 0) {
            ::dup2(ends[1], STDOUT_FILENO);
            ::execv(argv[0], argv.data());
            ::_exit(127);
        }
        ::close(ends[1]);
        Ran ran;
        char buffer[512];
        for (ssize_t got = 0; (got = ::read(ends[0], buffer, sizeof buffer)) > 0;) {
            ran.out.append(buffer, static_cast<std::size_t>(got));
        }
        ::close(ends[0]);
        int status = 0;
        ::waitpid(pid, &status, 0);
        ran.killed_by = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        return ran;
    }

    // Of another program beside the dispatchers.
    void control(CellCommand command) {
        const auto bus = rig::connect(*cell_);
        ControlOrder order;
        order.command = command;
        order.takeover_code = 4711;
        const HandOffInput input = read_status_block(*bus);
        if (input.status) control_cell(*bus, *input.status, order, {});
    }

    void perform(const std::string& line) {
        const std::vector<ScriptLine> script = parse_script(line + "\n", "test");
        for (const ScriptLine& one : script) cell_->perform(one);
    }

 private:
    TrialFolder folder_;
    CellSimOptions options_;
    std::unique_ptr<CellSim> cell_;
};

void wait_ms(int ms) {
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

// What the cell does after the kill.
using CellStep = std::function<void(Trial&)>;

void expect_one_start(const CellStep& step) {
    for (const char* point : points) {
        Trial trial;
        const Ran killed = trial.dispatch(point);
        ASSERT_EQ(killed.killed_by, SIGKILL) << point << " was never passed\n" << killed.out;
        step(trial);
        const Ran ran = trial.dispatch("");
        ASSERT_EQ(ran.killed_by, 0) << point;
        const Status status = trial.cell().status();
        EXPECT_EQ(status.starts_total, 1U) << point << "\n" << ran.out;
        EXPECT_EQ(ran.out.find("error"), std::string::npos) << point << "\n" << ran.out;
        EXPECT_EQ(ran.out.find("UNKNOWN"), std::string::npos) << point << "\n" << ran.out;
        // "NOT STARTED" is right for a file that was carved before, by the job that was started then.
        const bool says_started = ran.out.find("\nSTARTED|") != std::string::npos || ran.out.starts_with("STARTED|");
        const bool says_milled = ran.out.find("|0|1\n") != std::string::npos;
        EXPECT_TRUE(says_started || says_milled) << point << "\n" << ran.out;
        EXPECT_EQ(read_journal(trial.state()).rows.back().event.kind, JournalKind::closed) << point;
        const Ran again = trial.dispatch("");
        EXPECT_EQ(trial.cell().status().starts_total, 1U) << point << "\n" << again.out;
        EXPECT_NE(again.out.find("|0|1\n"), std::string::npos) << point << "\n" << again.out;
    }
}

TEST(Fault, F25_KilledAtAnyPointAndTheCellDoesNothing) {
    expect_one_start([](Trial&) {});
}
TEST(Fault, F25_KilledAtAnyPointAndTheCellGoesOnForAWhile) {
    expect_one_start([](Trial&) { wait_ms(100); });
}
TEST(Fault, F61_KilledAtAnyPointAndTheCellRestarts) {
    expect_one_start([](Trial& trial) { trial.restart(); });
}
TEST(Fault, F61_KilledAtAnyPointAndTheCellRestartsTwice) {
    expect_one_start([](Trial& trial) {
        wait_ms(30);
        trial.restart();
        trial.restart();
    });
}
TEST(Fault, F25_KilledAtAnyPointAndTheEmergencyStopIsPressed) {
    expect_one_start([](Trial& trial) {
        trial.perform("estop press");
        wait_ms(30);
        trial.perform("estop release");
    });
}
TEST(Fault, F25_KilledAtAnyPointAndTheDoorIsOpened) {
    expect_one_start([](Trial& trial) {
        trial.perform("door open");
        wait_ms(30);
        trial.perform("door closed");
    });
}
TEST(Fault, F25_KilledAtAnyPointAndThePanelTakesControl) {
    expect_one_start([](Trial& trial) {
        trial.perform("panel local");
        wait_ms(30);
        trial.perform("panel remote");
    });
}
TEST(Fault, F25_KilledAtAnyPointAndSomebodyStopsTheJob) {
    expect_one_start([](Trial& trial) { trial.control(CellCommand::stop); });
}
TEST(Fault, F25_KilledAtAnyPointAndAnotherDispatcherTakesOver) {
    expect_one_start([](Trial& trial) { trial.control(CellCommand::claim); });
}
TEST(Fault, F25_KilledAtAnyPointAndSomebodyAborts) {
    expect_one_start([](Trial& trial) { trial.control(CellCommand::abort); });
}

TEST(Crash, EveryPointIsPassedInOneDispatch) {
    Trial trial;
    const Ran ran = trial.dispatch("?");
    for (const char* point : points) {
        EXPECT_NE(ran.out.find("point " + std::string(point) + "\n"), std::string::npos) << point << "\n" << ran.out;
    }
}

TEST(Fault, F24_KilledAfterStartAndTheCellComesBackEmpty) {
    for (const char* point : {"after_prepare_sent", "after_start_intent", "after_start_sent", "after_started"}) {
        Trial trial;
        ASSERT_EQ(trial.dispatch(point).killed_by, SIGKILL);
        wait_ms(50);
        const std::uint32_t starts_before = trial.cell().status().starts_total;
        fs::remove_all(trial.drop().parent_path() / "store");
        trial.restart();
        const Ran ran = trial.dispatch("");
        EXPECT_EQ(trial.cell().status().starts_total, 0U) << point << "\n" << ran.out;
        EXPECT_TRUE(ran.out.find("UNKNOWN: ask the cell") != std::string::npos || starts_before == 1) << point << "\n"
                                                                                                      << ran.out;
        EXPECT_EQ(ran.out.find("NOT STARTED"), std::string::npos) << point << "\n" << ran.out;
    }
}

}  // namespace
}  // namespace qchopper
