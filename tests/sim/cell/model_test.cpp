// The rows MOVE of the model of the hand-off (tests/model/hand_off.pml) against what the simulated cell does.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "tests/sim/cell/cell_bench.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::job_a;

const char* const states[] = {"none", "stored", "prepared", "running", "ended"};
const char* const commands[] = {"claim", "store", "prepare", "start", "cancel", "clear_result"};

std::string row(const std::string& command, const std::string& from, const std::string& to) {
    return command + ": " + from + " -> " + to;
}

std::set<std::string> rows_of_the_model() {
    std::ifstream file(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "tests" / "model" / "hand_off.pml");
    const std::regex move(R"(MOVE\((\w+), (\w+), (\w+), )");
    std::set<std::string> rows;
    for (std::string line; std::getline(file, line);) {
        std::smatch found;
        if (line.starts_with("#define") || !std::regex_search(line, found, move)) continue;
        rows.insert(row(found[1], found[2], found[3]));
    }
    return rows;
}

// With the lease of its owner, and a stored job that is verified.
void bring_to(Bench& bench, const std::string& state) {
    if (state == "none") bench.to_idle();
    if (state == "stored") bench.to_verified();
    if (state == "prepared") bench.to_prepared();
    if (state == "running" || state == "ended") bench.to_running();
    if (state != "ended") return;
    bench.pass(102000);
    ASSERT_EQ(bench.claim(), AckResult::ok);
}

std::string state_of(const Bench& bench) {
    switch (bench.cell.job.state) {
        case JobState::none:
            return "none";
        case JobState::stored:
            return "stored";
        case JobState::prepared:
            return "prepared";
        case JobState::running:
            return "running";
        default:
            return "ended";
    }
}

void send(Bench& bench, const std::string& command) {
    bench.write_ticket(bench::good_ticket());
    if (command == "claim") bench.claim();
    if (command == "store") bench.send(CellCommand::store, job_a);
    if (command == "prepare") bench.send(CellCommand::prepare, job_a);
    if (command == "start") bench.send(CellCommand::start, job_a, bench.cell.job.token);
    if (command == "cancel") bench.send(CellCommand::cancel, job_a);
    if (command == "clear_result") bench.send(CellCommand::clear_result, job_a);
    bench.pass(10);  // consent is given
}

TEST(Model, ItsRowsAreExactlyWhatTheCellDoes) {
    std::set<std::string> rows;
    for (const char* const from : states) {
        for (const char* const command : commands) {
            Bench bench;
            bring_to(bench, from);
            ASSERT_EQ(state_of(bench), from);
            send(bench, command);
            const std::string to = state_of(bench);
            if (to != from) rows.insert(row(command, from, to));
        }
    }
    EXPECT_EQ(rows, rows_of_the_model());
    EXPECT_EQ(rows.size(), 7U);
}

}  // namespace
}  // namespace qchopper
