// What prepare says at its end.

#include "app/report/prepare_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace qchopper {
namespace {

PieceReport some_piece(const std::string& name, bool has_job) {
    PieceReport piece;
    piece.name = name;
    piece.piece_setup.choice.setups.resize(1);
    if (has_job) piece.job = "p.qch/jobs/" + name + ".qjob";
    return piece;
}

// Pieces B and C with one job each, and D without.
PreparedProject some_project() {
    PreparedProject prepared;
    prepared.folder = "p.qch";
    prepared.cell.stock.resize(1);
    prepared.pieces = {some_piece("B", true), some_piece("C", true), some_piece("D", false)};
    prepared.project.jobs = {{"B", {}, {}, 1}, {"C", {}, {}, 1}};
    return prepared;
}

bool has_line(const PreparedProject& prepared, const std::string& line) {
    const std::vector<std::string> lines = table(prepared);
    return std::find(lines.begin(), lines.end(), line) != lines.end();
}

TEST(PrepareReport, CountsJobFilesAndSaysOfHowManyPiecesWhereAPieceHasSeveral) {
    PreparedProject prepared = some_project();
    EXPECT_TRUE(has_line(prepared, "3 pieces by 0 cuts, 2 jobs in p.qch/jobs, pictures in p.qch/pictures."));
    EXPECT_TRUE(has_line(prepared, "Next: qchopper dry-run p.qch"));
    prepared.project.jobs.push_back({"C", {}, {}, 2});
    EXPECT_TRUE(
        has_line(prepared, "3 pieces by 0 cuts, 3 jobs of 2 pieces in p.qch/jobs, pictures in p.qch/pictures."));
    prepared.project.jobs.clear();
    for (PieceReport& piece : prepared.pieces) piece.job.clear();
    EXPECT_TRUE(has_line(prepared, "3 pieces by 0 cuts, 0 jobs in p.qch/jobs, pictures in p.qch/pictures."));
    EXPECT_TRUE(has_line(prepared, "Next: qchopper setup p.qch"));
}

}  // namespace
}  // namespace qchopper
