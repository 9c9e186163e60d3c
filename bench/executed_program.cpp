// Measures what the simulated cell needs to execute the program of a job: CPU time to read it and to follow it on the
// machine, and of one look at where it is.

#include <filesystem>
#include <iostream>
#include <string>

#include "app/dispatch/executed_program.h"
#include "app/jobs/job_scene.h"
#include "base/error.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "cam/job/read_job.h"
#include "sim/program/parsed_program.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = "bench_executed_program JOB CELL\n  JOB   a job with a program\n";
constexpr double read_bytes = 3e6;  // in at most one second
constexpr int looks = 1'000'000;

int measure(const std::string& job_file, const std::string& cell_file) {
    const Bytes bytes = read_job(job_file);
    const Cell cell = read_cell(cell_file);
    const ReadJob job = parse_job(bytes, job_file);
    if (!job.program || !cell.machine) throw InputError(InputFault::use, usage);
    const JobContents contents(job, job_file);
    const ProofInput input = contents.input(cell);
    double size = 0;
    for (const auto& [name, text] : input.texts) size += static_cast<double>(text.size());
    const double read_s = best_of(3, cpu_s, [&] { return program_read_back(input); });
    ReceivedProgram received;
    const double all_s = best_of(3, cpu_s, [&] { return received = executed_program(bytes, job_file, cell); });
    if (!received.run) throw InputError(InputFault::mesh, received.fault);
    const JobRun& run = *received.run;
    double sum = 0;
    const double look_s = best_of(3, cpu_s, [&] {
        for (int i = 0; i < looks; ++i) sum += place_at(run, run.seconds * i / looks).tip.x;
        return sum;
    });
    Figures figures;
    figures.record(job.piece, "program", number_text(1e-6 * size) + " MB, " + time_text(run.seconds));
    figures.at_most(job.piece, "3 MB of it read, s of CPU", read_s * read_bytes / size, 1);
    figures.record(job.piece, "job read, program followed, CPU time", time_text(all_s));
    figures.at_least(job.piece, "the program's time to that", run.seconds / all_s, 9000);
    figures.record(job.piece, "one look at where it is, CPU time", time_text(look_s / looks));
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
