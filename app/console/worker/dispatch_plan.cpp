// Reads every job file that is meant: O(bytes of the jobs).

#include "app/console/worker/dispatch_plan.h"

#include <algorithm>

#include "app/dispatch/dispatch_jobs.h"
#include "app/dispatch/proven_jobs.h"
#include "app/dispatch/signing.h"
#include "base/error.h"

namespace qchopper {
namespace {

PlannedJob planned(const PieceJob& job) {
    PlannedJob planned{
        job.piece, job.part, job.parts, job.ticket.file_name, to_hex(job.ticket.file_sha256), job.ticket.about.stock,
        0,         false};
    planned.time_s = job.ticket.about.estimated_time_s;
    planned.is_proven = job.verdict && job.verdict->is_positive && job.verdict->job_sha256 == job.ticket.file_sha256;
    return planned;
}

}  // namespace

DispatchPlan plan_dispatch(const std::filesystem::path& project, const PlanOrder& order, const Context& context) {
    ProjectJobs ordered = jobs_of(project, {}, context);
    const auto is_meant = [&](const std::string& piece) {
        return order.pieces.empty() || std::ranges::find(order.pieces, piece) != order.pieces.end();
    };
    for (const std::string& piece : order.pieces) {
        const auto has_job = [&](const PieceJob& job) { return job.piece == piece; };
        if (std::ranges::any_of(ordered.jobs, has_job)) continue;
        throw InputError(InputFault::use, "the project has no job of piece " + piece, "choose one of its jobs");
    }
    std::erase_if(ordered.jobs, [&](const PieceJob& job) { return !is_meant(job.piece); });
    DispatchPlan plan;
    plan.cell = ordered.cell.name;
    for (const PieceJob& job : ordered.jobs) plan.jobs.push_back(planned(job));
    const auto add = [&](const std::vector<std::string>& why) {
        plan.refused.insert(plan.refused.end(), why.begin(), why.end());
    };
    add(unproven_jobs(ordered, order.is_for_real_cell));
    const TrustedKeys trusted = read_trusted_keys(trusted_keys_file(std::nullopt));
    add(wrongly_signed_jobs(ordered, trusted, unix_ms()));
    if (ordered.cell.require_signature) {
        // A passphrase is typed at a terminal, never into a page.
        add({"the cell " + ordered.cell.name + " requires signed tickets: dispatch from a terminal, with a key"});
    }
    if (!order.accept_unreachable) add(unreachable_jobs(ordered.jobs));
    if (order.is_for_real_cell) add(jobs_failing_workholding(ordered.jobs));
    return plan;
}

}  // namespace qchopper
