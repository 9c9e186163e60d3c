// Nothing but what stands in job and cell file is replayed. The cost is that of replay_in_stages(), and of the proof
// where it is not kept.

#include "app/dispatch/replay_job.h"

#include <algorithm>

#include "app/dispatch/dispatch_jobs.h"
#include "app/jobs/job_scene.h"
#include "base/error.h"
#include "base/printable.h"
#include "cam/job/read_job.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

PieceJob part_of(ProjectJobs& ordered, const ReplayOrder& order) {
    const auto found = std::ranges::find(ordered.jobs, order.part, &PieceJob::part);
    if (found == ordered.jobs.end()) {
        throw InputError(InputFault::use,
                         "piece " + order.piece + " has no part " + std::to_string(order.part) + " of its program",
                         "choose a part from 1 to " + std::to_string(ordered.jobs.back().parts));
    }
    return std::move(*found);
}

// That a proof was made of these bytes, whatever it found.
void check_judged(const PieceJob& job, const ProjectJobs& ordered) {
    const std::string name = "the job of piece " + job.piece;
    if (!job.no_program_because.empty()) {
        throw InputError(InputFault::use, name + " holds no robot program: " + job.no_program_because,
                         "its setup sheet says what is done by hand");
    }
    const std::string verify = "prove it: qchopper verify " + shell_word(ordered.folder);
    if (!job.verdict) throw InputError(InputFault::use, name + " is not proven", verify);
    if (job.verdict->job_sha256 != job.ticket.file_sha256 || job.verdict->cell_sha256 != ordered.cell_sha256) {
        throw InputError(InputFault::use, name + " or the cell file has changed since it was proven", verify);
    }
}

double time_of(const JobVerdict& verdict) {
    const auto found = std::ranges::find(verdict.figures, "time_s", &ProofFigure::key);
    return found != verdict.figures.end() ? found->value : 0;
}

}  // namespace

struct JobToReplay::Content {
    fs::path cache;
    Cell cell;
    ReadJob job;
    std::string source;
    JobContents contents;
    ParsedProgram program;
    ReplayedJob about;

    Content(const ProjectJobs& ordered, const PieceJob& piece_job)
        : cache(ordered.folder / "cache"),
          cell(ordered.cell),
          job(parse_job(piece_job.file, piece_job.ticket.file_name)),
          source(piece_job.ticket.file_name),
          contents(job, source),
          program(program_read_back(contents.input(cell))) {
        about.piece = piece_job.piece;
        about.part = piece_job.part;
        about.parts = piece_job.parts;
        about.job = piece_job.ticket.file_sha256;
        about.cell = ordered.cell_sha256;
        about.is_positive = piece_job.verdict->is_positive;
        about.proven_time_s = time_of(*piece_job.verdict);
        about.block = job.setup.block_box();
        about.mesh = contents.mesh();
        about.files = program.files;
        for (const SceneOrientation& own : scene_of(contents.input(cell)).orientations) {
            about.tool_axes.push_back(own.tool_axis);
        }
        if (!cell.machine) return;
        for (const CuttingTool& tool : cell.machine->tools) about.tools.emplace_back(tool.number, tool.name);
    }
    Content(const Content&) = delete;
    Content& operator=(const Content&) = delete;
};

JobToReplay::JobToReplay(const ReplayOrder& order, const Context& context) {
    ProjectJobs ordered = jobs_of(order.project, order.piece, context);
    const PieceJob job = part_of(ordered, order);
    check_judged(job, ordered);
    content_ = std::make_unique<const Content>(ordered, job);
}

JobToReplay::~JobToReplay() = default;

const ReplayedJob& JobToReplay::about() const {
    return content_->about;
}

StagedReplay JobToReplay::replay(const StageOptions& options, const StageTaker& take, const Context& context) const {
    const ProofInput input = content_->contents.input(content_->cell);
    ReplayScene scene = scene_of(input);
    const std::optional<StockRecord> before = stock_before(input);
    if (before) scene.before = &*before;
    return replay_in_stages(content_->program, scene, options, take, context);
}

std::optional<JobDeviation> JobToReplay::deviation(const Context& context) const {
    const ReplayedJob& about = content_->about;
    if (about.part != about.parts) return std::nullopt;
    if (auto kept = kept_deviation(content_->cache, about.job, about.cell)) return kept;
    const JobProof proof = prove(content_->contents.input(content_->cell), context);
    if (proof.deviation.empty()) return std::nullopt;
    keep_deviation(content_->cache, about.job, about.cell, proof);
    return JobDeviation{proof.deviation, proof.is_given_up};
}

}  // namespace qchopper
