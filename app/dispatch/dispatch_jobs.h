// What dry-run and dispatch share: finds the jobs of a project and hands them to a cell one after the other.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/jobs/job_verdict.h"
#include "app/store/project_context.h"
#include "base/files/file.h"
#include "cam/cell/cell.h"
#include "cam/job/ticket.h"
#include "devices/hand_off/dispatch.h"
#include "devices/journal/journal.h"
#include "devices/keys/job_signature.h"

namespace qchopper {

// Read once: the bytes that were checked are those that are sent.
struct PieceJob {
    std::string piece;
    Bytes file;
    JobTicket ticket;
    std::uint16_t part = 1;  // of `parts` that mill the piece in one clamping
    std::uint16_t parts = 1;
    std::size_t chunks = 0;             // of its program
    std::optional<JobRestart> restart;  // of a job that goes on with one that was stopped
    std::string no_program_because;     // empty: it holds a robot program
    std::optional<JobVerdict> verdict;  // the one beside it
    double unreachable_share = 0;       // of the surface
    double max_unreachable = 0;         // the limit of the job
    bool is_unreachable = false;        // more is out of reach than may be
    FoundSignature signature = {};      // beside the job file
    std::string holding_problem = {};   // with what to do about it; empty: it is held, or that was not checked
};

struct ProjectJobs {
    std::filesystem::path folder;
    Cell cell;
    Sha256 cell_sha256;          // of the cell file
    std::vector<PieceJob> jobs;  // at least one; the parts of a piece in their order
    bool is_finished = true;     // false: jobs may follow, prepare has not ended
};

// The jobs that the project ordered for its cell, in the order of its pieces; only that of one piece if it is named.
// Of an unfinished project, where that may be, the jobs that are written so far.
// Throws what load_project and read_cell throw, and InputError: (use) an unfinished project, no such piece; (missing)
// no job; (mesh) a job file that is broken or not the one that was ordered (ordered_job.h).
ProjectJobs jobs_of(const std::filesystem::path& project, const std::optional<std::string>& piece,
                    const Context& context, bool may_be_unfinished = false);

// A job file of these bytes as it is handed over, with the verdict and the signature that lie beside it. Throws
// InputError (mesh) if it is broken.
PieceJob piece_job(const std::filesystem::path& file, Bytes bytes);

// Per job whose state is "unreachable" one sentence without a full stop: the piece, its share and the limit.
std::vector<std::string> unreachable_jobs(const std::vector<PieceJob>& jobs);

// Per job whose piece is not held safely (cam/setup/workholding.h) one sentence without a full stop.
std::vector<std::string> jobs_failing_workholding(const std::vector<PieceJob>& jobs);

struct DispatchedJob {
    std::string piece;  // or the name of the job file, of a job that is not of this project
    JobOutcome outcome;
    bool is_ordered = true;  // false: a job of an earlier dispatcher that was not asked for now
};

// First takes up the jobs that an earlier dispatcher left open in the journal, and follows those that have started to
// their end. Then dispatches the jobs of which none of these was started. Stops after the first job that did not run to
// its end: the next one may need the block that it left. Only its restart goes on behind it. A file that the cell has
// milled to its end before is passed over, and one that was stopped and whose piece or part a later job carved to its
// end. Every event goes into `journal` before what follows from it. Throws what dispatch_job and adopt_job throw, and
// InputError (use): a part whose part before has not ended complete; unless options.again, a restart of another job
// than the cell was stopped in, or of a piece or part that was carved to its end since.
std::vector<DispatchedJob> dispatch_jobs(const std::vector<PieceJob>& jobs, RegisterBus& bus,
                                         const DispatchOptions& options, Journal& journal,
                                         const ProjectContext& context);

}  // namespace qchopper
