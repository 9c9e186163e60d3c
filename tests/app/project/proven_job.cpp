#include "tests/app/project/proven_job.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "app/project/piece_program.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "tests/app/ball_cap.h"

namespace qchopper {
namespace {

constexpr const char* version = "0.1.0";

}  // namespace

ProvenJob made_and_proven(const std::string& cell_name, const Piece& piece, const CapsOf& caps) {
    ProvenJob made;
    made.cell = read_cell_file(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / (cell_name + ".toml"));
    JobInput input;
    input.piece = piece;
    input.program_version = version;
    input.cell = made.cell.cell;
    Setups setups(input.cell);
    setups.compute_held({&input.piece, 1}, {});
    const Carving& carving = setups.held(input.piece);
    EXPECT_TRUE(carving.fits());
    input.setup = carving.setup();
    input.envelope = carving.envelope;
    input.work_envelope = carving.work_envelope;
    if (caps) input.caps = caps(input.setup);
    PiecePrograms programs = make_programs(input.piece, carving, 1, input.cell, input.caps, {});
    input.caps = programs.caps;
    if (programs.parts.size() != 1) throw std::runtime_error("no single program: " + programs.none_because);
    input.program = programs.parts.front().input;
    made.job = parse_job(job_file(input), "A.qjob");
    made.verdict = judged(made.job, made.cell);
    EXPECT_EQ(made.verdict.figures, programs.parts.front().proof.figures) << "verify repeats the proof of prepare";
    EXPECT_EQ(made.verdict.findings, programs.parts.front().proof.findings);
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

}  // namespace qchopper
