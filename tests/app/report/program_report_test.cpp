// What commands that make programs say of them: text and JSON.

#include "app/report/program_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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
