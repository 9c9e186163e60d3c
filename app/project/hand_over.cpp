// Every job file is read and hashed whole before the first one is sent. O(bytes), which are kept in memory.

#include "app/project/hand_over.h"

#include <iterator>

#include "app/project/ordered_job.h"
#include "app/project/project_folder.h"
#include "app/project/shell_word.h"
#include "base/error.h"
#include "base/text.h"
#include "base/timings.h"
#include "cam/job/read_job.h"

namespace qchopper {
namespace {

PieceJob job_of(const JobOrder& order) {
    std::error_code error;
    if (!std::filesystem::exists(std::filesystem::symlink_status(order.file, error))) {
        throw InputError(InputFault::missing, order.file.string() + " is gone",
                         "write the jobs again: qchopper prepare " + shell_word(order.folder));
    }
    Bytes bytes = read_job(order.file);
    const ReadJob read = parse_job(bytes, order.file.string());
    check_ordered(read, order);
    PieceJob job;
    job.piece = order.piece;
    job.file = std::move(bytes);
    job.ticket = job_ticket(read, order.file.filename().string());
    if (read.program) {
        job.part = read.program->part.number;
        job.parts = read.program->part.count;
    }
    job.no_program_because = read.no_program_because;
    job.verdict = read_verdict(order.file);
    job.unreachable_share = read.setup.reach.unreachable_share();
    job.max_unreachable = read.max_unreachable;
    return job;
}

// None if prepare wrote no job for the piece, because it does not fit.
std::vector<PieceJob> jobs_of_piece(const std::filesystem::path& folder, const Project& project,
                                    const std::string& piece, const Cell& cell) {
    const std::vector<WrittenJob> written = written_jobs_of(project, piece);
    std::error_code error;
    const std::filesystem::path first = folder / "jobs" / job_file_name(piece);
    if (written.empty() && std::filesystem::exists(std::filesystem::symlink_status(first, error))) {
        refuse_unrecorded(folder, first);
    }
    std::vector<PieceJob> jobs;
    for (const WrittenJob& job : written) {
        jobs.push_back(job_of({project, piece, job, cell, folder, folder / "jobs" / job_file_name(piece, job.part)}));
    }
    return jobs;
}

}  // namespace

ProjectJobs jobs_of(const std::filesystem::path& folder, const std::optional<std::string>& piece,
                    const Context& context) {
    const StageTimer stage(context, "jobs read");
    const Project project = load_project(folder);
    if (project.stage != Stage::done) {
        throw InputError(InputFault::use, folder.string() + " is not finished",
                         "finish it first: qchopper prepare " + shell_word(folder));
    }
    ProjectJobs found{
        folder, read_cell(folder / "cell.toml"), sha256(read_file(folder / "cell.toml", settings_limit)), {}};
    for (const SolidRecord& record : project.pieces) {
        if (piece && record.name != *piece) continue;
        std::vector<PieceJob> jobs = jobs_of_piece(folder, project, record.name, found.cell);
        std::move(jobs.begin(), jobs.end(), std::back_inserter(found.jobs));
        if (jobs.empty() && piece) {  // without it the pieces that do not fit are left out
            throw InputError(InputFault::missing, "piece " + *piece + " has no job",
                             "it does not fit the cell; see the table that prepare printed");
        }
    }
    if (found.jobs.empty()) {
        throw InputError(piece ? InputFault::use : InputFault::missing,
                         piece ? "there is no piece " + *piece + " in " + folder.string()
                               : folder.string() + " holds no job that fits",
                         "see the table that prepare printed");
    }
    return found;
}

std::vector<std::string> unreachable_jobs(const std::vector<PieceJob>& jobs) {
    std::vector<std::string> sentences;
    for (const PieceJob& job : jobs) {
        if (!job.is_unreachable()) continue;
        sentences.push_back("piece " + job.piece + ": the tool does not reach " +
                            fixed(100 * job.unreachable_share, 2) + " % of its surface, and the limit is " +
                            fixed(100 * job.max_unreachable, 2) + " %");
    }
    return sentences;
}

std::vector<HandedOver> hand_over(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options,
                                  const ProjectContext& context) {
    const StageTimer stage(context, "jobs handed over");
    std::vector<HandedOver> handed;
    for (const PieceJob& job : jobs) {
        context.message("piece " + job.piece + ": " + job.ticket.file_name + ", " + with_commas(job.ticket.file_size) +
                        " bytes");
        handed.push_back({job.piece, dispatch_job(bus, job.ticket, job.file, options, context)});
        if (!handed.back().outcome.is_complete()) break;
        context.saved("The " + std::to_string(handed.size()) + " jobs before it ended complete; it was not started.");
    }
    return handed;
}

}  // namespace qchopper
