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
    piece.piece_setup.stock_fit.margins = {{"height", "too high", has_job ? 1.0 : -1.0}};
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

TEST(PrepareReport, WhereBlocksAreSawnAreasOfCapsAndFoamAreAddedUp) {
    PreparedProject prepared = some_project();
    const auto has_caps = [&] {
        const std::vector<std::string> lines = table(prepared);
        return std::ranges::any_of(lines, [](const std::string& line) { return line.starts_with("Caps:"); });
    };
    EXPECT_FALSE(has_caps());
    prepared.cell.stock[0].is_sawn = true;
    for (std::size_t i = 0; i < 2; ++i) {
        auto& setup = prepared.pieces[i].piece_setup.choice.setups[0];
        setup.base_mm2 = 1e6;
        setup.milled_caps_mm2 = 2e4;
        setup.flush_caps = {{2, BlockFace::top, 3e5}};
        setup.access.area_mm2 = 1.5e6;
        setup.spoil = 10;
        setup.block.size = {1000, 500, 410};
        prepared.pieces[i].volume_mm3 = 0.15e9;
    }
    prepared.pieces[0].piece_setup.choice.setups[0].flush_caps.push_back({3, BlockFace::plus_x, 1e5});
    EXPECT_TRUE(
        has_line(prepared,
                 "Caps: bases of 2.00 m2 are parted, 3 flush caps of 0.70 m2 sawn, 0.04 m2 milled; with the skin "
                 "3.00 m2 are to mill, and 100 l of foam to remove."));
}

}  // namespace
}  // namespace qchopper
