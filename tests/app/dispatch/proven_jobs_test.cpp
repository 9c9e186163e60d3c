// Which jobs go to which cell, by program and verdict.

#include "app/dispatch/proven_jobs.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

// A job with a program and a positive verdict, by the cell file of the project.
PieceJob good_job(const std::string& piece) {
    PieceJob job;
    job.piece = piece;
    job.ticket.file_name = piece + ".qjob";
    job.ticket.file_sha256.bytes[0] = static_cast<std::uint8_t>(piece.front());
    job.verdict.emplace();
    job.verdict->job_sha256 = job.ticket.file_sha256;
    job.verdict->is_positive = true;
    return job;
}

ProjectJobs jobs_with(std::vector<PieceJob> jobs) {
    ProjectJobs all;
    all.folder = "x.qch";
    all.jobs = std::move(jobs);
    return all;
}

void expect(const ProjectJobs& jobs, const std::string& to_any, const std::string& to_real) {
    const auto single = [](const std::vector<std::string>& sentences) {
        EXPECT_LE(sentences.size(), 1U);
        return sentences.empty() ? std::string() : sentences.front();
    };
    EXPECT_EQ(single(unproven_jobs(jobs, false)), to_any);
    EXPECT_EQ(single(unproven_jobs(jobs, true)), to_real);
}

TEST(ProvenJobs, APositiveVerdictOnTheseBytesGoesAnywhere) {
    const ProjectJobs jobs = jobs_with({good_job("B"), good_job("C")});
    expect(jobs, "", "");
    EXPECT_TRUE(simulated_only_jobs(jobs).empty());
}

TEST(ProvenJobs, ANegativeVerdictGoesNowhere) {
    ProjectJobs jobs = jobs_with({good_job("B"), good_job("C")});
    jobs.jobs[1].verdict->is_positive = false;
    jobs.jobs[1].verdict->findings = {{"gouge", "qc_2_001.src", 9, "the tool cuts 3 mm into the piece"}};
    const std::string why =
        "piece C: its verdict is negative: qc_2_001.src line 9: the tool cuts 3 mm into the piece; see qchopper verify "
        "x.qch";
    expect(jobs, why, why);
}

TEST(ProvenJobs, AVerdictOnOtherBytesGoesNowhere) {
    ProjectJobs jobs = jobs_with({good_job("B")});
    jobs.jobs[0].ticket.file_sha256.bytes[31] ^= 1U;
    const std::string other_job =
        "piece B: its verdict is that of other bytes of B.qjob; judge it again: qchopper verify x.qch";
    expect(jobs, other_job, other_job);
    jobs = jobs_with({good_job("B")});
    jobs.cell_sha256.bytes[0] = 1;
    const std::string other_cell =
        "piece B: its verdict is that of another cell file; judge it again: qchopper verify x.qch";
    expect(jobs, other_cell, other_cell);
}

TEST(ProvenJobs, WithoutProgramOrVerdictOnlyASimulatedCell) {
    ProjectJobs jobs = jobs_with({good_job("B"), good_job("C"), good_job("D")});
    jobs.jobs[1].verdict.reset();
    expect(jobs, "", "piece C: it has no verdict; make it: qchopper verify x.qch");
    for (PieceJob& job : jobs.jobs) {
        job.verdict.reset();
        job.no_program_because = "prepare was asked for none";
    }
    expect(jobs, "", "piece B and 2 others: it holds no robot program: prepare was asked for none");
    EXPECT_EQ(simulated_only_jobs(jobs).size(), 1U);
}

// A verdict of a job without a program is negative by its one finding; it must not pass for a proof.
TEST(ProvenJobs, AVerdictThatOnlySaysThatThereIsNoProgramIsNone) {
    ProjectJobs jobs = jobs_with({good_job("B")});
    jobs.jobs[0].no_program_because = "prepare was asked for none";
    jobs.jobs[0].verdict->is_positive = false;
    jobs.jobs[0].verdict->findings = {{"no_program", "", 0, "the job holds no robot program"}};
    expect(jobs, "", "piece B: it holds no robot program: prepare was asked for none");
}

// The project does not record a restart: its own file is to be signed.
TEST(ProvenJobs, ARestartIsSignedByItsFile) {
    ProjectJobs jobs = jobs_with({good_job("B")});
    jobs.cell.require_signature = true;
    const auto remedy = [&] {
        const std::vector<std::string> why = wrongly_signed_jobs(jobs, {}, 0);
        EXPECT_EQ(why.size(), 1U);
        return why.empty() ? "" : why.front().substr(why.front().find("qchopper keys sign"));
    };
    EXPECT_EQ(remedy(), "qchopper keys sign x.qch");
    jobs.jobs[0].restart = JobRestart{};
    jobs.jobs[0].ticket.file_name = "B.r5.qjob";
    EXPECT_EQ(remedy(), "qchopper keys sign x.qch/jobs/B.r5.qjob");
}

}  // namespace
}  // namespace qchopper
