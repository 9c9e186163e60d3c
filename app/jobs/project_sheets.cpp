// O(bytes of the jobs), of which one is in memory at a time.

#include "app/jobs/project_sheets.h"

#include <algorithm>

#include "app/jobs/job_verdict.h"
#include "base/files/file.h"
#include "base/timings.h"
#include "cam/job/read_job.h"
#include "cam/job/sheet/order_sheets.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr const char* sheets_file = "sheets.html";

std::string state_of(const ReadJob& job, const fs::path& file) {
    if (!job.program) return "no program";
    const std::optional<JobVerdict> verdict = read_verdict(file);
    if (!verdict || !verdict->is_positive) return "DO NOT START: not proven";
    return is_unreachable(job.setup, job.max_unreachable) ? "unreachable" : "ready";
}

}  // namespace

void write_sheets(const fs::path& folder, const Project& project, const Context& context) {
    const StageTimer stage(context, "sheets written");
    std::vector<SheetOfOrder> sheets;
    for (const WrittenJob& written : project.jobs) {
        const fs::path file = folder / "jobs" / job_file_name(written.piece, written.part);
        const ReadJob job = parse_job(read_job(file), file.string());
        sheets.push_back(sheet_of(job, file.filename().string(), state_of(job, file)));
    }
    std::vector<std::string> without_job;
    for (const SolidRecord& piece : project.pieces) {
        const bool has_job = std::any_of(sheets.begin(), sheets.end(),
                                         [&](const SheetOfOrder& sheet) { return sheet.piece == piece.name; });
        if (!has_job) without_job.push_back(piece.name);
    }
    write_file(folder / sheets_file, order_sheets(project.scan.path.filename().string(), sheets, without_job));
}

void remove_sheets(const fs::path& folder) {
    std::error_code error;
    fs::remove(folder / sheets_file, error);
}

}  // namespace qchopper
