// Named faults in the programs that the post writes for a real piece: names, sizes and hashes are made again, and what
// the manifest says of each chunk is taken from the changed text, so that reading and replay alone can refuse it.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "sim/program/chunk_summary.h"
#include "tests/app/jobs/proven_job.h"
#include "tests/sim/replay/mutations.h"

namespace qchopper {
namespace {

// Changes of one place, where the piece may stay whole and no rule be broken: a point above what is cut anyway, a way
// over foam that is gone already, a cut of a little foam that finishing cuts too. One that is not refused is listed and
// not counted.
const std::set<std::string> may_be_equivalent{"point_lowered", "point_moved_x",     "point_moved_y",
                                              "retract_lost",  "last_retract_lost", "last_roughing_lost",
                                              "target_raised"};

struct MutatedJobs : ::testing::TestWithParam<std::string> {
    // All mutations are tried in one process: the job is made once.
    void expect_each_is_refused() const {
        const ProvenJob& proven = proven_job(GetParam());
        const JobVerdict as_made = judged(remade(proven, texts_of(proven.job)), proven.cell);
        ASSERT_TRUE(as_made.is_positive) << describe(as_made.findings.front());
        std::size_t refused = 0;
        for (const Mutation& mutation : mutations_of(proven_job(GetParam()).cell.cell.machine->program.dialect)) {
            const auto mutant = mutation.apply(texts_of(proven.job));
            if (!mutant) {
                std::printf("%s: no place for it\n", mutation.name.c_str());
                continue;
            }
            const JobVerdict verdict = judged(remade(proven, *mutant), proven.cell);
            if (verdict.is_positive && may_be_equivalent.contains(mutation.name)) {
                std::printf("%s: equivalent\n", mutation.name.c_str());
                continue;
            }
            EXPECT_FALSE(verdict.is_positive) << mutation.name;
            if (verdict.is_positive) continue;
            ++refused;
            std::printf("%s: %s\n", mutation.name.c_str(), describe(verdict.findings.front()).c_str());
        }
        EXPECT_GE(refused, 80U);
    }
};

TEST_P(MutatedJobs, EachIsRefused) {
    expect_each_is_refused();
}

// Two millimetres of foam are within a tolerance of 2.5 mm, which the manifest asks for and the cell file does not.
TEST_P(MutatedJobs, TheManifestWidensNoTolerance) {
    const ProvenJob& proven = proven_job(GetParam());
    const std::vector<Mutation> all = mutations_of(proven_job(GetParam()).cell.cell.machine->program.dialect);
    const auto higher =
        std::find_if(all.begin(), all.end(), [](const Mutation& m) { return m.name == "all_2_mm_higher"; });
    ASSERT_NE(higher, all.end());
    ReadJob job = remade(proven, *higher->apply(texts_of(proven.job)));
    job.program->scallop_mm = 2;
    std::set<std::string> kinds;
    for (const ProofFinding& finding : judged(job, proven.cell).findings) kinds.insert(finding.kind);
    EXPECT_TRUE(kinds.contains("other_scallop"));
    EXPECT_TRUE(kinds.contains("leftover"));
}

INSTANTIATE_TEST_SUITE_P(Kuka, MutatedJobs, ::testing::Values("kr60-ha", "kr120-r2500-pro-rotary"));
INSTANTIATE_TEST_SUITE_P(OtherDialects, MutatedJobs, ::testing::Values("irb6640-185-2.8", "gantry-3axis"));

}  // namespace
}  // namespace qchopper
