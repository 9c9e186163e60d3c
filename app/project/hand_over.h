// What dry-run and dispatch share: which jobs of a project, and one after the other over a bus.

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/context.h"
#include "base/file.h"
#include "cam/cell/cell.h"
#include "cam/job/ticket.h"
#include "devices/dispatch.h"

namespace qchopper {

// Read once: what was checked is what is sent.
struct PieceJob {
    std::string piece;
    Bytes file;
    JobTicket ticket;
};
struct ProjectJobs {
    Cell cell;
    std::vector<PieceJob> jobs;
};
// The jobs that the project ordered for its cell, in the order of its pieces; only one piece if it is named.
// Throws InputError: an unfinished project, no such piece, a job file that is missing, broken or another
// (ordered_job.h).
ProjectJobs jobs_of(const std::filesystem::path& project, const std::optional<std::string>& piece);

struct HandedOver {
    std::string piece;
    JobOutcome outcome;
};

// Stops at the first job that did not run to its end: what follows may need the block that it left. `on_complete` is
// told after every job how many have ended complete.
std::vector<HandedOver> hand_over(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options,
                                  const std::function<void(std::size_t)>& on_complete, const Context& context);

}  // namespace qchopper
