#include "app/dispatch/verify_jobs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/jobs/job_proof.h"
#include "segment/io/write_mesh.h"
#include "tests/app/jobs/proven_job.h"

namespace qchopper {
namespace {

constexpr const char* kuka = "kr60-ha";

std::string kinds_of(const JobVerdict& verdict) {
    std::string kinds;
    for (const ProofFinding& finding : verdict.findings) kinds += (kinds.empty() ? "" : " ") + finding.kind;
    return kinds;
}

// The verdict after a change of one file of the program.
JobVerdict after(const std::string& file, const std::string& text) {
    ReadJob job = proven_job(kuka).job;
    job.files.at(file) = {text.begin(), text.end()};
    return judged(job, proven_job(kuka).cell);
}

std::string text_of(const std::string& file) {
    const Bytes& bytes = proven_job(kuka).job.files.at(file);
    return {bytes.begin(), bytes.end()};
}

TEST(VerifyJobs, AJobOfAnotherCellIsNamed) {
    const JobVerdict verdict = judged(proven_job(kuka).job, proven_job("kr120-r2500-pro-rotary").cell);
    EXPECT_FALSE(verdict.is_positive);
    EXPECT_EQ(verdict.findings.front().kind, "other_cell");
    EXPECT_TRUE(verdict.figures.empty()) << "nothing is replayed in a cell that it was not made for";
}

TEST(VerifyJobs, AFrameThatTheCellFileDoesNotGiveIsNamed) {
    ReadJob job = proven_job(kuka).job;
    job.setup_in_cell.front().shift.x += 1;
    EXPECT_EQ(kinds_of(judged(job, proven_job(kuka).cell)), "other_frame");
}

TEST(VerifyJobs, AJobThatDoesNotFitIsNotReplayed) {
    ReadJob job = proven_job(kuka).job;
    job.holds_poses = false;
    EXPECT_EQ(kinds_of(judged(job, proven_job(kuka).cell)), "does_not_fit");
}

TEST(VerifyJobs, AJobWithoutAProgramIsNotPositive) {
    ReadJob job = proven_job(kuka).job;
    job.program.reset();
    job.no_program_because = "prepare was asked for none";
    const JobVerdict verdict = judged(job, proven_job(kuka).cell);
    EXPECT_EQ(kinds_of(verdict), "no_program");
    EXPECT_FALSE(verdict.is_positive);
}

TEST(VerifyJobs, AChunkOtherThanTheManifestSaysIsNamed) {
    ReadJob job = proven_job(kuka).job;
    job.program->chunks[1].length_mm += 1;
    const JobVerdict verdict = judged(job, proven_job(kuka).cell);
    ASSERT_FALSE(verdict.findings.empty());
    EXPECT_EQ(verdict.findings.front().kind, "other_chunks");
    EXPECT_EQ(verdict.findings.front().file, job.program->chunks[1].file);
    job = proven_job(kuka).job;
    job.program->chunks.pop_back();
    EXPECT_EQ(judged(job, proven_job(kuka).cell).findings.front().kind, "other_chunks");
}

TEST(VerifyJobs, AChunkThatTheManifestDoesNotDescribeIsNamed) {
    ReadJob job = proven_job(kuka).job;
    JobChunk& chunk = job.program->chunks[1];
    chunk = {chunk.file, chunk.tool, chunk.orientation, 0, 0, {}, {}, {}};
    EXPECT_EQ(judged(job, proven_job(kuka).cell).findings.front().kind, "other_chunks");
}

TEST(VerifyJobs, TheScallopHeightIsThatOfTheCellFile) {
    const CellFile& cell = proven_job(kuka).cell;
    ReadJob job = proven_job(kuka).job;
    EXPECT_EQ(job.program->scallop_mm, 0.25);
    job.program->scallop_mm = 2;
    const JobVerdict claimed = judged(job, cell);
    EXPECT_EQ(kinds_of(claimed), "other_scallop");
    EXPECT_EQ(describe(claimed.findings.front()), "manifest.json: scallop_mm is 2, expected: 0.25 of the cell file");
    CellFile coarse = cell;
    coarse.cell.machine->program.scallop = 2;
    EXPECT_EQ(kinds_of(judged(job, coarse)), "");
}

TEST(VerifyJobs, TheAccountOfTheTimeAddsUpAndKnowsTheOperations) {
    const JobVerdict verdict = judged(proven_job(kuka).job, proven_job(kuka).cell);
    ASSERT_FALSE(verdict.time.empty());
    EXPECT_EQ(verdict.time.front().operation, "roughing");
    double seconds = 0;
    double mm = 0;
    for (const MachineTime& time : verdict.time) {
        EXPECT_NE(time.operation, "unknown");
        EXPECT_GT(time.lines, 0U);
        seconds += time.seconds();
        mm += time.cutting_mm + time.air_mm + time.link_mm;
    }
    EXPECT_NEAR(seconds, verdict.figure("time_s"), 1e-6 * seconds);
    EXPECT_NEAR(mm, 1000 * verdict.figure("path_m"), 1e-6 * mm);
}

TEST(VerifyJobs, MovesThatTheProgramLeavesOutStandInTheVerdict) {
    ReadJob job = proven_job(kuka).job;
    EXPECT_TRUE(proven_job(kuka).verdict.notes.empty());
    job.program->moves_left_out = {6, "operation 2 of the toolpath: link 5"};
    const JobVerdict verdict = judged(job, proven_job(kuka).cell);
    EXPECT_TRUE(verdict.is_positive) << "what it means for the piece is found by the replay";
    ASSERT_EQ(verdict.notes.size(), 1U);
    EXPECT_NE(verdict.notes[0].find("6 mm of its cuts: operation 2 of the toolpath: link 5"), std::string::npos);
    EXPECT_TRUE(std::any_of(verdict.figures.begin(), verdict.figures.end(), [](const ProofFigure& figure) {
        return figure.key == "moves_left_out_mm" && figure.value == 6;
    }));
}

TEST(VerifyJobs, TheProgramOfAnotherPieceIsRefused) {
    ReadJob job = proven_job(kuka).job;
    TriangleMesh taller = job_mesh(job.files.at("piece.stl"), "piece.stl");
    for (Vec3& point : taller.points) point.z *= 1.2;
    job.files.at("piece.stl") = to_stl(taller);
    const JobVerdict verdict = judged(job, proven_job(kuka).cell);
    EXPECT_NE(kinds_of(verdict).find("gouge"), std::string::npos) << kinds_of(verdict);
    EXPECT_NE(verdict.findings.front().line, 0U) << "where the tool cuts into it";
}

TEST(VerifyJobs, WhatCannotBeReadIsNamedWithFileAndLine) {
    const std::string file = proven_job(kuka).job.program->chunks.front().file;
    const std::string text = text_of(file);
    const std::size_t half = text.size() / 2;
    const JobVerdict cut_short = after(file, text.substr(0, half));
    EXPECT_EQ(kinds_of(cut_short), "not_readable");
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(half), '\n');
    EXPECT_NE(describe(cut_short.findings.front()).find(file), std::string::npos)
        << describe(cut_short.findings.front());
    EXPECT_NE(describe(cut_short.findings.front()).find(std::to_string(line)), std::string::npos)
        << line << describe(cut_short.findings.front());

    const JobVerdict foreign = after(file, "G21\r\nG0 X0 Y0 Z0\r\nM30\r\n");
    EXPECT_EQ(kinds_of(foreign), "not_readable");
    EXPECT_NE(describe(foreign.findings.front()).find(file + " line 1:"), std::string::npos)
        << describe(foreign.findings.front());
    EXPECT_EQ(kinds_of(after(file, "")), "not_readable");
}

}  // namespace
}  // namespace qchopper
