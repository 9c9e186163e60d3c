// Measures the replay of a job's program: CPU time beside the time that the program takes on the machine, and memory.

#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "app/jobs/job_proof.h"
#include "base/error.h"
#include "base/timings.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "cam/job/job_caps.h"
#include "cam/job/read_job.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = "bench_replay JOB CELL\n  JOB   an undivided job, or the first part, with a program\n";
constexpr double min_ratio = 100;  // of the program's time to that of its replay at 1 mm

struct Replayed {
    double cpu_s = 0;
    double program_s = 0;
};

Replayed replayed(const ReadJob& job, const Cell& cell, double replay_cell) {
    const TriangleMesh mesh = job_mesh(job.files.at("piece.stl"), job.piece);
    std::map<std::string, std::string> texts;
    for (const std::string& name : job.program->files) {
        const Bytes& bytes = job.files.at(name);
        texts[name] = {bytes.begin(), bytes.end()};
    }
    const double started = process_cpu_s();
    ProofInput input{cell, job.setup, job.setup_in_cell, mesh, *job.program, texts};
    input.holes = holes_of(job.caps);
    input.half_spaces = job.half_spaces;
    input.replay_cell = replay_cell;
    const JobProof proof = prove(input);
    return {process_cpu_s() - started, proof.time_s};
}

int measure(const std::string& job_file, const std::string& cell_file) {
    const ReadJob job = parse_job(read_job(job_file), job_file);
    const Cell cell = read_cell(cell_file);
    if (!job.program || job.program->part.number != 1) throw InputError(InputFault::use, usage);
    Figures figures;
    for (const double replay_cell : {1.0, 0.25}) {
        const Replayed run = replayed(job, cell, replay_cell);
        const std::string at = "replay at " + number_text(replay_cell) + " mm";
        const double ratio = run.program_s / run.cpu_s;
        figures.record(job.piece, "program", time_text(run.program_s));
        figures.record(job.piece, at + ", CPU time", time_text(run.cpu_s));
        if (replay_cell == 1) {
            figures.at_least(job.piece, at + ", times faster than real time", ratio, min_ratio);
        } else {
            figures.record(job.piece, at + ", times faster than real time", number_text(ratio));
        }
        const double peak_mb = 1e-6 * static_cast<double>(Timings().so_far().peak_memory_bytes);
        figures.record(job.piece, at + ", peak memory so far", number_text(peak_mb) + " MB");
    }
    figures.print(std::cout);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << usage;
        return 64;
    }
    try {
        return measure(argv[1], argv[2]);
    } catch (const InputError& error) {
        std::cerr << error.what() << "\n";
        return 66;
    }
}
