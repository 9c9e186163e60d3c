#include "app/dispatch/restart_job.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "cam/job/read_job.h"
#include "sim/replay/replay.h"
#include "tests/app/jobs/proven_job.h"

namespace qchopper {
namespace {

constexpr const char* kuka = "kr60-ha";
const std::string source = "A.qjob";

// The piece of proven_job() in files of few lines, so that an operation has several chunks.
const ProvenJob& stopped_job(const std::string& cell_name) {
    static std::map<std::string, ProvenJob> jobs;
    const auto known = jobs.find(cell_name);
    if (known != jobs.end()) return known->second;
    const Piece& piece = proven_job(kuka).input.piece;
    const auto few_lines = [](Cell& cell) { cell.machine->program.lines_per_chunk = 300; };
    return jobs.emplace(cell_name, made_and_proven(cell_name, piece, {}, FineTools::worthwhile, few_lines))
        .first->second;
}

std::size_t chunks_of(const ProvenJob& job) {
    return job.job.program->chunks.size();
}

RestartJob restarted(const ProvenJob& job, std::size_t chunk) {
    return make_restart({job.job, source, job.cell.cell, chunk, 0});
}

// The stock at the end of a job's program.
StockRecord end_of(const ReadJob& job, const Cell& cell) {
    const JobContents contents(job, "job");
    const ProofInput input = contents.input(cell);
    ReplayScene scene = scene_of(input);
    const std::optional<StockRecord> before = stock_before(input);
    if (before) scene.before = &*before;
    scene.is_last = false;
    return replay(program_read_back(input), scene, {}).left;
}

std::string refusal(const RestartOrder& order) {
    try {
        make_restart(order);
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::use);
        return error.what();
    }
    return "taken";
}

std::string kinds_of(const std::vector<ProofFinding>& findings) {
    std::string kinds;
    for (const ProofFinding& finding : findings) kinds += (kinds.empty() ? "" : " ") + finding.kind;
    return kinds;
}

struct RestartsIn : ::testing::TestWithParam<const char*> {};

TEST_P(RestartsIn, EndAsTheWholeJobDoes) {
    const ProvenJob& whole = stopped_job(GetParam());
    const std::size_t count = chunks_of(whole);
    ASSERT_GE(count, 4U);
    const StockRecord end = end_of(whole.job, whole.cell.cell);
    for (const std::size_t chunk : {std::size_t{1}, count / 2, count - 1}) {
        const RestartJob made = restarted(whole, chunk);
        EXPECT_TRUE(made.proof.is_proven()) << chunk << ": " << kinds_of(made.proof.findings);
        const ReadJob job = parse_job(made.file, made.name);
        EXPECT_EQ(made.name, "A.r" + std::to_string(made.chunk + 1) + ".qjob");
        EXPECT_EQ(job.program->chunks.size(), count - made.chunk);
        EXPECT_EQ(end_of(job, whole.cell.cell), end) << "carved(1..K-1), then the restart, is the whole";
        // Its stock is rounded up to 0.01 mm.
        for (const char* key : {"within_tolerance_percent", "reachable_percent", "max_leftover_mm", "leftover_cm3"}) {
            EXPECT_NEAR(made.proof.figure(key), whole.verdict.figure(key), 0.0127) << key;
        }
        EXPECT_LT(made.proof.time_s, whole.verdict.figure("time_s"));
        EXPECT_EQ(kinds_of(faults_of_restart(job, whole.job, source, whole.cell.cell)), "");
        const JobVerdict verdict = judged(job, whole.cell);
        EXPECT_EQ(verdict.figures, made.proof.figures) << "verify repeats the proof";
        EXPECT_EQ(verdict.notes, made.proof.notes);
        EXPECT_TRUE(verdict.is_positive);
    }
}

INSTANTIATE_TEST_SUITE_P(Cells, RestartsIn,
                         ::testing::Values(kuka, "kr120-r2500-pro-rotary", "irb6640-185-2.8", "gantry-3axis"));

TEST(Restarts, TheSameChunkGivesTheSameBytes) {
    const ProvenJob& whole = stopped_job(kuka);
    EXPECT_EQ(restarted(whole, 2).file, restarted(whole, 2).file);
    EXPECT_NE(restarted(whole, 2).file, restarted(whole, 3).file);
}

TEST(Restarts, BeginWhereAChunkCanBeStartedFromHome) {
    ProvenJob whole = stopped_job(kuka);
    const auto forbid = [&](std::size_t chunk) {
        Bytes& bytes = whole.job.files.at(whole.job.program->chunks[chunk].file);
        std::string text{bytes.begin(), bytes.end()};
        const std::string free = ";start from home: free";
        text.replace(text.find(free), free.size(), ";start from home: not free, see the chunks before");
        bytes = {text.begin(), text.end()};
    };
    forbid(3);
    forbid(2);
    EXPECT_EQ(restarted(whole, 3).chunk, 1U);
    EXPECT_EQ(restarted(whole, 3).name, "A.r2.qjob");
    forbid(1);
    EXPECT_NE(refusal({whole.job, source, whole.cell.cell, 3, 0}).find("would begin with the first chunk"),
              std::string::npos);
}

TEST(Restarts, OfNoChunkOrByNoToolAreRefused) {
    const ProvenJob& whole = stopped_job(kuka);
    const std::size_t count = chunks_of(whole);
    EXPECT_NE(refusal({whole.job, source, whole.cell.cell, count, 0}).find("no chunk " + std::to_string(count + 1)),
              std::string::npos);
    Cell other = whole.cell.cell;
    std::erase_if(other.machine->tools,
                  [&](const CuttingTool& tool) { return tool.number == whole.job.program->chunks.back().tool; });
    EXPECT_NE(refusal({whole.job, source, other, count - 1, 0}).find("is not in the cell file"), std::string::npos);
}

TEST(Restarts, OfAPartCountChunksOverAllParts) {
    const ProvenJob& whole = stopped_job(kuka);
    const RestartJob made = make_restart({whole.job, source, whole.cell.cell, 2, 10});
    EXPECT_EQ(made.name, "A.r13.qjob");
    EXPECT_EQ(parse_job(made.file, made.name).program->entry, "qc_1_r13.src");
    EXPECT_EQ(parse_job(made.file, made.name).program->restart->chunks_before, 2U);
}

TEST(Restarts, WhatDoesNotFollowFromTheFirstJobIsNamed) {
    const ProvenJob& whole = stopped_job(kuka);
    const ReadJob job = parse_job(restarted(whole, 2).file, "A.r3.qjob");
    const auto faults = [&](const ReadJob& own, const ReadJob& first) {
        return kinds_of(faults_of_restart(own, first, source, whole.cell.cell));
    };
    ReadJob other = whole.job;
    other.file_sha256.bytes[0] ^= 1;
    EXPECT_EQ(faults(job, other), "other_job");
    ReadJob later = job;
    later.program->restart->chunks_before = 3;
    EXPECT_EQ(faults(later, whole.job), "other_job other_stock");
    ReadJob none = job;
    none.program->restart->chunks_before = static_cast<std::uint32_t>(chunks_of(whole));
    EXPECT_EQ(faults(none, whole.job), "other_chunks");
    ReadJob carved = job;
    carved.files.at("stock.bin") = parse_job(restarted(whole, 3).file, "A.r4.qjob").files.at("stock.bin");
    EXPECT_EQ(faults(carved, whole.job), "other_stock");
    ReadJob changed = job;
    changed.files.at(job.program->chunks.back().file).back() ^= 1;
    EXPECT_EQ(faults(changed, whole.job), "other_chunks");
    ReadJob moved = job;
    moved.setup.placement.x += 1;
    EXPECT_EQ(faults(moved, whole.job), "other_job");
}

TEST(Restarts, WithAStockThatCannotBeReadAreRefused) {
    const ProvenJob& whole = stopped_job(kuka);
    ReadJob job = parse_job(restarted(whole, 1).file, "A.r2.qjob");
    job.files.at("stock.bin").clear();
    const JobVerdict verdict = judged(job, whole.cell);
    EXPECT_EQ(kinds_of(verdict.findings), "not_replayable");
}

}  // namespace
}  // namespace qchopper
