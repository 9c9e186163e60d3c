// Text that comes from a cell or is the name of a file never acts on the terminal, nor on what reads the document.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/exit_code.h"
#include "app/cli/terminal.h"
#include "app/report/cell/cell_control_report.h"
#include "app/report/cell/dispatch_report.h"
#include "app/report/document.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

constexpr const char* hostile = "\x1b[2J\x9b\xc2\x9b\nok";
constexpr const char* shown = R"(\x1b[2J\x9b\xc2\x9b\x0aok)";

bool is_harmless(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); });
}

CellStatusReport with_alarm() {
    CellStatusReport report;
    report.endpoint = "127.0.0.1:15020";
    report.status.alarms = 1;
    report.status.alarm_code = 5;
    report.status.alarm_text = hostile;
    return report;
}

TEST(OutsideText, OfAnAlarmIsEscapedInLinesAndDocument) {
    std::string text;
    for (const std::string& line : lines(with_alarm())) text += line + "\n";
    EXPECT_TRUE(is_harmless(text)) << text;
    EXPECT_NE(text.find(std::string("first 5 ") + shown), std::string::npos) << text;
    const std::string made = text_of(document(with_alarm()));
    EXPECT_TRUE(is_harmless(made)) << made;
    EXPECT_EQ(nlohmann::json::parse(made)["alarm_text"], shown);
}

TEST(OutsideText, OfAnyLineIsEscapedByTheTerminal) {
    Terminal terminal(false);
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    terminal.show({std::string("a ") + hostile}, compose({}));
    terminal.warn(hostile);
    terminal.message(hostile);
    const std::string out = ::testing::internal::GetCapturedStdout();
    const std::string err = ::testing::internal::GetCapturedStderr();
    EXPECT_TRUE(is_harmless(out)) << out;
    EXPECT_TRUE(is_harmless(err)) << err;
    EXPECT_NE(out.find("a \\x1b[2J"), std::string::npos) << out;
}

TEST(OutsideText, OfANameOfAFileIsEscaped) {
    const program::Folder folder;
    for (const std::string json : {"", "--json"}) {
        program::Arguments arguments{"inspect", std::string("\x1b[2J") + ".ply"};
        if (!json.empty()) arguments.push_back(json);
        const program::Ended ended = program::run(arguments, {folder.path});
        EXPECT_EQ(ended.code, exit_missing);
        EXPECT_TRUE(is_harmless(ended.err)) << ended.err;
        EXPECT_TRUE(is_harmless(ended.out)) << ended.out;
    }
}

// The job ran, and the cell gets no further command until somebody has looked at it.
TEST(OutsideText, AJobThatEndedOnACellWithoutItsMemoryIsNotWell) {
    DispatchReport report;
    report.wanted = 1;
    report.handed.push_back({"A", {}, true});
    JobOutcome& outcome = report.handed.back().outcome;
    outcome.start_outcome = StartOutcome::started;
    outcome.job_state = JobState::ended;
    outcome.job_result = JobResult::complete;
    EXPECT_TRUE(report.is_complete());
    outcome.store_is_lost = true;
    outcome.why = "CELL_STORE_LOST";
    EXPECT_FALSE(report.is_complete());
    EXPECT_NE(lines(report)[1].find("CELL_STORE_LOST"), std::string::npos);
}

}  // namespace
}  // namespace qchopper
