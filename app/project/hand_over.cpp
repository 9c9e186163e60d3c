// Every job file is read and hashed whole before the first one is sent. O(bytes), which are kept in memory.

#include "app/project/hand_over.h"

#include "app/project/ordered_job.h"
#include "app/project/project_folder.h"
#include "app/project/shell_word.h"
#include "base/error.h"
#include "base/text.h"
#include "base/timings.h"
#include "cam/job/read_job.h"

namespace qchopper {
namespace {

// Nothing if prepare wrote no job for the piece, because it does not fit.
std::optional<PieceJob> job_of(const JobOrder& order) {
    std::error_code error;
    const bool is_there = std::filesystem::exists(std::filesystem::symlink_status(order.file, error));
    if (written_job_of(order.project, order.piece) == nullptr) {
        if (is_there) refuse_unrecorded(order.folder, order.file);
        return std::nullopt;
    }
    if (!is_there) {
        throw InputError(InputFault::missing, order.file.string() + " is gone",
                         "write the jobs again: qchopper prepare " + shell_word(order.folder));
    }
    Bytes bytes = read_job(order.file);
    const ReadJob job = parse_job(bytes, order.file.string());
    check_ordered(job, order);
    const JobTicket ticket = job_ticket(job, order.file.filename().string());
    return PieceJob{order.piece, std::move(bytes), ticket, job.setup.reach.unreachable_share(), job.max_unreachable};
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
    ProjectJobs found{read_cell(folder / "cell.toml"), {}};
    for (const SolidRecord& record : project.pieces) {
        if (piece && record.name != *piece) continue;
        const JobOrder order{project, record.name, found.cell, folder, folder / "jobs" / job_file_name(record.name)};
        if (std::optional<PieceJob> job = job_of(order)) {
            found.jobs.push_back(std::move(*job));
        } else if (piece) {  // without it the pieces that do not fit are left out
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
