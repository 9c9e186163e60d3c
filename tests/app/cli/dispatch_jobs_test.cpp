// The simulated cell as a program of its own, and dispatch to it.

#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>

#include "app/cli/exit_code.h"
#include "base/files/file.h"
#include "base/sha256.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using program::Arguments;
using program::Ended;
using program::Process;

struct DispatchJobs : ::testing::Test {
    program::Folder folder;
    std::unique_ptr<Process> cell;

    void SetUp() override {
        fs::copy(program::prepared() / "scan.qch", folder.path / "p.qch", fs::copy_options::recursive);
        fs::create_directory(folder.path / "drop");
    }
    // Where it listens.
    std::string start_cell(const std::string& consent, const std::string& typed = "") {
        cell = std::make_unique<Process>(Arguments{"cell-sim", "--listen", "127.0.0.1:0", "--drop", "drop", "--speed",
                                                   "100000", "--consent", consent},
                                         program::RunOptions{folder.path, typed});
        return program::address_of(*cell);
    }
    Ended dispatch(const std::string& to, const Arguments& more = {"--piece", "C"}) const {
        Arguments arguments{"dispatch", "p.qch", "--to", to, "--drop", "drop"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return program::run(arguments, {folder.path});
    }
    void expect_cell_stops() {
        cell->signal(SIGTERM);
        EXPECT_EQ(cell->wait().code, 0);
    }
    static bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }
};

TEST_F(DispatchJobs, EveryJobEndsAndTheReportSaysThatTheCellIsSimulated) {
    const std::string to = start_cell("auto");
    const Ended ended = dispatch(to, {});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(has(ended.err, "SIMULATED: nothing moves")) << ended.err;
    EXPECT_TRUE(has(ended.out, "all 3 jobs ended complete on the simulated cell")) << ended.out;
    expect_cell_stops();
}

TEST_F(DispatchJobs, ACellThatNeverConsentsStartsNothing) {
    const std::string to = start_cell("never");
    const Ended ended = dispatch(to);
    EXPECT_EQ(ended.code, exit_demand_broken) << ended.err;
    EXPECT_TRUE(has(ended.out, "NOT STARTED")) << ended.out;
    EXPECT_TRUE(has(ended.out, "did not consent")) << ended.out;
    expect_cell_stops();
}

TEST_F(DispatchJobs, TheOperatorIsAskedAndSaysYes) {
    const std::string to = start_cell("ask", "y\n");
    const Ended ended = dispatch(to);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(has(cell->err(), "[y/N]")) << cell->err();
    EXPECT_TRUE(has(cell->err(), "C.qjob")) << "the question names the job: " << cell->err();
    expect_cell_stops();
}

TEST_F(DispatchJobs, TheOperatorIsAskedAndSaysNo) {
    const std::string to = start_cell("ask", "n\n");
    const Ended ended = dispatch(to);
    EXPECT_EQ(ended.code, exit_demand_broken) << ended.err;
    EXPECT_TRUE(has(ended.out, "NOT STARTED")) << ended.out;
    expect_cell_stops();
}

TEST_F(DispatchJobs, WithoutAnybodyToAskThereIsNoConsent) {
    const std::string to = start_cell("ask");
    const Ended ended = dispatch(to);
    EXPECT_EQ(ended.code, exit_demand_broken) << ended.err;
    expect_cell_stops();
}

TEST_F(DispatchJobs, ACellOfAnotherKindThanIsExpectedGetsNothing) {
    const std::string to = start_cell("auto");
    const Ended real = dispatch(to, {"--piece", "C", "--expect", "real", "--yes"});
    EXPECT_EQ(real.code, exit_demand_broken);
    EXPECT_TRUE(has(real.err, "is SIMULATED, and a real one is expected")) << real.err;
    EXPECT_TRUE(has(real.out, "no job was sent")) << real.out;
    EXPECT_TRUE(fs::is_empty(folder.path / "drop"));
    EXPECT_EQ(dispatch(to, {"--piece", "C", "--expect", "simulated"}).code, 0);
    EXPECT_EQ(dispatch(to, {"--expect", "neither"}).code, exit_use);
    expect_cell_stops();
}

TEST_F(DispatchJobs, OnlyTheJobOfTheseBytesIsSent) {
    const std::string to = start_cell("auto");
    const auto sha256_of = [&](const std::string& piece) {
        const Bytes bytes = read_file(folder.path / "p.qch" / "jobs" / (piece + ".qjob"));
        return to_hex(sha256(bytes));
    };
    const Ended other = dispatch(to, {"--piece", "C", "--job", sha256_of("D")});
    EXPECT_EQ(other.code, exit_demand_broken);
    EXPECT_TRUE(has(other.err, "no job of piece C has the SHA-256 " + sha256_of("D"))) << other.err;
    const Ended sent = dispatch(to, {"--job", sha256_of("D")});
    EXPECT_EQ(sent.code, 0) << sent.err;
    EXPECT_TRUE(has(sent.out, "all 1 jobs ended complete")) << sent.out;
    EXPECT_TRUE(has(sent.out, "\nD ")) << sent.out;
    EXPECT_EQ(dispatch(to, {"--job", "12ab"}).code, exit_use);
    expect_cell_stops();
}

TEST_F(DispatchJobs, AddressAndDropFolderMayComeFromTheCellFile) {
    const std::string to = start_cell("auto");
    const fs::path cell_file = folder.path / "p.qch" / "cell.toml";
    std::string text = program::bytes_in(cell_file);
    text.replace(text.find("127.0.0.1:15020"), 15, to);
    text.replace(text.find("drop = \"drop\""), 13, "drop = \"../drop\"");
    program::put(cell_file, text);
    const Ended ended = program::run({"dispatch", "p.qch", "--piece", "C"}, {folder.path});
    EXPECT_EQ(ended.code, 0) << ended.err;
    expect_cell_stops();
}

}  // namespace
}  // namespace qchopper
