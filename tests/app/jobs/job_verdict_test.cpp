// The verdict beside a job: written, read back, and refused where it was changed by hand.

#include "app/jobs/job_verdict.h"

#include <gtest/gtest.h>

#include <fstream>

#include "app/jobs/verdict_schema.h"
#include "base/error.h"
#include "base/files/temporary_folder.h"
#include "tests/json_schema.h"

namespace qchopper {
namespace {

JobVerdict some_verdict() {
    JobVerdict verdict;
    verdict.piece = "B";
    verdict.job = "B.qjob";
    verdict.job_sha256 = sha256({});
    verdict.cell = "kr60-ha";
    verdict.cell_sha256.bytes[3] = 7;
    verdict.program_version = "0.1.0";
    verdict.figures = {{"max_gouge_mm", "largest gouge", 0.0625, "mm", 3}, {"reachable", "reachable", 96.25, "%", 1}};
    verdict.time.resize(2);
    verdict.time[0].operation = "roughing";
    verdict.time[0].tool = 3;
    verdict.time[0].tool_mm3_per_s = 24000;
    verdict.time[0].cutting_s = 17.5;
    verdict.time[0].short_lines = 9;
    verdict.time[1].operation = "fine finishing";
    verdict.time[1].tool_change_s = 60;
    verdict.time[1].tool_changes = 1;
    verdict.findings = {{"rapid_in_foam", "qc_2_001.src", 17, "a rapid move removes foam"},
                        {"leftover", "", 0, "foam"}};
    verdict.findings_left_out = 4;
    verdict.notes = {"no arm posture reaches 6 mm of its cuts"};
    return verdict;
}

std::string refusal(const std::string& text) {
    try {
        job_verdict_from_json(text, "B.verdict.json");
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::mesh);
        return error.what();
    }
    return "taken";
}

std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(JobVerdict, IsReadAsItWasWritten) {
    const JobVerdict verdict = some_verdict();
    EXPECT_EQ(job_verdict_from_json(to_json(verdict), "B.verdict.json"), verdict);
    JobVerdict good = verdict;
    good.findings.clear();
    good.is_positive = true;
    EXPECT_EQ(job_verdict_from_json(to_json(good), "B.verdict.json"), good);
    const SchemaJson schema = SchemaJson::parse(verdict_schema());
    for (const JobVerdict& valid : {verdict, good}) {
        EXPECT_EQ(schema_faults(schema, SchemaJson::parse(to_json(valid))), std::vector<std::string>());
    }
}

TEST(JobVerdict, ThePageOfTheFormatHasTheKeysOfTheTables) {
    expect_keys_of_page("verdict.md", "verdict  = ", {verdict_schema()},
                        {"verdict", "object", "in", "the", "one", "form", "of", "all", "files", "a", "project"});
}

TEST(JobVerdict, StandsBesideTheJob) {
    const TemporaryFolder folder("qchopper-verdict-");
    const std::filesystem::path job = folder.path() / "B.p2.qjob";
    EXPECT_EQ(verdict_file(job).filename(), "B.p2.verdict.json");
    EXPECT_FALSE(read_verdict(job));
    write_verdict(job, some_verdict());
    EXPECT_EQ(read_verdict(job), some_verdict());
    std::ofstream(verdict_file(job)) << "{";
    EXPECT_THROW(read_verdict(job), InputError);
}

TEST(JobVerdict, ChangesByHandAreRefused) {
    const std::string text = to_json(some_verdict());
    EXPECT_NE(refusal(with(text, "\"positive\": false", "\"positive\": true")).find("contradicts"), std::string::npos);
    EXPECT_NE(refusal(with(text, "\"schema\": 3", "\"schema\": 2")).find("schema"), std::string::npos);
    EXPECT_NE(refusal(with(text, "qchopper verdict", "qchopper job")).find("format"), std::string::npos);
    EXPECT_NE(refusal(with(text, "\"decimals\": 3", "\"decimals\": 30")).find("decimals"), std::string::npos);
    EXPECT_NE(refusal(with(text, "\"cutting_s\": 17.5", "\"cutting_s\": -17.5")).find("cutting_s"), std::string::npos);
    EXPECT_NE(refusal(with(text, "\"short_lines\": 9", "\"short_lines\": 9.5")).find("short_lines"), std::string::npos);
    EXPECT_NE(refusal(with(text, "\"line\": 17", "\"line\": -1")).find("line"), std::string::npos);
    EXPECT_NE(refusal(with(text, "\"no arm posture reaches 6 mm of its cuts\"", "6")).find("notes"), std::string::npos);
    EXPECT_NE(refusal(text + " ").find("the one form"), std::string::npos);
    EXPECT_NE(refusal(text.substr(0, text.size() / 2)), "taken");
}

TEST(JobVerdict, FindingsNameFileAndLine) {
    const JobVerdict verdict = some_verdict();
    EXPECT_EQ(describe(verdict.findings[0]), "qc_2_001.src line 17: a rapid move removes foam");
    EXPECT_EQ(describe(verdict.findings[1]), "foam");
    EXPECT_EQ(describe({"syntax", "qc_2.src", 0, "it has no END"}), "qc_2.src: it has no END");
}

}  // namespace
}  // namespace qchopper
