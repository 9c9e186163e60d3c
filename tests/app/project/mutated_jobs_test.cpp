// Named faults in the programs that the post writes for a real piece: names, sizes and hashes are made again, and what
// the manifest says of each chunk is taken from the changed text, so that reading and replay alone can refuse it.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "sim/program/chunk_summary.h"
#include "sim/program/krl_reader.h"
#include "sim/replay/machine_walk.h"
#include "tests/app/project/proven_job.h"
#include "tests/sim/replay/mutations.h"

namespace qchopper {
namespace {

// Of what a mutation does the piece may stay whole and no rule be broken: nothing to refuse. A piece of another shape
// may have others.
const std::set<std::string> equivalent{};

ProgramFiles texts_of(const ReadJob& job) {
    ProgramFiles files;
    for (const std::string& name : job.program->files) {
        const Bytes& bytes = job.files.at(name);
        files.push_back({name, {bytes.begin(), bytes.end()}});
    }
    return files;
}

std::string stem_of(const std::string& file) {
    return file.substr(0, file.find('.'));
}

// The chunks that are called, with tool and direction of the chunk of this name.
std::vector<JobChunk> called(const JobProgram& program, const ProgramFiles& files) {
    std::vector<JobChunk> chunks;
    for (const std::string& name : called_chunks(files, stem_of(program.entry))) {
        for (const JobChunk& chunk : program.chunks) {
            if (stem_of(chunk.file) == name)
                chunks.push_back({chunk.file, chunk.tool, chunk.direction, 0, 0, {}, {}, {}});
        }
    }
    return chunks;
}

void fill_in(JobProgram& program, const ProgramFiles& files, const Cell& cell) {
    try {
        const auto read = summarise_chunks(read_krl(files, stem_of(program.entry), {called_programs(cell)}));
        for (std::size_t i = 0; i < std::min(read.size(), program.chunks.size()); ++i) {
            JobChunk& chunk = program.chunks[i];
            chunk = {chunk.file,     chunk.tool,  chunk.direction, read[i].moves,
                     read[i].length, read[i].box, read[i].first,   read[i].last};
        }
    } catch (const InputError&) {  // nothing to state of a text that cannot be read
    }
}

ReadJob remade(const ProvenJob& proven, const ProgramFiles& files) {
    ReadJob job = proven.job;
    JobProgram& program = *job.program;
    for (const std::string& name : program.files) job.files.erase(name);
    program.files.clear();
    for (const ProgramFile& file : files) {
        program.files.push_back(file.name);
        job.files[file.name] = {file.text.begin(), file.text.end()};
    }
    program.chunks = called(program, files);
    fill_in(program, files, proven.cell.cell);
    return job;
}

struct MutatedJobs : ::testing::TestWithParam<std::string> {
    // All mutations are tried in one process: the job is made once.
    void expect_each_is_refused() const {
        const ProvenJob& proven = proven_job(GetParam());
        const JobVerdict as_made = judged(remade(proven, texts_of(proven.job)), proven.cell);
        ASSERT_TRUE(as_made.is_positive) << describe(as_made.findings.front());
        std::size_t refused = 0;
        std::string listed;
        for (const Mutation& mutation : all_mutations()) {
            const auto mutant = mutation.apply(texts_of(proven.job));
            if (!mutant) {
                listed += mutation.name + ": no place for it\n";
                continue;
            }
            const JobVerdict verdict = judged(remade(proven, *mutant), proven.cell);
            if (equivalent.contains(mutation.name)) {
                listed += mutation.name + ": equivalent\n";
                continue;
            }
            EXPECT_FALSE(verdict.is_positive) << mutation.name;
            if (verdict.is_positive) continue;
            ++refused;
            listed += mutation.name + ": " + describe(verdict.findings.front()) + "\n";
        }
        EXPECT_GE(refused, 25U);
        std::printf("%s", listed.c_str());
    }
};

TEST_P(MutatedJobs, EachIsRefused) {
    expect_each_is_refused();
}

INSTANTIATE_TEST_SUITE_P(Kuka, MutatedJobs, ::testing::Values("kr60-ha", "kr120-r2500-pro-rotary"));

}  // namespace
}  // namespace qchopper
