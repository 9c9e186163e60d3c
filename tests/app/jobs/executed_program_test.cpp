// The job that the post makes for a small piece, as the simulated cell executes it.

#include "app/dispatch/executed_program.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/dispatch/block_picture.h"
#include "base/error.h"
#include "cam/job/write_job.h"
#include "devices/wire/program_block.h"
#include "tests/app/jobs/proven_job.h"

namespace qchopper {
namespace {

class ExecutedPrograms : public testing::TestWithParam<std::string> {
 protected:
    const ProvenJob& proven() const { return proven_job(GetParam()); }
    ReceivedProgram received(const JobInput& input) const {
        return executed_program(job_file(input), "A.qjob", proven().cell.cell);
    }
    // The first chunk that mills.
    std::string chunk_file() const { return proven().job.program->chunks.front().file; }
    ReceivedProgram with_text(const std::string& text) const {
        JobInput input = proven().input;
        input.program->texts.at(chunk_file()) = text;
        return received(input);
    }
    std::string text() const { return proven().input.program->texts.at(chunk_file()); }
};

TEST_P(ExecutedPrograms, TakeTheTimeOfTheProofAndEndWithTheLastChunk) {
    const ReceivedProgram program = received(proven().input);
    ASSERT_TRUE(program.run) << program.fault;
    const JobRun& run = *program.run;
    const auto& figures = proven().verdict.figures;
    const auto time = std::ranges::find(figures, "time_s", &ProofFigure::key);
    ASSERT_NE(time, figures.end());
    EXPECT_NEAR(run.seconds, time->value, 1e-6 * time->value);
    EXPECT_EQ(run.steps.back().end_s, run.seconds);
    EXPECT_TRUE(std::ranges::is_sorted(run.steps, {}, &RunStep::end_s));
    std::vector<std::uint32_t> chunks;
    for (const RunStep& step : run.steps) {
        const std::uint32_t chunk = chunk_of_block(step.block);
        if (chunk == 0) continue;
        if (chunks.empty() || chunks.back() != chunk) chunks.push_back(chunk);
        EXPECT_EQ(step.tool, proven().job.program->chunks.at(chunk - 1).tool);
    }
    ASSERT_EQ(chunks.size(), proven().job.program->chunks.size());
    for (std::size_t i = 0; i < chunks.size(); ++i) EXPECT_EQ(chunks[i], i + 1);
    EXPECT_GE(run.waits.size(), GetParam() == "gantry-3axis" ? 0U : chunks.size()) << "each chunk waits for its speed";
}

// Every straight move of the manifest's first chunk: its last point is where the step of the last such line ends.
TEST_P(ExecutedPrograms, StandAtTheEndOfALineWhereTheLineSays) {
    const ReceivedProgram program = received(proven().input);
    ASSERT_TRUE(program.run) << program.fault;
    const JobChunk& chunk = proven().job.program->chunks.front();
    const auto near = [&](Vec3 point) {
        return std::ranges::count_if(program.run->steps, [&](const RunStep& step) {
            return chunk_of_block(step.block) == 1 && norm(step.tip - point) < 0.02;
        });
    };
    EXPECT_GE(near(chunk.first), 1);
    EXPECT_GE(near(chunk.last), 1);
}

TEST_P(ExecutedPrograms, OfALineThatIsNotKnownTellFileAndLine) {
    std::string changed = text();
    const std::size_t end = changed.rfind("\r\n", changed.size() - 3);
    const std::size_t line = static_cast<std::size_t>(std::count(changed.begin(), changed.begin() + end, '\n')) + 2;
    changed.insert(end + 2, "FROBNICATE 7\r\n");
    const ReceivedProgram program = with_text(changed);
    EXPECT_FALSE(program.run);
    EXPECT_EQ(program.fault_line, line) << program.fault;
    EXPECT_NE(program.fault.find(chunk_file()), std::string::npos) << program.fault;
}

TEST_P(ExecutedPrograms, OfAnotherEncodingOrATruncatedChunkTellTheFile) {
    std::string wide;
    for (const char c : text()) wide.append({c, '\0'});
    const std::string truncated = text().substr(0, text().size() / 2);
    for (const std::string& changed : {"\xFF\xFE" + wide, "\xEF\xBB\xBF" + text(), truncated, std::string()}) {
        const ReceivedProgram program = with_text(changed);
        EXPECT_FALSE(program.run);
        EXPECT_NE(program.fault.find(chunk_file()), std::string::npos) << program.fault;
    }
}

TEST_P(ExecutedPrograms, OfWhatIsNoJobTellTheName) {
    const ReceivedProgram program = executed_program({'P', 'K', 3, 4}, "B.qjob", proven().cell.cell);
    EXPECT_FALSE(program.run);
    EXPECT_NE(program.fault.find("B.qjob"), std::string::npos) << program.fault;
}

TEST_P(ExecutedPrograms, AreNoneOfAJobWithoutAProgramOrACellWithoutAMachine) {
    JobInput input = proven().input;
    input.program.reset();
    const ReceivedProgram program = received(input);
    EXPECT_FALSE(program.run);
    EXPECT_EQ(program.fault, "");
    Cell cell = proven().cell.cell;
    cell.machine.reset();
    EXPECT_FALSE(program_reader(cell));
}

TEST_P(ExecutedPrograms, LeaveTheBlockAsItStandsAtThatMoment) {
    const Bytes job = job_file(proven().input);
    const Cell& cell = proven().cell.cell;
    const double whole_s = received(proven().input).run->seconds;
    const Bytes before = block_picture(job, "A.qjob", cell, 0);
    const Bytes within = block_picture(job, "A.qjob", cell, whole_s / 2);
    const Bytes after = block_picture(job, "A.qjob", cell, whole_s);
    EXPECT_TRUE(before != within && within != after && before != after);
    EXPECT_TRUE(block_picture(job, "A.qjob", cell, whole_s + 1) == after) << "it has ended";
    EXPECT_TRUE(block_picture(job, "A.qjob", cell, whole_s / 2) == within);
    JobInput without = proven().input;
    without.program.reset();
    EXPECT_THROW(block_picture(job_file(without), "A.qjob", cell, 0), InputError);
}

TEST_P(ExecutedPrograms, InAnotherLanguageAreRefused) {
    Cell cell = proven().cell.cell;
    Dialect& dialect = cell.machine->program.dialect;
    dialect = dialect == Dialect::rapid ? Dialect::krl : Dialect::rapid;
    const ReceivedProgram program = executed_program(job_file(proven().input), "A.qjob", cell);
    EXPECT_FALSE(program.run);
    EXPECT_NE(program.fault.find("dialect"), std::string::npos) << program.fault;
}

INSTANTIATE_TEST_SUITE_P(Cells, ExecutedPrograms,
                         testing::Values("kr60-ha", "kr120-r2500-pro-rotary", "irb6640-185-2.8", "gantry-3axis"));

}  // namespace
}  // namespace qchopper
