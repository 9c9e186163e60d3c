#include "tests/app/jobs/proven_job.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "app/jobs/piece_program.h"
#include "base/error.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "sim/program/chunk_summary.h"
#include "sim/replay/read_program.h"
#include "tests/app/ball_cap.h"

namespace qchopper {
namespace {

constexpr const char* version = "0.1.0";

std::string stem_of(const std::string& file) {
    return file.substr(0, file.find('.'));
}

// The chunks that are called, with tool and direction of the chunk of this name.
std::vector<JobChunk> called(const JobProgram& program, const ProgramFiles& files) {
    std::vector<JobChunk> chunks;
    for (const std::string& name : called_chunks(files, stem_of(program.entry))) {
        for (const JobChunk& chunk : program.chunks) {
            if (stem_of(chunk.file) == name)
                chunks.push_back({chunk.file, chunk.tool, chunk.orientation, 0, 0, {}, {}, {}});
        }
    }
    return chunks;
}

void fill_in(JobProgram& program, const ProgramFiles& files, const Cell& cell) {
    try {
        const auto read = summarise_chunks(read_program(program.dialect, files, stem_of(program.entry), cell));
        for (std::size_t i = 0; i < std::min(read.size(), program.chunks.size()); ++i) {
            JobChunk& chunk = program.chunks[i];
            chunk = {chunk.file,     chunk.tool,  chunk.orientation, read[i].moves,
                     read[i].length, read[i].box, read[i].first,     read[i].last};
        }
    } catch (const InputError&) {  // nothing to state of a text that cannot be read
    }
}

}  // namespace

ProvenJob made_and_proven(const std::string& cell_name, const Piece& piece, const CapsOf& caps, FineTools fine,
                          const std::function<void(Cell&)>& change) {
    ProvenJob made;
    made.cell = read_cell_file(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / (cell_name + ".toml"));
    if (change) change(made.cell.cell);
    JobInput input;
    input.piece = piece;
    input.program_version = version;
    input.cell = made.cell.cell;
    Setups setups(input.cell);
    setups.place({&input.piece, 1}, {});
    const PlacedSetup& piece_setup = setups.placed(input.piece);
    EXPECT_TRUE(piece_setup.fits());
    input.setup = piece_setup.setup();
    input.stock_fit = piece_setup.stock_fit;
    input.machine_reachability = piece_setup.machine_reachability;
    if (caps) input.caps = caps(input.setup);
    PiecePrograms programs = make_programs(input.piece, piece_setup, {1}, input.cell, input.caps, {}, fine);
    input.caps = programs.caps;
    if (programs.parts.size() != 1) throw std::runtime_error("no single program: " + programs.none_because);
    input.program = programs.parts.front().input;
    made.job = parse_job(job_file(input), "A.qjob");
    made.verdict = judged(made.job, made.cell);
    EXPECT_EQ(made.verdict.figures, programs.parts.front().proof.figures) << "verify repeats the proof of prepare";
    EXPECT_EQ(made.verdict.time, programs.parts.front().proof.time);
    EXPECT_EQ(made.verdict.findings, programs.parts.front().proof.findings);
    made.input = std::move(input);
    return made;
}

const ProvenJob& proven_job(const std::string& cell_name) {
    static std::map<std::string, ProvenJob> jobs;
    const auto known = jobs.find(cell_name);
    return known != jobs.end()
               ? known->second
               : jobs.emplace(cell_name, made_and_proven(cell_name, uncut(ball_cap(), 0).pieces.front())).first->second;
}

JobVerdict judged(const ReadJob& job, const CellFile& cell) {
    return judge_job(job, "A.qjob", cell, version, {});
}

ProgramFiles texts_of(const ReadJob& job) {
    ProgramFiles files;
    for (const std::string& name : job.program->files) {
        const Bytes& bytes = job.files.at(name);
        files.push_back({name, {bytes.begin(), bytes.end()}});
    }
    return files;
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

}  // namespace qchopper
