// cell-sim and dispatch as programs of their own, with a link between them that can be unplugged: whichever is killed,
// unplugged or emptied at whatever moment, the next dispatch says the right word, and STARTS_TOTAL of the cell is
// right.

#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/cli/exit_code.h"
#include "tests/app/cli/program.h"
#include "tests/sim/cell/fault_proxy.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using program::Arguments;
using program::Ended;
using program::Process;
using rig::LinkFault;
using rig::Way;

// What dispatch prints in its course, in this order.
const std::vector<std::string> before_start = {"the cell is claimed", "the cell has accepted the ticket",
                                               "it is the right one", "waiting for consent"};
const std::vector<std::string> after_start = {"the job has started", "the cell is in Execute"};
const std::string consented = "has consented";  // START is under way

std::vector<std::string> all_moments() {
    std::vector<std::string> all = before_start;
    all.push_back(consented);
    all.insert(all.end(), after_start.begin(), after_start.end());
    return all;
}

bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

// A project, a cell with its memory, and the link between it and dispatch.
class Scene {
 public:
    Scene() {
        fs::copy(program::prepared() / "scan.qch", folder_.path / "p.qch", fs::copy_options::recursive);
        fs::create_directory(folder_.path / "drop");
        program::put(folder_.path / "asks.txt",
                     "consent ask\nwait for question\nwait 0.3\nconsent yes\nconsent auto\n");
        start_cell({"--script", "asks.txt"});
        proxy_ = std::make_unique<rig::TcpFaultProxy>(
            static_cast<std::uint16_t>(std::stoi(cell_at_.substr(cell_at_.find(':') + 1))));
        to_ = "127.0.0.1:" + std::to_string(proxy_->port());
    }

    void start_cell(const Arguments& more = {}) {
        Arguments arguments{"cell-sim", "--listen", cell_at_, "--drop", "drop", "--store", "store", "--speed", "300"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        cell_ = std::make_unique<Process>(arguments, program::RunOptions{folder_.path});
        EXPECT_TRUE(cell_->waits_until_out("\n")) << cell_->err();
        const std::string line = cell_->out();
        cell_at_ = line.substr(std::string("listening ").size(), line.find('\n') - std::string("listening ").size());
    }
    void kill_cell() {
        cell_->signal(SIGKILL);
        EXPECT_EQ(cell_->wait().killed_by, SIGKILL);
    }
    void restart_cell(bool is_emptied) {
        kill_cell();
        if (is_emptied) fs::remove_all(folder_.path / "store");
        start_cell();
    }
    void plug(bool is_plugged) { proxy_->set_plugged(is_plugged); }

    // START and all after it is swallowed in silence until heal(): START itself, or from its answer on.
    void swallow_from_start(bool also_start) {
        proxy_->arm(also_start ? LinkFault::half_open : LinkFault::none, Way::to_cell, 0, [this](const Bytes& frame) {
            if (rig::is_command(CellCommand::start)(frame)) swallows_ = true;
            return swallows_.load();
        });
        constexpr int connections = 100;
        for (int i = 0; i < connections; ++i) {
            proxy_->arm(LinkFault::half_open, Way::to_pc, 0, [this](const Bytes&) { return swallows_.load(); });
        }
    }
    void wait_until_start_is_swallowed() const {
        for (int i = 0; i < 40000 && !swallows_; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(3));
        EXPECT_TRUE(swallows_);
    }
    void wait_until_started() const {
        for (int i = 0; i < 600 && starts_total() == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
        EXPECT_EQ(starts_total(), 1);
    }
    void heal() { swallows_ = false; }

    Arguments dispatch_arguments(const Arguments& more = {"--piece", "C"}) const {
        Arguments arguments{"dispatch", "p.qch", "--drop", "drop", "--to", to_};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }
    std::unique_ptr<Process> begin(const std::string& until, const Arguments& more = {"--piece", "C"}) const {
        auto dispatch = std::make_unique<Process>(dispatch_arguments(more), program::RunOptions{folder_.path});
        EXPECT_TRUE(until.empty() || dispatch->waits_until_err(until)) << dispatch->err();
        return dispatch;
    }
    Ended dispatch(const Arguments& more = {"--piece", "C"}) const { return run(dispatch_arguments(more)); }
    Ended accept_store() const { return run({"cell", "accept-store", "--to", to_}); }

    // Asked past the proxy.
    int starts_total() const {
        return Json::parse(run({"cell", "status", "--json", "--to", cell_at_}).out)["store"]["starts_total"];
    }
    // The files of the journal; a copy of them put back is a journal that lost its last rows.
    program::Contents journal() const {
        program::Contents files;
        for (const char* name : {"journal.sqlite", "journal.sqlite-wal"}) {
            files[name] = program::bytes_in(journal_folder() / name);
        }
        return files;
    }
    void put_back(const program::Contents& old) const {
        const fs::path folder = journal_folder();
        fs::remove_all(folder);
        fs::create_directory(folder);
        for (const auto& [name, bytes] : old) program::put(folder / name, bytes);
    }
    void expect_sound_journal() const { EXPECT_EQ(run({"journal", "verify"}).code, 0); }

 private:
    Ended run(const Arguments& arguments) const { return program::run(arguments, {folder_.path}); }
    fs::path journal_folder() const {
        return Json::parse(run({"journal", "show", "--json"}).out)["journals"][0]["folder"].get<std::string>();
    }

    program::Folder folder_;
    std::string cell_at_ = "127.0.0.1:0";
    std::string to_;
    std::unique_ptr<Process> cell_;
    std::atomic<bool> swallows_ = false;
    std::unique_ptr<rig::TcpFaultProxy> proxy_;  // its thread uses swallows_
};

void expect_ended(const Ended& ended, int code, const std::vector<std::string>& words) {
    EXPECT_EQ(ended.code, code) << ended.out << ended.err;
    for (const std::string& word : words) EXPECT_TRUE(has(ended.out, word)) << word << "\n" << ended.out << ended.err;
}

void kill(Process& process) {
    process.signal(SIGKILL);
    process.wait();
}

// A scene for each moment; all at once, because most of the time each waits.
void at_each(const std::vector<std::string>& moments,
             const std::function<void(Scene& scene, const std::string& moment)>& act) {
    program::prepared();
    std::vector<std::jthread> threads;
    for (const std::string& moment : moments) {
        threads.emplace_back([&] {
            SCOPED_TRACE(moment);
            Scene scene;
            act(scene, moment);
            scene.expect_sound_journal();
        });
    }
}

TEST(Resumed, ADispatchThatIsKilledAtAnyMomentIsTakenUp) {
    at_each(all_moments(), [](Scene& scene, const std::string& moment) {
        kill(*scene.begin(moment));
        expect_ended(scene.dispatch(), exit_done, {"STARTED", "all 1 jobs ended complete"});
        EXPECT_EQ(scene.starts_total(), 1);
    });
}

TEST(Resumed, AJournalThatLostItsLastRowsIsNoReasonToSayNotStarted) {
    at_each({before_start[0], before_start[1], before_start[3], consented},
            [](Scene& scene, const std::string& moment) {
                const auto dispatch = scene.begin(moment);
                const program::Contents old = scene.journal();
                expect_ended(dispatch->wait(), exit_done, {"STARTED", "all 1 jobs ended complete"});
                scene.put_back(old);
                scene.plug(false);
                const Ended unplugged = scene.dispatch();
                EXPECT_EQ(unplugged.code, exit_unreachable);
                EXPECT_FALSE(has(unplugged.out + unplugged.err, "NOT STARTED")) << unplugged.out << unplugged.err;
                scene.plug(true);
                const Ended next = scene.dispatch();
                expect_ended(next, exit_done, {" STARTED ", "all 1 jobs ended complete"});
                EXPECT_FALSE(has(next.out, "NOT STARTED")) << next.out << next.err;
                EXPECT_EQ(scene.starts_total(), 1);
            });
}

TEST(Resumed, ACellThatIsKilledBeforeTheStartGetsTheJobWhenItIsBack) {
    at_each(before_start, [](Scene& scene, const std::string& moment) {
        const auto dispatch = scene.begin(moment);
        scene.restart_cell(false);
        expect_ended(dispatch->wait(), exit_done, {"STARTED", "all 1 jobs ended complete"});
        EXPECT_EQ(scene.starts_total(), 1);
    });
}

TEST(Resumed, ACellThatIsKilledAfterTheStartMillsOnlyAgainOnRequest) {
    at_each(after_start, [](Scene& scene, const std::string& moment) {
        const auto dispatch = scene.begin(moment);
        scene.restart_cell(false);
        expect_ended(dispatch->wait(), exit_demand_broken, {" STARTED ", "power loss"});
        expect_ended(scene.dispatch(), exit_demand_broken, {"NOT STARTED", "power loss", "--again"});
        EXPECT_EQ(scene.starts_total(), 1);
        expect_ended(scene.dispatch({"--piece", "C", "--again"}), exit_done, {"all 1 jobs ended complete"});
        EXPECT_EQ(scene.starts_total(), 2);
    });
}

TEST(Resumed, BothKilledAfterTheStart) {
    at_each(after_start, [](Scene& scene, const std::string& moment) {
        kill(*scene.begin(moment));
        scene.restart_cell(false);
        expect_ended(scene.dispatch(), exit_demand_broken, {" STARTED ", "power loss"});
        EXPECT_EQ(scene.starts_total(), 1);
    });
}

TEST(Resumed, UnpluggedAtAnyMomentItGoesOnWhenItIsPluggedAgain) {
    at_each(all_moments(), [](Scene& scene, const std::string& moment) {
        const auto dispatch = scene.begin(moment);
        scene.plug(false);
        std::this_thread::sleep_for(std::chrono::seconds(1));
        scene.plug(true);
        expect_ended(dispatch->wait(), exit_done, {"STARTED", "all 1 jobs ended complete"});
        EXPECT_EQ(scene.starts_total(), 1);
    });
}

TEST(Resumed, UnpluggedAndStoppedBeforeTheStartItHasNotStarted) {
    at_each(before_start, [](Scene& scene, const std::string& moment) {
        const auto dispatch = scene.begin(moment);
        scene.plug(false);
        dispatch->signal(SIGINT);
        expect_ended(dispatch->wait(), exit_interrupted, {"NOT STARTED"});
        EXPECT_EQ(scene.starts_total(), 0);
        scene.plug(true);
        expect_ended(scene.dispatch(), exit_done, {"STARTED", "all 1 jobs ended complete"});
        EXPECT_EQ(scene.starts_total(), 1);
    });
}

TEST(Resumed, AStartedJobIsStartedAlsoWhileTheCellCannotBeAsked) {
    at_each(after_start, [](Scene& scene, const std::string& moment) {
        kill(*scene.begin(moment));
        scene.plug(false);
        const Ended unplugged = scene.dispatch();
        EXPECT_EQ(unplugged.code, exit_unreachable);
        EXPECT_TRUE(has(unplugged.err, "this dispatch started no job. The job ")) << unplugged.err;
        EXPECT_TRUE(has(unplugged.err, " has STARTED")) << unplugged.err;
        scene.plug(true);
        expect_ended(scene.dispatch(), exit_done, {"STARTED", "all 1 jobs ended complete"});
        EXPECT_EQ(scene.starts_total(), 1);
    });
}

// By its own patience, and on request.
TEST(Resumed, AStartWithoutAnswerIsUnknownUntilTheCellCanBeAsked) {
    at_each({"START lost", "answer lost", "START lost, stopped", "answer lost, stopped"},
            [](Scene& scene, const std::string& what) {
                scene.swallow_from_start(what.starts_with("START"));
                const auto dispatch = scene.begin("");
                scene.wait_until_start_is_swallowed();
                // START is seen before it is passed on.
                if (!what.starts_with("START")) scene.wait_until_started();
                scene.plug(false);
                const bool is_stopped = what.ends_with("stopped");
                if (is_stopped) dispatch->signal(SIGINT);
                const int code = is_stopped ? exit_interrupted : exit_demand_broken;
                expect_ended(dispatch->wait(), code, {"UNKNOWN: ask the cell"});
                const Ended unplugged = scene.dispatch();
                EXPECT_EQ(unplugged.code, exit_unreachable);
                EXPECT_TRUE(has(unplugged.err, "has started is UNKNOWN: ask the cell")) << unplugged.err;
                EXPECT_EQ(scene.starts_total(), what.starts_with("START") ? 0 : 1);
                scene.heal();
                scene.plug(true);
                expect_ended(scene.dispatch(), exit_done, {"STARTED", "all 1 jobs ended complete"});
                EXPECT_EQ(scene.starts_total(), 1);
            });
}

TEST(Resumed, ACellThatIsEmptiedBeforeTheStartIsAcceptedAndGetsTheJob) {
    at_each(before_start, [](Scene& scene, const std::string& moment) {
        const auto dispatch = scene.begin(moment);
        scene.restart_cell(true);
        expect_ended(dispatch->wait(), exit_demand_broken, {"NOT STARTED", "CELL_STORE_LOST"});
        expect_ended(scene.dispatch(), exit_demand_broken, {"NOT STARTED", "CELL_STORE_LOST", "accept-store"});
        EXPECT_EQ(scene.starts_total(), 0);
        EXPECT_EQ(scene.accept_store().code, 0);
        expect_ended(scene.dispatch(), exit_done, {"STARTED", "all 1 jobs ended complete"});
        EXPECT_EQ(scene.starts_total(), 1);
    });
}

TEST(Resumed, ACellThatIsEmptiedAfterTheStartDoesNotMillThePieceOnceMoreUnasked) {
    at_each(after_start, [](Scene& scene, const std::string& moment) {
        const bool is_killed = moment == after_start.back();
        const auto dispatch = scene.begin(moment);
        if (is_killed) kill(*dispatch);
        scene.restart_cell(true);
        const Ended first = is_killed ? scene.dispatch() : dispatch->wait();
        expect_ended(first, exit_demand_broken, {" STARTED ", "CELL_STORE_LOST"});
        expect_ended(scene.dispatch(), exit_demand_broken, {" STARTED ", "CELL_STORE_LOST", "accept-store"});
        const Ended accepted = scene.accept_store();
        EXPECT_EQ(accepted.code, 0);
        EXPECT_TRUE(has(accepted.err, " has STARTED")) << accepted.err;
        expect_ended(scene.dispatch(), exit_demand_broken, {"NOT STARTED", "by the journal", "--again"});
        EXPECT_EQ(scene.starts_total(), 0);
        expect_ended(scene.dispatch({"--piece", "C", "--again"}), exit_done, {"all 1 jobs ended complete"});
        EXPECT_EQ(scene.starts_total(), 1);
    });
}

TEST(Resumed, ACellThatIsEmptiedWhileStartIsUnderWayIsUnknown) {
    at_each({"START lost", "answer lost"}, [](Scene& scene, const std::string& what) {
        scene.swallow_from_start(what.starts_with("START"));
        const auto dispatch = scene.begin("");
        scene.wait_until_start_is_swallowed();
        scene.kill_cell();
        scene.heal();
        scene.restart_cell(true);
        expect_ended(dispatch->wait(), exit_demand_broken, {"UNKNOWN: ask the cell", "CELL_STORE_LOST"});
        expect_ended(scene.dispatch(), exit_demand_broken, {"UNKNOWN: ask the cell", "CELL_STORE_LOST"});
        EXPECT_EQ(scene.starts_total(), 0);
        const Ended accepted = scene.accept_store();  // the operator has looked
        EXPECT_EQ(accepted.code, 0);
        EXPECT_TRUE(has(accepted.err, "warning: ")) << accepted.err;
        EXPECT_TRUE(has(accepted.err, "UNKNOWN")) << accepted.err;
        EXPECT_TRUE(has(accepted.err, "--again")) << accepted.err;
        expect_ended(scene.dispatch(), exit_demand_broken, {"NOT STARTED", "UNKNOWN", "--again"});
        EXPECT_EQ(scene.starts_total(), 0) << "nobody has asked for a second time";
        expect_ended(scene.dispatch({"--piece", "C", "--again"}), exit_done, {"STARTED", "all 1 jobs ended complete"});
        EXPECT_EQ(scene.starts_total(), 1);
        EXPECT_TRUE(has(scene.dispatch().out, "the cell has carved this file before"));
        EXPECT_EQ(scene.starts_total(), 1);
    });
}

// A dispatch that was killed before START: with the memory of the cell gone, its journal is the only witness, and it
// may have lost its last rows.
TEST(Resumed, AJobThatWasOpenWhenTheCellLostItsMemoryIsMilledOnlyWithAgain) {
    at_each({before_start[1]}, [](Scene& scene, const std::string& moment) {
        kill(*scene.begin(moment));
        scene.restart_cell(true);
        expect_ended(scene.dispatch(), exit_demand_broken, {"UNKNOWN: ask the cell", "CELL_STORE_LOST"});
        EXPECT_TRUE(has(scene.accept_store().err, "--again"));
        expect_ended(scene.dispatch(), exit_demand_broken, {"NOT STARTED", "UNKNOWN", "--again"});
        EXPECT_EQ(scene.starts_total(), 0);
        expect_ended(scene.dispatch({"--piece", "C", "--again"}), exit_done, {"all 1 jobs ended complete"});
    });
}

TEST(Resumed, AQueueGoesOnWithThePieceThatWasUnderWayAndEndsWithTheOthers) {
    at_each({"the job has started"}, [](Scene& scene, const std::string& moment) {
        const auto dispatch = scene.begin(moment, {});
        EXPECT_TRUE(dispatch->waits_until_err("piece D")) << dispatch->err();
        kill(*dispatch);
        const Ended rest = scene.dispatch({});
        expect_ended(rest, exit_done, {"all 3 jobs ended complete"});
        EXPECT_FALSE(has(rest.out, "to do")) << rest.out;
        EXPECT_EQ(scene.starts_total(), 3);
    });
}

}  // namespace
}  // namespace qchopper
