// Signals at any moment: with --json one whole document, whatever ends the program; the simulated cell ends within a
// second; a limit of the size of files is an ordinary error.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/cli/exit_code.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using program::Arguments;
using program::Ended;
using program::Process;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

void sleep_ms(int ms) {
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

void expect_one_document(const Ended& ended, int code) {
    EXPECT_EQ(ended.killed_by, 0);
    EXPECT_EQ(ended.code, code) << ended.err;
    const json document = json::parse(ended.out, nullptr, false);
    ASSERT_TRUE(document.is_object()) << "'" << ended.out << "' " << ended.err;
    EXPECT_EQ(document["schema"], "qchopper-error-1");
    EXPECT_EQ(document["exit_code"], code);
    EXPECT_NE(document["error"], "");
    EXPECT_NE(document["unchanged"], "");
}

struct Signals : ::testing::Test {
    program::Folder folder;
    std::unique_ptr<Process> cell;
    std::string to;

    void start_cell(const Arguments& more = {}) {
        fs::create_directory(folder.path / "drop");
        Arguments arguments{"cell-sim", "--listen", "127.0.0.1:0", "--drop", "drop"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        cell = std::make_unique<Process>(arguments, program::RunOptions{folder.path});
        to = program::address_of(*cell);
    }
    // A cell that accepts connections and never answers.
    void start_mute_cell() {
        start_cell();
        cell->signal(SIGSTOP);
    }
    Arguments dispatch() const { return {"dispatch", "p.qch", "--to", to, "--drop", "drop", "--yes", "--json"}; }
    void copy_project() const {
        fs::copy(program::prepared() / "scan.qch", folder.path / "p.qch", fs::copy_options::recursive);
        fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply");
    }
};

TEST_F(Signals, AnEarlyOneLeavesOneDocument) {
    copy_project();
    start_mute_cell();
    Arguments prepare = program::prepare_arguments("scan.ply");
    prepare.insert(prepare.end(), {"-o", "q.qch", "--json"});
    for (const Arguments& arguments : {prepare, dispatch(), Arguments{"cell", "status", "--to", to, "--json"}}) {
        for (const int ms : {0, 20, 300}) {
            fs::remove_all(folder.path / "q.qch");
            Process running(arguments, {folder.path});
            ASSERT_TRUE(running.waits_until_signals_are_caught());
            sleep_ms(ms);
            running.signal(SIGTERM);
            expect_one_document(running.wait(), exit_terminated);
        }
    }
}

// The first one is being answered when the second comes.
TEST_F(Signals, ASecondOneLeavesOneDocument) {
    copy_project();
    start_mute_cell();
    for (const int ms : {0, 1, 20}) {
        Process running(dispatch(), {folder.path});
        ASSERT_TRUE(running.waits_until_signals_are_caught());
        sleep_ms(200);
        running.signal(SIGINT);
        sleep_ms(ms);
        running.signal(SIGINT);
        expect_one_document(running.wait(), exit_interrupted);
    }
}

TEST_F(Signals, HangingUpIsAStopToo) {
    copy_project();
    start_mute_cell();
    Process running(dispatch(), {folder.path});
    ASSERT_TRUE(running.waits_until_signals_are_caught());
    sleep_ms(200);
    running.signal(SIGHUP);
    expect_one_document(running.wait(), exit_hung_up);
}

TEST_F(Signals, EndASimulatedCellInTheMiddleOfAVirtualWait) {
    program::put(folder.path / "long.txt", "clock virtual\nwait 1000000000\n");
    for (const int number : {SIGTERM, SIGINT, SIGHUP}) {
        start_cell({"--script", "long.txt"});
        sleep_ms(300);
        const Clock::time_point began = Clock::now();
        cell->signal(number);
        const Ended ended = cell->wait(20);
        EXPECT_EQ(ended.code, exit_done) << number << " " << ended.err;
        EXPECT_LT(seconds_since(began), 5) << number;  // one second where nothing else runs
    }
}

TEST_F(Signals, WhatNohupIgnoresStaysIgnored) {
    ::signal(SIGHUP, SIG_IGN);
    start_cell();
    ::signal(SIGHUP, SIG_DFL);
    cell->signal(SIGHUP);
    sleep_ms(300);
    EXPECT_TRUE(program::run({"cell", "status", "--to", to}, {folder.path}).code == 0);
    cell->signal(SIGTERM);
    EXPECT_EQ(cell->wait().code, exit_done);
}

// Of a terminal that is not the controlling one, no signal tells that it was closed.
TEST_F(Signals, ASimulatedCellEndsWithItsTerminal) {
    const int master = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    ASSERT_GE(master, 0);
    ASSERT_EQ(::grantpt(master), 0);
    ASSERT_EQ(::unlockpt(master), 0);
    const std::string name = ::ptsname(master);
    const std::string drop = folder.path.string();
    const pid_t pid = ::fork();
    if (pid == 0) {
        ::setsid();
        const int terminal = ::open(name.c_str(), O_RDWR | O_NOCTTY);
        for (int descriptor = 0; descriptor < 3; ++descriptor) ::dup2(terminal, descriptor);
        ::execl(QCHOPPER_PROGRAM, QCHOPPER_PROGRAM, "cell-sim", "--listen", "127.0.0.1:0", "--drop", drop.c_str(),
                nullptr);
        ::_exit(127);
    }
    char line[256];
    ASSERT_GT(::read(master, line, sizeof line), 0) << "it says where it listens";
    ::close(master);
    int status = 0;
    pid_t ended = 0;
    for (int n = 0; n < 500 && ended == 0; ++n) {
        sleep_ms(20);
        ended = ::waitpid(pid, &status, WNOHANG);
    }
    EXPECT_EQ(ended, pid) << "it outlives its terminal";
    if (ended != pid) {
        ::kill(pid, SIGKILL);
        ::waitpid(pid, &status, 0);
    }
    EXPECT_TRUE(WIFEXITED(status));
}

TEST_F(Signals, ALimitOfTheSizeOfFilesIsAnErrorOfWriting) {
    const Ended sampled =
        program::run({"sample", "vertebra", "--faces", "3000", "-o", "v.ply"}, {folder.path, {}, false, {}, 20'000});
    EXPECT_EQ(sampled.killed_by, 0);
    EXPECT_EQ(sampled.code, exit_io) << sampled.err;
    EXPECT_NE(sampled.err.find("v.ply cannot be written"), std::string::npos) << sampled.err;
    EXPECT_TRUE(fs::is_empty(folder.path)) << "nothing is left half-written";
    const Ended listed = program::run({"cell-sim", "--list-faults"}, {folder.path, {}, false, {}, 1'000});
    EXPECT_EQ(listed.code, exit_io) << listed.err;
    EXPECT_NE(listed.err.find("standard output cannot be written"), std::string::npos) << listed.err;
}

}  // namespace
}  // namespace qchopper
