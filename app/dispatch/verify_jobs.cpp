// The proof is that of job_proof.h; pieces and joints of a project are made again from scan and decisions. The cost is
// that of the replay.

#include "app/dispatch/verify_jobs.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "app/dispatch/dispatch_jobs.h"
#include "app/dispatch/restart_job.h"
#include "app/engine/open_project.h"
#include "app/jobs/hole_faults.h"
#include "app/jobs/job_proof.h"
#include "app/jobs/job_scene.h"
#include "app/jobs/kept_deviation.h"
#include "app/jobs/ordered_job.h"
#include "app/jobs/project_joints.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/printable.h"
#include "base/text.h"
#include "base/timings.h"
#include "cam/job/job_caps.h"
#include "cam/job/read_job.h"
#include "cam/setup/block_placement.h"
#include "segment/mesh/transform.h"
#include "sim/replay/signal_walk.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

ProofFinding finding(const char* kind, const std::string& text) {
    return {kind, "", 0, text};
}

bool is_near(const Pose& a, const Pose& b) {
    constexpr double tolerance = 1e-6;  // mm, and of unit vectors: a job and a cell file of another rounding
    double most = norm(a.shift - b.shift);
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, norm(a.row[i] - b.row[i]));
    return most <= tolerance;
}

// What of the job contradicts the cell file.
std::vector<ProofFinding> faults_against_cell(const ReadJob& job, const Cell& cell) {
    std::vector<ProofFinding> faults;
    if (job.cell_id != cell.id) {
        faults.push_back(finding("other_cell", "the job is made for cell " + std::to_string(job.cell_id) +
                                                   ", and the cell file describes cell " + std::to_string(cell.id)));
    }
    for (std::size_t d = 0; d < job.setup_in_cell.size(); ++d) {
        const Pose frame = setup_in_cell(cell, job.setup.spoil, job.setup.placement, d);
        if (!is_near(frame, job.setup_in_cell[d])) {
            faults.push_back(finding("other_frame",
                                     "setup_in_cell of the manifest is not what its placement and the "
                                     "cell file give"));
        }
    }
    if (!job.stock_fit.fits() || !job.holds_poses) {
        faults.push_back(finding("does_not_fit", "the job states that its piece does not fit the cell"));
    }
    return faults;
}

// "B.carved.glb" beside "B.qjob".
fs::path view_file(const fs::path& job) {
    return fs::path(job).replace_extension(".carved.glb");
}

// The straight moves of the program, in setup coordinates, by the orientation of their chunk. A joint move ends a line.
std::vector<OrientationPath> paths_of(const ProofInput& input) {
    const ParsedProgram parsed = program_read_back(input);
    std::map<std::string, std::size_t> orientation_of;
    for (const JobChunk& chunk : input.program.chunks) orientation_of[chunk.file] = chunk.orientation;
    std::map<std::size_t, OrientationPath> paths;
    for (const ProgramChunk& chunk : parsed.chunks) {
        const auto orientation = orientation_of.find(parsed.files[chunk.file]);
        if (orientation == orientation_of.end()) continue;  // the main program
        OrientationPath& path = paths[orientation->second];
        path.orientation = orientation->second;
        std::vector<Vec3> line;
        for (std::size_t i = chunk.first; i < chunk.end; ++i) {
            const ProgramStep& step = parsed.steps[i];
            if (step.kind == StepKind::linear_move) line.push_back({step.values[0], step.values[1], step.values[2]});
            if (step.kind != StepKind::joint_move && i + 1 < chunk.end) continue;
            if (line.size() > 1) path.lines.push_back(std::move(line));
            line.clear();
        }
    }
    std::vector<OrientationPath> all;
    all.reserve(paths.size());
    for (auto& [orientation, path] : paths) all.push_back(std::move(path));
    return all;
}

void add_proof(const ReadJob& job, const std::string& job_file, const CellFile& cell, JobVerdict& verdict,
               const Context& context, const ProofKeeping& keeping, const EnteredValues& entered) {
    const JobContents contents(job, job_file);
    ProofInput input = contents.input(cell.cell);
    if (!entered.is_empty()) input.entered = &entered;
    JobProof proof = prove(input, context);
    if (!keeping.cache.empty()) keep_deviation(keeping.cache, job.file_sha256, cell.sha256, proof);
    if (keeping.stock_left != nullptr) *keeping.stock_left = std::move(proof.stock_left);
    if (keeping.view != nullptr && !proof.deviation.empty()) {
        const std::string generator = "qchopper " + verdict.program_version;
        *keeping.view = carved_view(
            {generator, &contents.mesh(), proof.deviation, std::move(proof.is_given_up), paths_of(input)}, context);
    }
    verdict.figures = std::move(proof.figures);
    verdict.time = std::move(proof.time);
    verdict.findings.insert(verdict.findings.end(), proof.findings.begin(), proof.findings.end());
    verdict.findings_left_out = proof.findings_left_out;
    verdict.notes = std::move(proof.notes);
}

// Lists at most max_listed_findings of them.
void shorten(JobVerdict& verdict) {
    if (verdict.findings.size() <= max_listed_findings) return;
    verdict.findings_left_out += verdict.findings.size() - max_listed_findings;
    verdict.findings.resize(max_listed_findings);
}

// Rotation alone is not asked: the piece of the project is laid as the job says, by a pose of determinant +1, and has
// to be the job's mesh triangle for triangle.
std::optional<ProofFinding> fault_against_piece(const ReadJob& job, const std::string& job_file, const Piece& piece) {
    constexpr double tolerance = 1e-3;  // mm; piece.stl is single precision
    const TriangleMesh expected = apply(job.setup.piece_in_setup, *piece.mesh);
    const TriangleMesh found = job_mesh(job.files.at("piece.stl"), job_file + ": piece.stl");
    const std::string text = "the mesh of the job is not that of piece " + piece.name;
    if (found.triangles.size() != expected.triangles.size()) {
        return finding("other_piece", text + ": " + std::to_string(found.triangles.size()) + " faces instead of " +
                                          std::to_string(expected.triangles.size()));
    }
    for (std::size_t t = 0; t < expected.triangles.size(); ++t) {
        const std::array<Vec3, 3> a = corners_of(expected, t);
        const std::array<Vec3, 3> b = corners_of(found, t);
        for (std::size_t i = 0; i < 3; ++i) {
            if (!(norm(a[i] - b[i]) <= tolerance)) return finding("other_piece", text);
        }
    }
    return std::nullopt;
}

// What of the job's setup is not that which the project has for the piece.
std::optional<ProofFinding> fault_against_setup(const ReadJob& job, const Setup& own) {
    if (job.setup == own) return std::nullopt;
    const std::string text = "the setup of the job is not that of the project for piece " + job.piece;
    const std::size_t directions = job.setup.access.orientations.size();
    if (directions != own.access.orientations.size()) {
        return finding("other_setup", text + ": " + counted(directions, "orientation") + " instead of " +
                                          std::to_string(own.access.orientations.size()));
    }
    if (job.setup.tools != own.tools) return finding("other_setup", text + ": other tools may be used");
    return finding("other_setup", text);
}

// What of the job contradicts the project: no such piece, another mesh, another setup, other holes.
std::vector<ProofFinding> faults_against_project(const ReadJob& job, const std::string& job_file, OpenProject& project,
                                                 std::span<const PieceJoint> joints, const Cell& cell) {
    const std::vector<Piece>& pieces = project.segmentation().pieces;
    const auto piece = std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.name == job.piece; });
    if (piece == pieces.end()) return {finding("other_piece", "the project has no piece " + job.piece)};
    if (auto fault = fault_against_piece(job, job_file, *piece)) return {*fault};
    if (auto fault = fault_against_setup(job, project.setups()->placed(*piece).setup())) return {*fault};
    std::vector<JobCap> caps;
    const auto index = static_cast<std::size_t>(piece - pieces.begin());
    for (DrawnCap& drawn : caps_of(pieces, index, joints, job.setup, cell)) caps.push_back(std::move(drawn.cap));
    return hole_faults(job.piece, job.caps, caps);
}

// The part of a piece that was verified last.
struct PartBefore {
    std::string piece;
    std::uint16_t number = 0;
    Sha256 sha256;
    Bytes stock;  // what it left
};

// What speaks against a part coming after the one that was verified before it.
std::optional<ProofFinding> fault_against_part_before(const ReadJob& job, const PartBefore& before) {
    if (!job.program || job.program->part.number == 1) return std::nullopt;
    const JobPart& part = job.program->part;
    const std::string number = std::to_string(part.number - 1);
    if (before.piece != job.piece || before.number + 1 != part.number) {
        return finding("other_part", "part " + number + " of the program is missing before this one");
    }
    if (part.before != before.sha256) {
        return finding("other_part", "the job was made for another part " + number + " than is there");
    }
    if (before.stock.empty() || job.files.at("stock.bin") != before.stock) {
        return finding("other_stock", "stock.bin is not what part " + number + " leaves");
    }
    return std::nullopt;
}

// Those that have a job.
std::vector<Piece> pieces_of(const std::vector<PieceJob>& jobs, const std::vector<Piece>& pieces) {
    std::vector<Piece> with_job;
    std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(with_job), [&](const Piece& piece) {
        return std::any_of(jobs.begin(), jobs.end(), [&](const PieceJob& job) { return job.piece == piece.name; });
    });
    return with_job;
}

// With what speaks against its signature.
VerifiedJob unwritten(const fs::path& file, JobVerdict verdict, const Cell& cell, const TrustedKeys& trusted) {
    verdict.is_positive = verdict.findings.empty();
    std::string fault =
        fault_of(read_signature(file), verdict.job_sha256, cell.id, cell.require_signature, trusted, unix_ms());
    return {file, std::move(verdict), std::move(fault)};
}

VerifiedJob written(const fs::path& file, JobVerdict verdict, const Cell& cell, const TrustedKeys& trusted) {
    verdict.is_positive = verdict.findings.empty();
    write_verdict(file, verdict);
    return unwritten(file, std::move(verdict), cell, trusted);
}

// What of a restart does not follow from the job that it goes on with.
std::vector<ProofFinding> faults_against_first(const ReadJob& restart, const ReadJob& first, const fs::path& first_file,
                                               const CellFile& cell, const Context& context) {
    if (!restart.program || !restart.program->restart) {
        return {finding("other_job", "it is named as a restart, and goes on with no other job")};
    }
    return faults_of_restart(restart, first, first_file.filename().string(), cell.cell, context);
}

// The job that a restart goes on with, where it lies beside it whole and unchanged.
std::optional<ReadJob> first_beside(const ReadJob& restart, const fs::path& file) {
    const fs::path first = file.parent_path() / job_file_name(restart.piece, restart.program->part.number);
    try {
        ReadJob job = parse_job(read_job(first), first.string());
        if (job.file_sha256 == restart.program->restart->of) return job;
    } catch (const InputError&) {
        return std::nullopt;
    }
    return std::nullopt;
}

void add_restart_beside(const ReadJob& job, const fs::path& file, const CellFile& cell, JobVerdict& verdict,
                        const Context& context) {
    if (!job.program || !job.program->restart) return;
    const std::string name = job_file_name(job.piece, job.program->part.number);
    const std::optional<ReadJob> first = first_beside(job, file);
    if (!first) {
        verdict.notes.push_back(
            "stock.bin was taken as it is, because the job that it goes on with does not lie "
            "beside it as " +
            name);
        return;
    }
    const std::vector<ProofFinding> faults = faults_of_restart(job, *first, name, cell.cell, context);
    verdict.findings.insert(verdict.findings.begin(), faults.begin(), faults.end());
    shorten(verdict);
}

}  // namespace

JobVerdict unjudged(const ReadJob& job, const std::string& job_file, const CellFile& cell,
                    const std::string& program_version) {
    JobVerdict verdict;
    verdict.piece = job.piece;
    verdict.job = fs::path(job_file).filename().string();
    verdict.job_sha256 = job.file_sha256;
    verdict.cell = cell.cell.name;
    verdict.cell_sha256 = cell.sha256;
    verdict.program_version = program_version;
    return verdict;
}

CellFile read_cell_file(const fs::path& path) {
    return {read_cell(path), sha256(read_file(path, settings_limit))};
}

JobVerdict judge_job(const ReadJob& job, const std::string& job_file, const CellFile& cell,
                     const std::string& program_version, const Context& context, const ProofKeeping& keeping,
                     const EnteredValues& entered) {
    if (keeping.stock_left != nullptr) keeping.stock_left->clear();
    JobVerdict verdict = unjudged(job, job_file, cell, program_version);
    verdict.findings = faults_against_cell(job, cell.cell);
    if (!job.program) {
        verdict.findings.push_back(finding("no_program", "the job holds no robot program: " + job.no_program_because));
    } else if (verdict.findings.empty()) {
        add_proof(job, job_file, cell, verdict, context, keeping, entered);
    }
    shorten(verdict);
    verdict.is_positive = verdict.findings.empty();
    return verdict;
}

VerifiedJob verify_job(const fs::path& job, const std::optional<fs::path>& cell_file,
                       const std::string& program_version, const TrustedKeys& trusted, const Context& context,
                       const EnteredValues& entered) {
    const ReadJob read = parse_job(read_job(job), job.string());
    fs::path cell = cell_file.value_or(fs::absolute(job).parent_path().parent_path() / "cell.toml");
    std::error_code error;
    if (!cell_file && !fs::exists(cell, error)) {
        throw InputError(InputFault::use, "no cell file is known for " + job.string(),
                         Sentence::with_key("give_cell_file", {}, "give the cell file"));
    }
    const CellFile described = read_cell_file(cell);
    std::optional<EnteredDifference> difference;
    if (!entered.is_empty()) difference = difference_from_plan(entered, read, job.string(), described.cell);
    std::optional<CarvedView> view;
    ProofKeeping keeping;
    if (!difference) keeping.view = &view;
    JobVerdict verdict = judge_job(read, job.string(), described, program_version, context, keeping, entered);
    add_restart_beside(read, job, described, verdict, context);
    verdict.notes.emplace_back(
        "its setup was not compared with that of its project, because a single job file does not have the project");
    if (difference) {
        VerifiedJob verified = unwritten(job, std::move(verdict), described.cell, trusted);
        verified.entered = std::move(difference);
        return verified;
    }
    VerifiedJob verified = written(job, std::move(verdict), described.cell, trusted);
    if (view) {
        write_file(view_file(job), view->glb);
        verified.view = WrittenView{view_file(job), view->path_tolerance, view->mesh_shift};
    }
    return verified;
}

VerifyAnswer verify_project(const fs::path& folder, const std::optional<std::string>& piece,
                            const std::string& program_version, const TrustedKeys& trusted,
                            const ProjectContext& context) {
    const ProjectJobs ordered = jobs_of(folder, piece, context);
    const CellFile cell = read_cell_file(folder / "cell.toml");
    OpenProject project(folder, context);
    const Segmentation& segmentation = project.segmentation();
    StageTimer stage(context, "dowels placed");
    const std::vector<PieceJoint> joints = piece_joints(segmentation.pieces, joint_settings(&cell.cell), context);
    stage.next("setups chosen");
    project.setups()->place(pieces_of(ordered.jobs, segmentation.pieces), context);
    stage.next("jobs verified");
    VerifyAnswer verified;
    PartBefore before;
    for (const PieceJob& job : ordered.jobs) {
        context.progress("jobs verified", verified.size(), ordered.jobs.size());
        const fs::path file = folder / "jobs" / job_file_name(job.piece, job.part);
        const ReadJob read = parse_job(job.file, file.string());
        Bytes stock_left;
        JobVerdict verdict =
            judge_job(read, file.string(), cell, program_version, context, {&stock_left, folder / "cache"});
        if (const auto of_part = fault_against_part_before(read, before)) {
            verdict.findings.insert(verdict.findings.begin(), *of_part);
        }
        before = {read.piece, read.program ? read.program->part.number : std::uint16_t{1}, read.file_sha256,
                  std::move(stock_left)};
        const auto faults = faults_against_project(read, file.string(), project, joints, cell.cell);
        verdict.findings.insert(verdict.findings.begin(), faults.begin(), faults.end());
        shorten(verdict);
        verified.push_back(written(file, std::move(verdict), cell.cell, trusted));
        for (const fs::path& restart : restart_files(folder, job.piece, job.part)) {
            const ReadJob own = parse_job(read_job(restart), restart.string());
            JobVerdict on_restart = judge_job(own, restart.string(), cell, program_version, context);
            const auto against_first = faults_against_first(own, read, file, cell, context);
            on_restart.findings.insert(on_restart.findings.begin(), against_first.begin(), against_first.end());
            shorten(on_restart);
            verified.push_back(written(restart, std::move(on_restart), cell.cell, trusted));
        }
    }
    return verified;
}

}  // namespace qchopper
