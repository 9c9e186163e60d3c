// What commands that make programs say of them: text and JSON.

#include "app/report/program_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/report/time_report.h"
#include "app/report/verify_report.h"

namespace qchopper {
namespace {

// A piece of which the arm does not carry some moves, carved in two parts.
PieceReport some_report() {
    PieceReport piece{"Q", 100, 5e6, {}, "jobs/Q.qjob"};
    JobVerdict verdict;
    verdict.piece = "Q";
    verdict.job = "Q.qjob";
    verdict.is_positive = true;
    verdict.figures = {{"moves_left_out_mm", "cuts left out", 6, "mm", 0}};
    verdict.notes = {"no arm posture reaches 6 mm of its cuts: link 5"};
    piece.verdicts = {verdict, verdict};
    return piece;
}

TEST(ProgramReport, MovesThatAreLeftOutAreSaidOncePerPieceAndStandInEveryDocument) {
    const PieceReport piece = some_report();
    const std::vector<std::string> warnings = program_warnings(piece, "p.qch");
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings.front(), "piece Q: no arm posture reaches 6 mm of its cuts: link 5");
    const nlohmann::ordered_json json = program_json(piece);
    EXPECT_EQ(json["verdicts"][0]["figures"]["moves_left_out_mm"], 6);
    EXPECT_EQ(json["verdicts"][0]["notes"][0], piece.verdicts[0].notes[0]);
    const VerifyAnswer answer{{"jobs/Q.qjob", piece.verdicts[0]}};
    const auto verified = nlohmann::json::parse(text_of(document(answer)));
    EXPECT_EQ(verified["jobs"][0]["notes"][0], piece.verdicts[0].notes[0]);
    EXPECT_EQ(lines(answer)[2], "  Note: " + piece.verdicts[0].notes[0] + ".");
}

MachineTime row(const std::string& operation, std::uint16_t tool, double cutting_s, double removed_mm3) {
    MachineTime time;
    time.operation = operation;
    time.tool = tool;
    time.tool_mm3_per_s = 1000.0 * tool;
    time.cutting_s = cutting_s;
    time.acceleration_s = 0.25 * cutting_s;
    time.removed_mm3 = removed_mm3;
    time.stops = 5;
    return time;
}

TEST(TimeReport, SaysWhereTheHoursOfAllJobsGo) {
    EXPECT_EQ(time_line({}), "");
    MachineTime finishing = row("fine finishing", 3, 7200, 1e3);
    finishing.joint_move_s = 360;
    finishing.tool_change_s = 720;
    finishing.link_s = 36;
    finishing.air_s = 3600;
    finishing.cutting_mm = 6000;
    finishing.air_mm = 1000;
    finishing.link_mm = 3000;
    finishing.lines = 990;
    // 9 litres at a rate of 24 cm3/s and 3 at 6 take 875 s.
    std::vector<MachineTime> rows{row("roughing", 24, 1440, 9e6), finishing, row("roughing", 6, 720, 3e6)};
    rows[0].lines = 10;
    EXPECT_EQ(
        time_line(rows),
        "machine time 4.56 h: roughing 0.75, finishing 0.00, fine finishing 3.81, drilling 0.00; cutting 2.60, "
        "air 1.00, links 0.01, acceleration and stops 0.65, joint moves 0.10, tool changes 0.20; roughing removes "
        "12.00 l at 4.4 cm3/s, its tools may 13.7; 40 % of the path removes nothing, 1.5 % of the lines stop exactly.");
    const std::string old = time_line({row("unknown", 1, 2880, 1e6)});
    EXPECT_NE(old.find("drilling 0.00; unknown 1.00; cutting 0.80"), std::string::npos) << old;
    EXPECT_EQ(old.find("removes"), std::string::npos) << old;
}

TEST(TimeReport, RowsOfOneOperationAndToolAreAdded) {
    const std::vector<MachineTime> sums = merged(
        {row("roughing", 2, 10, 7), row("finishing", 2, 20, 1), row("roughing", 3, 40, 1), row("roughing", 2, 5, 2)});
    ASSERT_EQ(sums.size(), 3U);
    EXPECT_EQ(sums[0].operation, "roughing");
    EXPECT_EQ(sums[0].tool, 2);
    EXPECT_EQ(sums[0].cutting_s, 15);
    EXPECT_EQ(sums[0].removed_mm3, 9);
    EXPECT_EQ(sums[0].stops, 10U);
    EXPECT_EQ(sums[0].tool_mm3_per_s, 2000);
    EXPECT_EQ(sums[1].operation, "finishing");
    EXPECT_EQ(sums[2].tool, 3);
}

TEST(TimeReport, StandsInEveryDocument) {
    PieceReport piece = some_report();
    for (JobVerdict& verdict : piece.verdicts) verdict.time = {row("roughing", 2, 10, 7)};
    EXPECT_EQ(program_json(piece)["verdicts"][1]["time"][0]["cutting_s"], 10);
    const VerifyAnswer answer{{"jobs/Q.qjob", piece.verdicts[0]}, {"jobs/R.qjob", piece.verdicts[1]}};
    const auto verified = nlohmann::json::parse(text_of(document(answer)));
    EXPECT_EQ(verified["jobs"][0]["time"][0]["cutting_s"], 10);
    EXPECT_EQ(verified["time"].size(), 1U);
    EXPECT_EQ(verified["time"][0]["cutting_s"], 20);
    const std::vector<std::string> text = lines(answer);
    EXPECT_EQ(text[text.size() - 2].find("machine time 0.01 h:"), 0U) << text[text.size() - 2];
}

TEST(ProgramReport, ARefusedProgramIsNamedFirst) {
    PieceReport piece = some_report();
    piece.verdicts[1].is_positive = false;
    piece.verdicts[1].findings = {{"leftover", "", 0, "foam"}};
    const std::vector<std::string> warnings = program_warnings(piece, "p.qch");
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_EQ(warnings.front(), "piece Q: its program is not proven: foam; see qchopper verify p.qch --piece Q");
}

}  // namespace
}  // namespace qchopper
