// A job is made of the setup of its piece and of the program for it; every file is written aside and renamed. Several
// pieces at a time. O(triangles) and what the program costs (piece_program.h).

#include "app/jobs/piece_jobs.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>

#include "app/jobs/job_verdict.h"
#include "app/jobs/kept_programs.h"
#include "app/jobs/ordered_job.h"
#include "app/jobs/piece_program.h"
#include "app/store/project_folder.h"
#include "app/store/replay.h"
#include "base/files/file.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "base/timings.h"
#include "cam/cell/job_tools.h"
#include "cam/job/envelope_document.h"
#include "cam/job/glue_faces.h"
#include "cam/job/job_caps.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "segment/mesh/measure.h"

namespace qchopper {

bool PieceReport::is_proven() const {
    return !verdicts.empty() &&
           std::all_of(verdicts.begin(), verdicts.end(), [](const JobVerdict& v) { return v.is_positive; });
}

double max_unreachable(const Project& project, const Cell& cell) {
    if (project.settings.stop.max_unreachable) return *project.settings.stop.max_unreachable;
    return cell.machine ? cell.machine->max_unreachable : 1;
}

namespace {

namespace fs = std::filesystem;

struct MadeJob {
    PieceReport report;
    std::vector<WrittenJob> written;  // one per part; none of a piece that does not fit or is only sawn
};

// Empty for a piece of which no more is out of reach than may be.
std::vector<AccessAdvice> advice_for(const fs::path& folder, const Project& project, const Piece& piece,
                                     const SurfaceAccess& access, const Cell& cell) {
    if (!access.exceeds(max_unreachable(project, cell))) return {};
    AdviceInput input;
    input.access = access;
    input.inside_share = inside_share(piece);
    input.tilt_deg = max_tilt_deg(cell);
    const SetupOrder order = committed_setup_order(project.history, piece.name);
    input.max_directions = order.max_directions.value_or(SetupOptions{}.max_directions);
    const std::string of_piece = shell_word(folder) + " --piece " + piece.name;
    input.segment_command = "qchopper segment " + of_piece + " --step";
    input.setup_command = "qchopper setup " + of_piece;
    return access_advice(input, cell);
}

// What all jobs of a run have in common.
struct JobOrders {
    const fs::path& folder;
    const Project& project;
    const Segmentation& segmentation;
    const Cell& cell;
    std::span<const PieceJoint> joints;
    Sha256 cell_sha256;  // of the cell file
    const std::string& program_version;
    std::map<std::string, BlockPlacement> places;  // recorded_places()
};

JobOrders orders_of(const fs::path& folder, const Project& project, const Segmentation& segmentation, const Cell& cell,
                    std::span<const PieceJoint> joints, const std::string& program_version) {
    return {folder,          project,
            segmentation,    cell,
            joints,          sha256(read_file(folder / "cell.toml", settings_limit)),
            program_version, recorded_places(project)};
}

JobInput job_input(const JobOrders& orders, std::size_t index, const PlacedSetup& piece_setup) {
    JobInput input;
    input.piece = orders.segmentation.pieces[index];
    input.piece_no = static_cast<std::uint16_t>(index + 1);
    input.piece_count = static_cast<std::uint16_t>(orders.segmentation.pieces.size());
    input.program_version = orders.program_version;
    input.project_id = project_id(orders.project);
    input.scan_sha256 = orders.project.scan.sha256;
    input.setup = piece_setup.setup();
    input.cell = with_tools(orders.cell, input.setup.tools);
    input.stock_fit = piece_setup.stock_fit;
    input.machine_reachability = piece_setup.machine_reachability;
    input.alternatives.assign(piece_setup.choice.setups.begin() + 1, piece_setup.choice.setups.end());
    input.states = piece_setup.choice.states;
    input.max_unreachable = max_unreachable(orders.project, orders.cell);
    input.warnings = orders.project.warnings;
    input.caps = caps_of(orders.segmentation.pieces, index, orders.joints, input.setup, input.cell);
    return input;
}

// Removes the jobs of a piece and their verdicts, of all its parts.
void remove_jobs(const fs::path& folder, const std::string& piece) {
    std::error_code error;
    std::uint16_t part = 1;
    for (; part == 1 || fs::exists(folder / "jobs" / job_file_name(piece, part), error); ++part) {
        const fs::path file = folder / "jobs" / job_file_name(piece, part);
        fs::remove(verdict_file(file), error);
        fs::remove(file, error);
    }
}

JobVerdict verdict_of(const JobProof& proof, const JobOrders& orders, const std::string& piece, const fs::path& file,
                      const Sha256& job) {
    JobVerdict verdict;
    verdict.piece = piece;
    verdict.job = file.filename().string();
    verdict.job_sha256 = job;
    verdict.cell = orders.cell.name;
    verdict.cell_sha256 = orders.cell_sha256;
    verdict.program_version = orders.program_version;
    static_cast<ProofResult&>(verdict) = proof;
    verdict.is_positive = proof.is_proven();
    return verdict;
}

// Writes one job file and adds it to what was made.
void write_one(const JobInput& input, const JobProof* proof, const JobOrders& orders, MadeJob& made) {
    const std::uint16_t part = input.program ? input.program->program.part.number : std::uint16_t{1};
    const fs::path file = orders.folder / "jobs" / job_file_name(input.piece.name, part);
    const Bytes bytes = job_file(input);
    write_file(file, bytes);
    made.written.push_back(written_job(input.piece.name, bytes, input.project_id, part));
    if (made.report.job.empty()) made.report.job = file;
    if (proof == nullptr) return;
    JobVerdict verdict = verdict_of(*proof, orders, input.piece.name, file, made.written.back().sha256);
    write_verdict(file, verdict);
    made.report.verdicts.push_back(std::move(verdict));
    made.report.time_s += proof->time_s;
    made.report.length_mm += proof->length_mm;
}

// Those that an earlier run made of the same, or new ones.
PiecePrograms programs_of(const JobOrders& orders, const JobInput& input, const PlacedSetup& piece_setup,
                          const Context& context) {
    std::string none_because = no_programs_for(orders.cell);
    if (none_because.empty() && !orders.project.has_programs) none_because = "prepare was asked for none";
    if (!none_because.empty()) return {{}, none_because, caps_by_hand(input.caps, none_because)};
    const std::string envelope = envelope_document(input);
    const ProgramSource source{input.piece,        input.setup,           envelope, input.piece_no, input.caps,
                               orders.cell_sha256, orders.program_version};
    if (std::optional<PiecePrograms> kept = kept_programs(orders.folder / "jobs", source)) return std::move(*kept);
    const FineTools fine = orders.project.has_all_fine_tools ? FineTools::all : FineTools::worthwhile;
    return make_programs(input.piece, piece_setup, input.piece_no, orders.cell, input.caps, context, fine);
}

// Writes the files of the jobs of one piece; removes those that an earlier run wrote.
MadeJob make_job(const JobOrders& orders, std::size_t index, const PlacedSetup& piece_setup, const Context& context) {
    const Piece& piece = orders.segmentation.pieces[index];
    MadeJob made{{piece.name, piece.mesh->triangles.size(), volume_mm3(*piece.mesh), piece_setup, {}}, {}};
    made.report.piece_setup.choice.states.clear();
    made.report.advice = advice_for(orders.folder, orders.project, piece, piece_setup.setup().access,
                                    with_tools(orders.cell, piece_setup.setup().tools));
    made.report.is_only_sawn = is_only_sawn(piece_setup.setup(), *piece.mesh);
    if (made.report.is_only_sawn || !piece_setup.fits()) {
        remove_jobs(orders.folder, piece.name);
        return made;
    }
    JobInput input = job_input(orders, index, piece_setup);
    const PiecePrograms programs = programs_of(orders, input, piece_setup, context);
    if (programs.place) {
        const Cell planned = with_tools(orders.cell, piece_setup.setup().tools);
        PlacedSetup placed = placed_at(piece_setup, piece, planned, *programs.place).value();
        input = job_input(orders, index, placed);
        placed.choice.states.clear();
        made.report.piece_setup = std::move(placed);
    }
    remove_jobs(orders.folder, piece.name);
    made.report.no_program_because = programs.none_because;
    input.caps = programs.caps;
    if (programs.parts.empty()) {
        input.no_program_because = programs.none_because;
        write_one(input, nullptr, orders, made);
    }
    for (const ProvenProgram& part : programs.parts) {
        input.program = part.input;
        if (!made.written.empty()) input.program->program.part.before = made.written.back().sha256;
        write_one(input, &part.proof, orders, made);
    }
    // Its programs need the block there, or those of an earlier run did and the setup has that place.
    const BlockPlacement& placement = made.report.piece_setup.setup().placement;
    const auto recorded = orders.places.find(piece.name);
    if (programs.place || (recorded != orders.places.end() && recorded->second == placement)) {
        for (WrittenJob& job : made.written) job.place = placement;
    }
    return made;
}

// In place of those that the project has of the piece, in the order of the pieces.
void record_jobs(Project& project, const Segmentation& segmentation, std::size_t index,
                 const std::vector<WrittenJob>& written) {
    const std::string& piece = segmentation.pieces[index].name;
    std::erase_if(project.jobs, [&](const WrittenJob& job) { return job.piece == piece; });
    const auto later = std::find_if(project.jobs.begin(), project.jobs.end(), [&](const WrittenJob& job) {
        return piece_named(segmentation, job.piece).value_or(segmentation.pieces.size()) > index;
    });
    project.jobs.insert(later, written.begin(), written.end());
}

// Jobs of pieces are written several at a time: of how many pieces, and the steps of the first one that is not done.
class JobProgress {
 public:
    JobProgress(const Context& context, std::size_t count) : context_(context), is_done_(count, false) {
        context.progress("jobs written", 0, count);
    }

    // For the work on one job, which is timed by itself.
    Context of(std::size_t index, const std::string& piece, Timings* timings) {
        Context own = context_;
        own.timings = context_.timings == nullptr ? nullptr : timings;
        own.on_progress = [this, index, piece](const Progress& step) {
            const std::lock_guard lock(mutex_);
            const std::size_t first = std::find(is_done_.begin(), is_done_.end(), false) - is_done_.begin();
            if (index != first) return;
            context_.progress(step.what + " for piece " + piece + " (" + std::to_string(done_ + 1) + " of " +
                                  std::to_string(is_done_.size()) + ")",
                              step.done, step.total);
        };
        return own;
    }

    void finish(std::size_t index) {
        const std::lock_guard lock(mutex_);
        is_done_[index] = true;
        context_.progress("jobs written", ++done_, is_done_.size());
    }

 private:
    const Context& context_;
    std::mutex mutex_;
    std::vector<bool> is_done_;
    std::size_t done_ = 0;
};

}  // namespace

PieceReport write_job(const fs::path& folder, Project& project, const Segmentation& segmentation, std::size_t index,
                      Setups& setups, std::span<const PieceJoint> joints, const std::string& program_version,
                      const Context& context) {
    const Piece& piece = segmentation.pieces[index];
    MadeJob made = make_job(orders_of(folder, project, segmentation, setups.cell(), joints, program_version), index,
                            setups.placed(piece), context);
    record_jobs(project, segmentation, index, made.written);
    setups.set_places(recorded_places(project));
    return std::move(made.report);
}

std::vector<PieceReport> write_jobs(const fs::path& folder, Project& project, const Segmentation& segmentation,
                                    Setups& setups, std::span<const PieceJoint> joints,
                                    const std::string& program_version,
                                    const std::function<void(const PieceReport&)>& on_job, const Context& context) {
    StageTimer stage(context, "jobs written");
    const std::size_t count = segmentation.pieces.size();
    std::vector<const PlacedSetup*> piece_setups;
    for (const Piece& piece : segmentation.pieces) piece_setups.push_back(&setups.placed(piece));
    std::vector<MadeJob> made(count);
    const Project ordered = project;  // what the threads read, while the records change
    const JobOrders orders = orders_of(folder, ordered, segmentation, setups.cell(), joints, program_version);
    JobProgress progress(context, count);
    std::vector<RunTimes> times(count);
    std::mutex recording;
    parallel_for(0, count, [&](std::size_t i) {
        context.check_cancelled();
        Timings timings;
        made[i] = make_job(orders, i, *piece_setups[i], progress.of(i, segmentation.pieces[i].name, &timings));
        times[i] = timings.so_far();
        const std::lock_guard lock(recording);
        record_jobs(project, segmentation, i, made[i].written);
        save_project(folder, project);
        if (on_job) on_job(made[i].report);
        progress.finish(i);
    });
    stage.divide(times);
    std::vector<WrittenJob> all;
    std::vector<PieceReport> reports;
    for (MadeJob& job : made) {
        all.insert(all.end(), job.written.begin(), job.written.end());
        reports.push_back(std::move(job.report));
    }
    project.jobs = std::move(all);  // no other job stays recorded
    setups.set_places(recorded_places(project));
    return reports;
}

}  // namespace qchopper
