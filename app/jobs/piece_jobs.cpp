// A job is made of the setup of its piece and of the program for it; every file is written aside and renamed. Several
// pieces at a time. O(triangles) and what the program costs (piece_program.h).

#include "app/jobs/piece_jobs.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>

#include "app/jobs/job_verdict.h"
#include "app/jobs/kept_deviation.h"
#include "app/jobs/kept_programs.h"
#include "app/jobs/kept_toolpaths.h"
#include "app/jobs/ordered_job.h"
#include "app/jobs/piece_program.h"
#include "app/jobs/program_effort.h"
#include "app/store/caches/cache_file.h"
#include "app/store/project_folder.h"
#include "app/store/replay.h"
#include "base/files/file.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "base/process.h"
#include "base/text.h"
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

constexpr std::size_t kept_per_piece = 4;  // files of programs: of what is there and of earlier decisions

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
    input.is_limited = order.max_directions.has_value();
    input.folder = folder.string();
    input.piece = piece.name;
    return access_advice(input, cell);
}

// What is known before its job is written.
PieceReport report_of(const fs::path& folder, const Project& project, const Piece& piece,
                      const PlacedSetup& piece_setup, const Cell& cell) {
    PieceReport report{piece.name, piece.mesh->triangles.size(), volume_mm3(*piece.mesh), piece_setup, {}};
    report.piece_setup.choice.states.clear();
    const Setup& setup = piece_setup.setup();
    report.advice = advice_for(folder, project, piece, setup.access, with_tools(cell, setup.tools));
    report.is_only_sawn = is_only_sawn(setup, *piece.mesh);
    return report;
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

// Removes the jobs of a piece and their verdicts, of all its parts, with their restarts.
void remove_jobs(const fs::path& folder, const std::string& piece) {
    std::error_code error;
    std::uint16_t part = 1;
    for (; part == 1 || fs::exists(folder / "jobs" / job_file_name(piece, part), error); ++part) {
        const fs::path file = folder / "jobs" / job_file_name(piece, part);
        std::vector<fs::path> files = restart_files(folder, piece, part);
        files.push_back(file);
        for (const fs::path& job : files) {
            fs::remove(verdict_file(job), error);
            fs::remove(job, error);
        }
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
    keep_deviation(orders.folder / "cache", verdict.job_sha256, orders.cell_sha256, *proof);
    made.report.verdicts.push_back(std::move(verdict));
    made.report.time_s += proof->time_s;
    made.report.length_mm += proof->length_mm;
}

// Why the pieces get no programs; empty: they do.
std::string none_because(const JobOrders& orders) {
    const std::string because = no_programs_for(orders.cell);
    return because.empty() && !orders.project.has_programs ? "prepare was asked for none" : because;
}

ProgramSource source_of(const JobOrders& orders, const JobInput& input) {
    return {input, orders.cell_sha256, orders.project.has_all_fine_tools ? FineTools::all : FineTools::worthwhile};
}

fs::path kept_file(const JobOrders& orders, const JobInput& input) {
    return programs_file(orders.folder / "cache", source_of(orders, input));
}

// Those that are kept, or new ones, which are kept then.
PiecePrograms programs_of(const JobOrders& orders, const JobInput& input, const PlacedSetup& piece_setup,
                          const Context& context, PieceReport& report) {
    const std::string because = none_because(orders);
    if (!because.empty()) return {{}, because, caps_by_hand(input.caps, because)};
    const ProgramSource source = source_of(orders, input);
    const fs::path file = kept_file(orders, input);
    {
        const StageTimer stage(context, "kept programs read");
        std::optional<PiecePrograms> kept = kept_programs(file, source);
        report.has_kept_programs = kept.has_value();
        if (kept) return std::move(*kept);
    }
    PiecePrograms programs =
        make_programs(input.piece, piece_setup, program_name(input), orders.cell, input.caps, context, source.fine,
                      kept_toolpath(toolpath_file(orders.folder / "cache", source)));
    keep_programs(file, source, programs);
    return programs;
}

// Writes the files of the jobs of one piece; removes those that an earlier run wrote.
MadeJob make_job(const JobOrders& orders, std::size_t index, const PlacedSetup& piece_setup, const Context& context) {
    const Piece& piece = orders.segmentation.pieces[index];
    MadeJob made{report_of(orders.folder, orders.project, piece, piece_setup, orders.cell), {}};
    if (made.report.is_only_sawn || !piece_setup.fits()) {
        remove_jobs(orders.folder, piece.name);
        return made;
    }
    JobInput input = job_input(orders, index, piece_setup);
    PiecePrograms programs = programs_of(orders, input, piece_setup, context, made.report);
    const bool is_placed_again = programs.place.has_value();
    if (programs.place) {
        const Cell planned = with_tools(orders.cell, piece_setup.setup().tools);
        PlacedSetup placed = placed_at(piece_setup, piece, planned, *programs.place).value();
        input = job_input(orders, index, placed);
        placed.choice.states.clear();
        made.report.piece_setup = std::move(placed);
        programs.place.reset();  // the next run finds the block where it is now
        keep_programs(kept_file(orders, input), source_of(orders, input), programs);
    }
    remove_jobs(orders.folder, piece.name);
    made.report.no_program_because = programs.none_because;
    made.report.is_machine_refusing = programs.is_machine_refusing;
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
    if (is_placed_again || (recorded != orders.places.end() && recorded->second == placement)) {
        for (WrittenJob& job : made.written) job.place = placement;
    }
    return made;
}

std::vector<const PlacedSetup*> placed_setups(const Segmentation& segmentation, Setups& setups) {
    std::vector<const PlacedSetup*> piece_setups;
    for (const Piece& piece : segmentation.pieces) piece_setups.push_back(&setups.placed(piece));
    return piece_setups;
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

// The programs that have to be made, or the toolpaths if they are all that is made now, the largest first, and in which
// order all jobs are written: these first.
struct JobPlan {
    std::vector<PlannedProgram> programs;
    std::vector<std::size_t> order;  // of the pieces; the first ones are those of the programs
};

JobPlan plan_jobs(const JobOrders& orders, const std::vector<const PlacedSetup*>& piece_setups, ProgramSteps steps) {
    const std::size_t count = piece_setups.size();
    std::vector<double> effort(count, 0);
    const bool has_programs = none_because(orders).empty();
    parallel_for(0, count, [&](std::size_t i) {
        const PlacedSetup& piece_setup = *piece_setups[i];
        const TriangleMesh& mesh = *orders.segmentation.pieces[i].mesh;
        if (!has_programs || !piece_setup.fits() || is_only_sawn(piece_setup.setup(), mesh)) return;
        std::error_code error;
        const JobInput input = job_input(orders, i, piece_setup);
        bool is_kept = fs::exists(kept_file(orders, input), error);
        if (!is_kept && steps == ProgramSteps::toolpath) {
            is_kept = fs::exists(toolpath_file(orders.folder / "cache", source_of(orders, input)), error);
        }
        if (!is_kept) effort[i] = program_effort(piece_setup.setup());
    });
    JobPlan plan;
    for (std::size_t i = 0; i < count; ++i) plan.order.push_back(i);
    std::stable_sort(plan.order.begin(), plan.order.end(),
                     [&](std::size_t a, std::size_t b) { return effort[a] > effort[b]; });
    for (const std::size_t i : plan.order) {
        if (effort[i] > 0) plan.programs.push_back({orders.segmentation.pieces[i].name, effort[i]});
    }
    return plan;
}

// Whether the toolpaths of the programs have been made already, as all are or none.
bool has_toolpaths(const JobOrders& orders, const JobPlan& plan, const std::vector<const PlacedSetup*>& piece_setups) {
    if (plan.programs.empty()) return false;
    const std::size_t first = plan.order.front();
    const JobInput input = job_input(orders, first, *piece_setups[first]);
    std::error_code error;
    return fs::exists(toolpath_file(orders.folder / "cache", source_of(orders, input)), error);
}

// Of jobs that are written several at a time: the time of their programs, or the number of jobs where none is made.
class JobProgress {
 public:
    JobProgress(const Context& context, const JobPlan& plan, ProgramSteps steps)
        : context_(context),
          programs_(context, plan.programs, steps),
          made_(plan.programs.size()),
          count_(plan.order.size()) {
        if (made_ == 0) context_.progress("jobs written", 0, count_);
        if (made_ > 0 && steps != ProgramSteps::after_toolpath) context_.message(describe(plan.programs));
    }

    // For the work on the job that is number `k` in the order of the plan, which is timed by itself.
    Context of(std::size_t k, Timings* timings) {
        Context own = context_;
        own.timings = context_.timings == nullptr ? nullptr : timings;
        own.on_progress = {};
        return k < made_ ? programs_.of(k, own) : own;
    }

    void finish(std::size_t k) {
        if (k < made_) programs_.finish(k);
        if (made_ == 0) context_.progress("jobs written", ++done_, count_);
    }

 private:
    const Context& context_;
    ProgramProgress programs_;
    std::size_t made_ = 0;
    std::size_t count_ = 0;
    std::size_t done_ = 0;
};

// Several pieces at a time in the order of a plan, each timed by itself. `finish` is called from one thread at a time.
void in_order_of(const JobPlan& plan, ProgramSteps steps, StageTimer& stage, const Context& context,
                 const std::function<void(std::size_t, const Context&)>& work,
                 const std::function<void(std::size_t)>& finish) {
    const std::size_t count = plan.order.size();
    JobProgress progress(context, plan, steps);
    std::vector<RunTimes> times(count);
    std::mutex finishing;
    std::atomic<std::size_t> next = 0;
    parallel_for(0, count, [&](std::size_t) {  // whatever the order of the loop
        context.check_cancelled();
        const std::size_t k = next++;
        const std::size_t i = plan.order[k];
        Timings timings;
        work(i, progress.of(k, &timings));
        times[i] = timings.so_far();
        give_back_freed_memory();
        const std::lock_guard lock(finishing);
        finish(i);
        progress.finish(k);
    });
    stage.divide(times);
}

// Says in the report why there will be no program, if that is so. False if it is not known, and is not to be found out.
bool follow(const JobOrders& orders, std::size_t index, const PlacedSetup& piece_setup, MissingToolpaths missing,
            const Context& context, PieceReport& report) {
    if (report.is_only_sawn || !piece_setup.fits()) return true;
    const JobInput input = job_input(orders, index, piece_setup);
    const ProgramSource source = source_of(orders, input);
    if (const std::optional<PiecePrograms> programs = kept_programs(kept_file(orders, input), source)) {
        report.no_program_because = programs->none_because;
        report.is_machine_refusing = programs->is_machine_refusing;
        return true;
    }
    const fs::path file = toolpath_file(orders.folder / "cache", source);
    std::optional<FollowedToolpath> followed = kept_toolpath(file);
    if (!followed && missing == MissingToolpaths::not_made) return false;
    if (!followed) {
        followed = follow_toolpath(input.piece, piece_setup, orders.cell, context, source.fine);
        keep_toolpath(file, *followed);
    }
    report.no_program_because = followed->none_because;
    report.is_machine_refusing = followed->is_machine_refusing;
    return true;
}

void tell_kept(const std::vector<PieceReport>& reports, const Context& context) {
    std::size_t kept = 0;
    std::size_t made = 0;
    for (const PieceReport& report : reports) {
        if (report.has_kept_programs) ++kept;
        if (!report.has_kept_programs && !report.verdicts.empty()) ++made;
    }
    if (kept == 0) return;
    context.message("programs of " + counted(kept, "piece") + " kept from an earlier run, of " + std::to_string(made) +
                    " made");
}

}  // namespace

WorkItem item_of(const fs::path& folder, const Project& project, const Segmentation& segmentation, std::size_t index,
                 Setups& setups, std::span<const PieceJoint> joints, const std::string& program_version) {
    const Piece& piece = segmentation.pieces[index];
    const PlacedSetup& piece_setup = setups.placed(piece);
    const JobOrders orders = orders_of(folder, project, segmentation, setups.cell(), joints, program_version);
    const JobInput input = job_input(orders, index, piece_setup);
    const bool has_program = !is_only_sawn(piece_setup.setup(), *piece.mesh) && piece_setup.fits();
    return work_item(input, piece_setup, read_file(folder / "cell.toml", settings_limit), source_of(orders, input).fine,
                     has_program ? kept_file(orders, input).filename().string() : std::string());
}

PieceReport report_without_job(const fs::path& folder, const Project& project, const Piece& piece, Setups& setups) {
    return report_of(folder, project, piece, setups.placed(piece), setups.cell());
}

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

std::vector<PieceReport> follow_toolpaths(const fs::path& folder, const Project& project,
                                          const Segmentation& segmentation, Setups& setups,
                                          std::span<const PieceJoint> joints, const std::string& program_version,
                                          MissingToolpaths missing, const Context& context) {
    const JobOrders orders = orders_of(folder, project, segmentation, setups.cell(), joints, program_version);
    if (!none_because(orders).empty()) return {};
    StageTimer stage(context, "toolpaths followed");
    const std::vector<const PlacedSetup*> piece_setups = placed_setups(segmentation, setups);
    std::vector<PieceReport> reports;
    for (std::size_t i = 0; i < piece_setups.size(); ++i) {
        reports.push_back(report_of(folder, project, segmentation.pieces[i], *piece_setups[i], setups.cell()));
    }
    JobPlan plan = plan_jobs(orders, piece_setups, ProgramSteps::toolpath);
    if (missing == MissingToolpaths::not_made) plan.programs.clear();
    std::atomic<bool> is_known = true;
    in_order_of(
        plan, ProgramSteps::toolpath, stage, context,
        [&](std::size_t i, const Context& own) {
            if (!follow(orders, i, *piece_setups[i], missing, own, reports[i])) is_known = false;
        },
        [](std::size_t) {});
    if (!is_known) reports.clear();
    return reports;
}

std::vector<PieceReport> write_jobs(const fs::path& folder, Project& project, const Segmentation& segmentation,
                                    Setups& setups, std::span<const PieceJoint> joints,
                                    const std::string& program_version,
                                    const std::function<void(const PieceReport&)>& on_job, const Context& context) {
    StageTimer stage(context, "jobs written");
    const std::size_t count = segmentation.pieces.size();
    const std::vector<const PlacedSetup*> piece_setups = placed_setups(segmentation, setups);
    std::vector<MadeJob> made(count);
    const Project ordered = project;  // what the threads read, while the records change
    const JobOrders orders = orders_of(folder, ordered, segmentation, setups.cell(), joints, program_version);
    const JobPlan plan = plan_jobs(orders, piece_setups, ProgramSteps::all);
    in_order_of(
        plan, has_toolpaths(orders, plan, piece_setups) ? ProgramSteps::after_toolpath : ProgramSteps::all, stage,
        context, [&](std::size_t i, const Context& own) { made[i] = make_job(orders, i, *piece_setups[i], own); },
        [&](std::size_t i) {
            record_jobs(project, segmentation, i, made[i].written);
            save_project(folder, project);
            if (on_job) on_job(made[i].report);
        });
    std::vector<WrittenJob> all;
    std::vector<PieceReport> reports;
    for (MadeJob& job : made) {
        all.insert(all.end(), job.written.begin(), job.written.end());
        reports.push_back(std::move(job.report));
    }
    project.jobs = std::move(all);  // no other job stays recorded
    remove_oldest(folder / "cache", programs_ending, kept_per_piece * count);
    remove_oldest(folder / "cache", deviations_ending, kept_per_piece * count);
    remove_oldest(folder / "cache", toolpaths_ending, 0);
    tell_kept(reports, context);
    setups.set_places(recorded_places(project));
    return reports;
}

}  // namespace qchopper
