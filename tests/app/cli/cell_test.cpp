// Journal and commands to a cell, with cell-sim and dispatch as programs of their own.

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/cli/arguments/option_values.h"
#include "app/cli/exit_code.h"
#include "base/text.h"
#include "devices/journal/journal.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using program::Arguments;
using program::Ended;
using program::Process;

struct CellCommands : ::testing::Test {
    program::Folder folder;
    std::unique_ptr<Process> cell;
    std::string to = "127.0.0.1:0";

    void SetUp() override {
        fs::copy(program::prepared() / "scan.qch", folder.path / "p.qch", fs::copy_options::recursive);
        fs::create_directory(folder.path / "drop");
    }
    // At the same address each time, with the memory in the folder `store`.
    void start_cell(const std::string& speed, const Arguments& more = {}) {
        Arguments arguments{"cell-sim", "--listen", to, "--drop", "drop", "--store", "store", "--speed", speed};
        arguments.insert(arguments.end(), more.begin(), more.end());
        cell = std::make_unique<Process>(arguments, program::RunOptions{folder.path});
        to = program::address_of(*cell);
    }
    void stop_cell() {
        cell->signal(SIGTERM);
        EXPECT_EQ(cell->wait().code, 0);
    }
    Ended run(Arguments arguments, bool has_address = true) const {
        if (has_address) arguments.insert(arguments.end(), {"--to", to});
        return program::run(arguments, {folder.path});
    }
    Ended dispatch(const Arguments& more = {}) const {
        Arguments arguments{"dispatch", "p.qch", "--piece", "C", "--drop", "drop"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    Json status() const { return Json::parse(run({"cell", "status", "--json"}).out); }
    static bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }
};

TEST_F(CellCommands, AFileIsMilledOnceUnlessAgainIsPassed) {
    start_cell("100000");
    EXPECT_EQ(dispatch().code, 0);
    const Ended second = dispatch();
    EXPECT_EQ(second.code, exit_done) << "what was asked for is there";
    EXPECT_TRUE(has(second.out, "NOT STARTED")) << second.out;
    EXPECT_TRUE(has(second.out, "nothing was started: 1 job ended complete on the simulated cell before"))
        << second.out;
    EXPECT_TRUE(has(second.out, "--again")) << second.out;
    EXPECT_EQ(status()["store"]["starts_total"], 1);
    EXPECT_EQ(dispatch({"--again", "--chunks", "--rehearse"}).code, 0);
    EXPECT_EQ(status()["store"]["starts_total"], 2);
    const Ended all = run({"dispatch", "p.qch", "--drop", "drop"});  // A and B now, C before
    EXPECT_EQ(all.code, 0) << all.out << all.err;
    EXPECT_EQ(status()["store"]["starts_total"], 4);
    stop_cell();
}

TEST_F(CellCommands, TheSameCellHasOneJournalUnderAllNamesOfItsAddress) {
    start_cell("100000");
    const std::string numeric = to;
    to = "localhost" + numeric.substr(numeric.find(':'));
    const Ended first = dispatch();
    if (first.code == exit_unreachable) GTEST_SKIP() << "skipped: localhost is not 127.0.0.1 here";
    EXPECT_EQ(first.code, 0) << first.err;
    to = numeric;
    EXPECT_EQ(dispatch({"--again"}).code, 0);
    const Json journals = Json::parse(run({"journal", "show", "--json"}, false).out);
    ASSERT_EQ(journals["journals"].size(), 1U);
    EXPECT_EQ(journals["journals"][0]["endpoint"], numeric);
    EXPECT_EQ(status()["has_journal"], true);
    stop_cell();
}

TEST_F(CellCommands, F60_WithoutANewBlockTheQueueStopsAfterOneJob) {
    program::put(folder.path / "block.txt", "block fresh\n");
    start_cell("100000", {"--script", "block.txt"});
    const Ended queue = run({"dispatch", "p.qch", "--drop", "drop"});
    EXPECT_EQ(queue.code, exit_demand_broken) << queue.out;
    EXPECT_TRUE(has(queue.out, "NO_CONSENT")) << queue.out;
    EXPECT_TRUE(has(queue.out, "1 of 3 jobs ended complete on the simulated cell; not tried: 1")) << queue.out;
    EXPECT_EQ(status()["store"]["starts_total"], 1);
    stop_cell();
}

TEST_F(CellCommands, AKilledDispatchIsTakenUpAndTheJournalTellsIt) {
    start_cell("20");
    Process killed({"dispatch", "p.qch", "--piece", "C", "--drop", "drop", "--to", to}, {folder.path});
    ASSERT_TRUE(killed.waits_until_err("the job has started")) << killed.err();
    killed.signal(SIGKILL);
    killed.wait();
    EXPECT_EQ(run({"cell", "stop"}).code, 0);
    const Ended next = dispatch();
    EXPECT_EQ(next.code, exit_demand_broken) << next.out;
    EXPECT_TRUE(has(next.out, "STARTED")) << next.out;
    EXPECT_TRUE(has(next.err, "left the job")) << next.err;
    EXPECT_EQ(status()["store"]["starts_total"], 1);
    EXPECT_EQ(run({"journal", "verify"}, false).code, 0);
    const Json journals = Json::parse(run({"journal", "show", "--json"}, false).out);
    EXPECT_EQ(journals["schema"], "qchopper-journal-1");
    ASSERT_EQ(journals["journals"].size(), 1U);
    EXPECT_EQ(journals["journals"][0]["open_jobs"], 0);
    const Json& carved = journals["journals"][0]["jobs"];
    ASSERT_FALSE(carved.empty());
    EXPECT_EQ(carved[0]["state"], "ended");
    EXPECT_EQ(carved[0]["result"], "stopped");
    EXPECT_EQ(carved[0]["sha256"].get<std::string>().size(), 64U);
    EXPECT_LE(carved[0]["created_ms"], carved[0]["started_ms"]);
    EXPECT_LE(carved[0]["started_ms"], carved[0]["ended_ms"]);
    std::string kinds;
    for (const Json& row : journals["journals"][0]["rows"]) kinds += row["kind"].get<std::string>() + " ";
    EXPECT_TRUE(has(kinds, "START_INTENT STARTED ")) << kinds;
    EXPECT_TRUE(has(kinds, "RESUMED ")) << kinds;
    stop_cell();
}

TEST(OptionValues, ATimeIsReadAsItIsWritten) {
    EXPECT_EQ(ms_from_utc("1970-01-01 00:00:00"), 0U);
    EXPECT_EQ(ms_from_utc("2026-11-27 23:59:59"), 1'795'823'999'000U);
    EXPECT_EQ(ms_from_utc("2026-11-28"), 1'795'824'000'000U);
    EXPECT_EQ(ms_from_utc("2024-02-29"), 1'709'164'800'000U);
    for (const char* wrong :
         {"", "2026", "2026-11-31", "2023-02-29", "2026-11-28 24:00:00", "2026-11-28 1:2:3", "28.11.2026",
          "2026-11-28T00:00:00", "2026-11-28 00:00:00Z", " 2026-11-28", "1969-12-31", "-026-11-28"}) {
        EXPECT_EQ(ms_from_utc(wrong), std::nullopt) << wrong;
    }
}

TEST(OptionValues, ABaseIsSixNumbersAndALengthBelongsToATool) {
    EXPECT_EQ(base_from("1012.5,-3.2,361.8,0.4,0,-1e-3"), (EnteredBase{{1012.5, -3.2, 361.8}, {0.4, 0, -0.001}}));
    for (const char* wrong : {"", "1,2,3", "1,2,3,4,5", "1,2,3,4,5,6,7", "1,2,3,4,5,nan", "1,2,3,4,5,inf", "1,2,3,4,5,",
                              "1,2,3,4,5,1e9", "X 1,2,3,4,5,6", "1;2;3;4;5;6"}) {
        EXPECT_EQ(base_from(wrong), std::nullopt) << wrong;
    }
    EXPECT_EQ(tool_length_from("3=199.2"), (EnteredLength{3, 199.2}));
    for (const char* wrong : {"", "3", "=199", "3=", "3=long", "3=0", "3=-5", "3=nan", "3=inf", "1.5=199", "-1=199",
                              "70000=199", "3=199=2", "a=199"}) {
        EXPECT_EQ(tool_length_from(wrong), std::nullopt) << wrong;
    }
}

TEST_F(CellCommands, TheJobsOfTheJournalAreListedExportedAndStayKnown) {
    start_cell("100000");
    EXPECT_EQ(dispatch().code, 0);
    const Json listed = Json::parse(run({"journal", "jobs", "--json"}, false).out);
    EXPECT_EQ(listed["schema"], "qchopper-journal-jobs-1");
    ASSERT_EQ(listed["jobs"].size(), 1U);
    EXPECT_EQ(listed["jobs"][0]["end"], "complete");
    EXPECT_EQ(listed["jobs"][0]["consent_by"], "unknown");
    EXPECT_GE(listed["jobs"][0]["took_s"], 0);
    EXPECT_EQ(listed["orders"][0]["pieces_complete"], 1);
    EXPECT_EQ(listed["orders"][0]["piece_count"], 3);
    // The same job, in the same words, as journal show has it.
    const Json shown = Json::parse(run({"journal", "show", "--json"}, false).out)["journals"][0];
    EXPECT_EQ(shown["jobs"][0], listed["jobs"][0]);
    EXPECT_EQ(run({"journal", "jobs", "--csv", "--json"}, false).code, exit_use);
    const std::string csv = run({"journal", "jobs", "--csv"}, false).out;
    EXPECT_TRUE(csv.starts_with("job_id,sha256,file,")) << csv;
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2) << csv;
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // the options have whole seconds
    EXPECT_TRUE(has(run({"journal", "jobs", "--since", utc_text(unix_ms())}, false).out, "no job"));
    for (const char* option : {"2999-01-01", "2026-02-30", "yesterday"}) {
        const Ended refused = run({"journal", "jobs", "--since", option}, false);
        EXPECT_EQ(refused.code, exit_use) << option;
        EXPECT_TRUE(has(refused.err, option)) << refused.err;
    }
    const std::string journal = fs::path(shown["folder"].get<std::string>()).filename();
    const Ended exported = run({"journal", "export", journal, "--before", utc_text(unix_ms()), "-o", "old"}, false);
    EXPECT_EQ(exported.code, 0) << exported.err;
    EXPECT_TRUE(has(exported.out, "of 1 closed job, were exported to old")) << exported.out;
    EXPECT_EQ(run({"journal", "verify"}, false).code, 0);
    EXPECT_EQ(run({"journal", "verify", "old"}, false).code, 0);
    const Json both = Json::parse(run({"journal", "jobs", journal, "old", "--json"}, false).out);
    EXPECT_EQ(both["jobs"], listed["jobs"]);
    EXPECT_TRUE(has(dispatch().out, "--again"));  // the journal still knows the file
    stop_cell();
}

TEST_F(CellCommands, ARunningDispatchIsHeldAndGoesOn) {
    start_cell("100");
    Process running({"dispatch", "p.qch", "--piece", "C", "--drop", "drop", "--to", to}, {folder.path});
    ASSERT_TRUE(running.waits_until_err("the job has started")) << running.err();
    const Ended held = run({"cell", "hold"});
    EXPECT_EQ(held.code, 0) << held.out << held.err;
    EXPECT_EQ(run({"cell", "reset"}).code, exit_busy);
    const Ended unheld = run({"cell", "unhold", "--json"});
    EXPECT_EQ(unheld.code, 0) << unheld.out << unheld.err;
    EXPECT_EQ(Json::parse(unheld.out)["end"], "done");
    EXPECT_TRUE(has(unheld.out, "running dispatcher")) << unheld.out;
    const Ended stopped = run({"cell", "stop"});
    EXPECT_EQ(stopped.code, 0);
    EXPECT_TRUE(has(stopped.out, "no emergency stop")) << stopped.out;
    EXPECT_EQ(running.wait().code, exit_demand_broken);
    EXPECT_EQ(status()["store"]["starts_total"], 1);
    stop_cell();
}

TEST_F(CellCommands, TakeOverSaysOnlyOfALeaseThatItHasEnded) {
    start_cell("100");
    const Ended free = run({"cell", "take-over", "--code", "4711"});
    EXPECT_EQ(free.code, 0) << free.out << free.err;
    EXPECT_TRUE(has(free.out, "No dispatcher had a lease")) << free.out;
    EXPECT_TRUE(has(free.out, "the cell cuts no foam")) << free.out;

    Process running({"dispatch", "p.qch", "--piece", "C", "--drop", "drop", "--to", to}, {folder.path});
    ASSERT_TRUE(running.waits_until_err("the job has started")) << running.err();
    const program::Folder elsewhere;  // another user, with a journal of their own
    const Ended refused = program::run({"cell", "take-over", "--code", "4711", "--to", to}, {elsewhere.path});
    EXPECT_EQ(refused.code, exit_demand_broken) << refused.out << refused.err;
    EXPECT_TRUE(has(refused.out, "LEASE_BUSY")) << refused.out;
    EXPECT_TRUE(has(refused.out, "the cell is cutting foam")) << refused.out;
    EXPECT_TRUE(has(refused.out, "to do: ")) << refused.out;
    EXPECT_FALSE(has(refused.out, "has ended")) << refused.out;
    EXPECT_FALSE(has(refused.out, "lost its lease")) << refused.out;
    EXPECT_EQ(run({"cell", "stop"}).code, 0);
    running.wait();
    stop_cell();
}

TEST_F(CellCommands, AMissingDropFolderIsNamedBeforeTheCellIsAsked) {
    start_cell("100000");
    fs::remove(folder.path / "drop");
    const Ended missing = dispatch();
    EXPECT_EQ(missing.code, exit_create) << missing.out << missing.err;
    EXPECT_TRUE(has(missing.err, "there is no drop folder drop")) << missing.err;
    EXPECT_TRUE(has(missing.err, "this dispatch started no job")) << missing.err;
    EXPECT_TRUE(has(missing.err, "--chunks")) << missing.err;
    EXPECT_EQ(status()["epoch_held"], 0) << "nothing was sent";
    fs::create_directory(folder.path / "drop");
    EXPECT_EQ(dispatch().code, 0) << "and no job was left open";
    stop_cell();
}

TEST_F(CellCommands, AnAbortThatReachesNobodySaysThatTheMachineMayRunOn) {
    for (const char* command : {"abort", "stop", "hold"}) {
        const Ended ended = run({"cell", command, "--to", "127.0.0.1:9"}, false);
        EXPECT_EQ(ended.code, exit_unreachable) << ended.err;
        EXPECT_TRUE(has(ended.err, "runs on")) << ended.err;
        EXPECT_TRUE(has(ended.err, "red button")) << ended.err;
    }
}

TEST_F(CellCommands, ACellThatWasEmptiedIsAcceptedInSoManyWords) {
    start_cell("100000");
    EXPECT_EQ(dispatch().code, 0);
    stop_cell();
    fs::remove_all(folder.path / "store");
    start_cell("100000");
    const Ended lost = dispatch({"--again"});
    EXPECT_EQ(lost.code, exit_demand_broken) << lost.out << lost.err;
    EXPECT_TRUE(has(lost.out, "CELL_STORE_LOST")) << lost.out;
    EXPECT_TRUE(has(lost.out, "accept-store")) << lost.out;
    EXPECT_EQ(status()["store"]["starts_total"], 0);
    EXPECT_FALSE(status()["store_lost"].is_null());
    EXPECT_EQ(run({"cell", "reset"}).code, exit_demand_broken);
    EXPECT_EQ(run({"cell", "accept-store"}).code, 0);
    EXPECT_TRUE(status()["store_lost"].is_null());
    EXPECT_EQ(dispatch({"--again"}).code, 0);
    stop_cell();
}

}  // namespace
}  // namespace qchopper
