// Verifies job files: reads them whole, reads their programs back, replays them, and writes the verdict beside each.
//
// Of a job nothing is needed but its file and the cell file. Of a project its jobs are also compared with its pieces
// and joints (tests/app/dispatch/verify_jobs_test.cpp).

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/jobs/entered/entered_values.h"
#include "app/jobs/job_verdict.h"
#include "app/pictures/carved_view.h"
#include "app/store/project_context.h"
#include "cam/cell/cell.h"
#include "cam/job/job.h"
#include "devices/keys/trusted_keys.h"

namespace qchopper {

// A viewer's file (app/pictures/carved_view.h) that was written.
struct WrittenView {
    std::filesystem::path file;
    double path_tolerance = 0;  // mm by which its lines may be off the path; 0: none is
    double surface_shift = 0;   // mm by which a point of its surface is moved, at most; 0: none is
};

struct VerifiedJob {
    std::filesystem::path file;
    JobVerdict verdict;
    // What speaks against its signature file, or that the cell file requires one. Not in the verdict, which is written
    // before anybody signs the job.
    std::string signature_fault = {};
    std::optional<WrittenView> view = {};  // of one job file whose program could be replayed
    // The verdict is on the program with these values in place of the planned ones, and was not written.
    std::optional<EnteredDifference> entered = {};
};

using VerifyAnswer = std::vector<VerifiedJob>;

// A cell file as it was read once.
struct CellFile {
    Cell cell;
    Sha256 sha256;
};

// Throws what read_cell throws.
CellFile read_cell_file(const std::filesystem::path& path);

// What is kept of a proof beside the verdict.
struct ProofKeeping {
    // If it is not nullptr, it becomes what the next part has to carry: empty after the last part, and where the
    // program cannot be replayed.
    Bytes* stock_left = nullptr;
    std::filesystem::path cache = {};  // for kept_deviation.h; empty: none
    // If it is not nullptr, it becomes path and surface for viewers, where the program could be replayed.
    std::optional<CarvedView>* view = nullptr;
};

// The verdict on a job that parse_job took. Faults are findings. Throws Cancelled. A part but the first is replayed
// from the stock that its job carries. `entered` is replayed in place of the planned values; precondition:
// difference_from_plan() took it.
JobVerdict judge_job(const ReadJob& job, const std::string& job_file, const CellFile& cell,
                     const std::string& program_version, const Context& context, const ProofKeeping& keeping = {},
                     const EnteredValues& entered = {});

// The verdict on a job before it is judged: of which piece, bytes, cell file and version.
JobVerdict unjudged(const ReadJob& job, const std::string& job_file, const CellFile& cell,
                    const std::string& program_version);

// One job file; "B.carved.glb" is written beside "B.qjob", a file there replaced. Without a cell file, that of the
// project in whose folder "jobs" it lies. Of a restart the stock is carved again with the job that it goes on with,
// where that lies beside it; else a note says that it was not. Throws what read_job and parse_job throw, what read_cell
// throws, and InputError (use) without a cell file.
//
// With values that are entered at the controller nothing is written: the verdict is on the program with them, and the
// one beside the job stays. Throws what difference_from_plan() throws too.
VerifiedJob verify_job(const std::filesystem::path& job, const std::optional<std::filesystem::path>& cell_file,
                       const std::string& program_version, const TrustedKeys& trusted, const Context& context,
                       const EnteredValues& entered = {});

// All jobs of a project, or those of one piece, in the order of its pieces. Parts of a program have to follow each
// other, each carrying the stock that the replay of the one before left, and its SHA-256. Behind a job stand its
// restarts, each with the stock that the chunks before it leave. Throws what jobs_of
// (dispatch_jobs.h) throws.
VerifyAnswer verify_project(const std::filesystem::path& folder, const std::optional<std::string>& piece,
                            const std::string& program_version, const TrustedKeys& trusted,
                            const ProjectContext& context);

}  // namespace qchopper
