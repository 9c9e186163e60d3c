// The job that is stopped has to be proven by this cell file; then its restart differs from it in the stock, in the
// main program and in nothing else. The cost is that of make_restart().

#include "app/dispatch/restart_dispatch.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/dispatch/proven_jobs.h"
#include "app/dispatch/restart_job.h"
#include "app/dispatch/verify_jobs.h"
#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/text.h"
#include "base/timings.h"
#include "cam/job/read_job.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// The part of the piece that holds the chunk.
struct Place {
    std::size_t job = 0;              // index in ProjectJobs::jobs
    std::uint32_t chunks_before = 0;  // of the parts before
};

Place place_of(const ProjectJobs& ordered, std::uint32_t chunk) {
    Place place;
    for (; place.job < ordered.jobs.size(); ++place.job) {
        const auto own = static_cast<std::uint32_t>(ordered.jobs[place.job].chunks);
        if (chunk > place.chunks_before && chunk <= place.chunks_before + own) return place;
        place.chunks_before += own;
    }
    const PieceJob& piece = ordered.jobs.front();
    if (place.chunks_before == 0) {
        throw InputError(InputFault::use,
                         "piece " + piece.piece + " has no robot program to restart: " + piece.no_program_because);
    }
    throw InputError(InputFault::use,
                     "piece " + piece.piece + " has no chunk " + std::to_string(chunk) + ": its program has " +
                         counted(place.chunks_before, "chunk"),
                     "give a number from 2 to " + std::to_string(place.chunks_before) +
                         ": that in the name of the program file in which the machine stood");
}

void write_if_new(const fs::path& file, const Bytes& bytes) {
    std::error_code error;
    if (fs::exists(file, error) && read_job(file) == bytes) return;
    write_file(file, bytes);
}

void tell(const MadeRestart& made, const std::string& ordered_file, const ProjectContext& context) {
    if (made.from_chunk != made.ordered_chunk) {
        context.message(ordered_file + " cannot be started from home: the restart begins with " + made.chunk_file +
                        ", the last one before it that can");
    }
    context.message(made.job + " begins with " + made.chunk_file + " in the stock that the chunks before it leave; " +
                    "what the stopped chunk has removed already is carved once more, in air");
}

}  // namespace

MadeRestart put_restart_in_place(ProjectJobs& ordered, std::uint32_t chunk, const std::string& program_version,
                                 const ProjectContext& context) {
    const StageTimer stage(context, "restart made");
    const ProjectLock lock(ordered.folder);
    MadeRestart made;
    made.ordered_chunk = chunk;
    const Place place = place_of(ordered, chunk);
    std::swap(ordered.jobs.front(), ordered.jobs[place.job]);
    ordered.jobs.resize(1);
    for (const std::string& why : unproven_jobs(ordered, true)) made.refused.emplace_back(why);
    if (!made.refused.empty()) return made;
    PieceJob& job = ordered.jobs.front();
    const std::string source = job.ticket.file_name;
    const ReadJob first = parse_job(job.file, source);
    const std::size_t index = chunk - 1 - place.chunks_before;
    const RestartJob restart = make_restart({first, source, ordered.cell, index, place.chunks_before}, context);
    made.from_chunk = static_cast<std::uint32_t>(place.chunks_before + restart.chunk + 1);
    made.chunk_file = first.program->chunks[restart.chunk].file;
    made.job = restart.name;
    made.of = first.file_sha256;
    tell(made, first.program->chunks[index].file, context);
    const fs::path file = ordered.folder / "jobs" / restart.name;
    const ReadJob read = parse_job(restart.file, file.string());
    JobVerdict verdict = unjudged(read, file.string(), {ordered.cell, ordered.cell_sha256}, program_version);
    static_cast<ProofResult&>(verdict) = restart.proof;
    verdict.is_positive = restart.proof.is_proven();
    write_if_new(file, restart.file);
    write_verdict(file, verdict);
    ordered.jobs = {piece_job(file, restart.file)};
    for (const std::string& why : unproven_jobs(ordered, true)) made.refused.emplace_back(why);
    return made;
}

}  // namespace qchopper
