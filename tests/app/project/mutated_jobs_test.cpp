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

// Changes of one place, where the piece may stay whole and no rule be broken: a point above what is cut anyway, a way
// over foam that is gone already. One that is not refused is listed and not counted.
const std::set<std::string> may_be_equivalent{"point_lowered", "point_moved_x", "point_moved_y", "retract_lost",
                                              "last_retract_lost"};

// Of these the list of chunks in the manifest tells more than the replay can: what is reachable is that of the tools
// that are left, so that without the last chunk of fine finishing the piece may be within tolerance all the same.
const std::set<std::string> seen_in_manifest{"chunk_lost"};

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
        for (const Mutation& mutation : all_mutations()) {
            const auto mutant = mutation.apply(texts_of(proven.job));
            if (!mutant) {
                std::printf("%s: no place for it\n", mutation.name.c_str());
                continue;
            }
            const JobVerdict verdict = judged(remade(proven, *mutant), proven.cell);
            if (verdict.is_positive && seen_in_manifest.contains(mutation.name)) {
                ReadJob listed = remade(proven, *mutant);
                listed.program->chunks = proven.job.program->chunks;
                EXPECT_FALSE(judged(listed, proven.cell).is_positive) << mutation.name;
                std::printf("%s: seen in the manifest\n", mutation.name.c_str());
                continue;
            }
            if (verdict.is_positive && may_be_equivalent.contains(mutation.name)) {
                std::printf("%s: equivalent\n", mutation.name.c_str());
                continue;
            }
            EXPECT_FALSE(verdict.is_positive) << mutation.name;
            if (verdict.is_positive) continue;
            ++refused;
            std::printf("%s: %s\n", mutation.name.c_str(), describe(verdict.findings.front()).c_str());
        }
        EXPECT_GE(refused, 25U);
    }
};

TEST_P(MutatedJobs, EachIsRefused) {
    expect_each_is_refused();
}

INSTANTIATE_TEST_SUITE_P(Kuka, MutatedJobs, ::testing::Values("kr60-ha", "kr120-r2500-pro-rotary"));

}  // namespace
}  // namespace qchopper
