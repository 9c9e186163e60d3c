// A rule per kind of fault, the most specific first.

#include "app/dispatch/proven_jobs.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "base/printable.h"
#include "base/text.h"

namespace qchopper {
namespace {

std::string name_of(const PieceJob& job) {
    return job.parts > 1 ? "piece " + job.piece + ", part " + std::to_string(job.part) : "piece " + job.piece;
}

// Why no cell gets the job.
std::optional<std::string> fault_of(const PieceJob& job, const ProjectJobs& jobs) {
    if (!job.verdict || !job.no_program_because.empty()) return std::nullopt;
    const std::string verify = "; judge it again: qchopper verify " + shell_word(jobs.folder);
    if (job.verdict->job_sha256 != job.ticket.file_sha256) {
        return "its verdict is that of other bytes of " + job.ticket.file_name + verify;
    }
    if (job.verdict->cell_sha256 != jobs.cell_sha256) return "its verdict is that of another cell file" + verify;
    if (job.verdict->is_positive) return std::nullopt;
    if (job.verdict->findings.empty()) return "its verdict is negative" + verify;
    return "its verdict is negative: " + describe(job.verdict->findings.front()) + "; see qchopper verify " +
           shell_word(jobs.folder);
}

// Why only a simulated cell gets it.
std::optional<std::string> lack_of(const PieceJob& job, const ProjectJobs& jobs) {
    if (!job.no_program_because.empty()) return "it holds no robot program: " + job.no_program_because;
    if (!job.verdict) return "it has no verdict; make it: qchopper verify " + shell_word(jobs.folder);
    return std::nullopt;
}

using Why = std::function<std::optional<std::string>(const PieceJob&)>;

// One sentence per reason, with the jobs that it holds for.
std::vector<std::string> by_reason(const std::vector<PieceJob>& jobs, const Why& why_of) {
    std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
    for (const PieceJob& job : jobs) {
        const std::optional<std::string> why = why_of(job);
        if (!why) continue;
        const auto known = std::find_if(reasons.begin(), reasons.end(), [&](const auto& r) { return r.first == *why; });
        if (known == reasons.end()) {
            reasons.push_back({*why, {name_of(job)}});
        } else {
            known->second.push_back(name_of(job));
        }
    }
    std::vector<std::string> sentences;
    for (const auto& [why, names] : reasons) {
        const std::size_t others = names.size() - 1;
        sentences.push_back(names.front() + (others > 0 ? " and " + counted(others, "other") : "") + ": " + why);
    }
    return sentences;
}

}  // namespace

std::vector<std::string> unproven_jobs(const ProjectJobs& jobs, bool is_real) {
    return by_reason(jobs.jobs, [&](const PieceJob& job) {
        std::optional<std::string> why = fault_of(job, jobs);
        return why || !is_real ? why : lack_of(job, jobs);
    });
}

std::vector<std::string> simulated_only_jobs(const ProjectJobs& jobs) {
    return by_reason(jobs.jobs, [&](const PieceJob& job) { return lack_of(job, jobs); });
}

std::vector<std::string> wrongly_signed_jobs(const ProjectJobs& jobs, const TrustedKeys& trusted,
                                             std::uint64_t now_ms) {
    return by_reason(jobs.jobs, [&](const PieceJob& job) -> std::optional<std::string> {
        const std::string fault =
            fault_of(job.signature, job.ticket.file_sha256, jobs.cell.id, jobs.cell.require_signature, trusted, now_ms);
        if (fault.empty()) return std::nullopt;
        const std::filesystem::path what = job.restart ? jobs.folder / "jobs" / job.ticket.file_name : jobs.folder;
        return fault + "; look at the job, then sign it: qchopper keys sign " + shell_word(what);
    });
}

}  // namespace qchopper
