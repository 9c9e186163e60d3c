// The manifest of a job holds its setup, caps and half-spaces with numbers that are read as they were written; beside
// it stand the mesh to the bit, the regions of the reachability, and the text of the cell file. O(bytes).

#include "app/jobs/work_item.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "app/jobs/kept_programs.h"
#include "app/jobs/piece_program.h"
#include "app/jobs/program_effort.h"
#include "app/store/caches/cache_file.h"
#include "base/error.h"
#include "base/printable.h"
#include "cam/cell/job_tools.h"
#include "cam/job/manifest.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr const char* mark = "qchopper item 1";

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
    throw InputError(InputFault::mesh, file.string() + " " + what,
                     "write the items again: qchopper prepare NAME.qch --items");
}

// A manifest says of every hole who drills it, and of an item nobody has said so yet: this stands in for it.
constexpr const char* undecided = "it is not decided";

void replace_reason(JobInput& job, const std::string& from, const std::string& to) {
    for (DrawnCap& drawn : job.caps) {
        for (CapJoint& joint : drawn.cap.joints) {
            for (JobHole& hole : joint.holes) {
                if (!hole.by_robot && hole.by_hand == from) hole.by_hand = to;
            }
        }
    }
}

std::string manifest_of(JobInput job) {
    replace_reason(job, "", undecided);
    return to_manifest(job, {});
}

std::uint8_t below(CacheReader& in, std::uint8_t count, const fs::path& file) {
    const auto value = in.get<std::uint8_t>();
    if (value >= count) refuse(file, "is damaged");
    return value;
}

void put(CacheWriter& out, const RegionReachability& region) {
    out.put(region.orientation);
    out.put(region.poses);
    out.put(static_cast<std::uint8_t>(region.holds));
    const ArmConfiguration& arm = region.configuration;
    for (const bool is : {arm.is_back, arm.is_elbow_negative, arm.is_wrist_flipped}) {
        out.put(static_cast<std::uint8_t>(is));
    }
    out.put(region.redundancy_angle);
    out.put(region.relative);
}

RegionReachability region_from(CacheReader& in) {
    RegionReachability region;
    region.orientation = in.get<std::size_t>();
    region.poses = in.get<std::size_t>();
    region.holds = in.get<std::uint8_t>() != 0;
    ArmConfiguration& arm = region.configuration;
    for (bool* is : {&arm.is_back, &arm.is_elbow_negative, &arm.is_wrist_flipped}) *is = in.get<std::uint8_t>() != 0;
    region.redundancy_angle = in.get<double>();
    region.relative = in.get<double>();
    return region;
}

void put(CacheWriter& out, const MachineReachability& reachability) {
    out.put(static_cast<std::uint8_t>(reachability.is_arm_checked));
    out.put(static_cast<std::uint8_t>(reachability.remedy));
    out.put(reachability.regions.size());
    for (const RegionReachability& region : reachability.regions) put(out, region);
}

MachineReachability reachability_from(CacheReader& in, const Setup& setup, const fs::path& file) {
    constexpr auto remedies = static_cast<std::uint8_t>(Remedy::cut) + 1;
    MachineReachability reachability;
    reachability.is_arm_checked = in.get<std::uint8_t>() != 0;
    reachability.remedy = static_cast<Remedy>(below(in, remedies, file));
    reachability.placement = setup.placement;
    for (std::size_t regions = in.count(); regions > 0; --regions) reachability.regions.push_back(region_from(in));
    return reachability;
}

TriangleMesh mesh_from(CacheReader& in) {
    TriangleMesh mesh;
    const std::vector<double> coordinates = in.get_all<double>();
    for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
        mesh.points.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
    }
    mesh.triangles = in.get_all<Triangle>();
    mesh.cap_of = in.get_all<std::int32_t>();
    return mesh;
}

void put(CacheWriter& out, const TriangleMesh& mesh) {
    std::vector<double> coordinates;
    coordinates.reserve(3 * mesh.points.size());
    for (const Vec3& p : mesh.points) coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
    out.put_all(coordinates);
    out.put_all(mesh.triangles);
    out.put_all(mesh.cap_of);
}

// Of a job, what its program depends on, and what names its files.
JobInput without_others(const JobInput& job) {
    JobInput own = job;
    own.alternatives.clear();
    own.states.clear();
    own.warnings.clear();
    own.program.reset();
    return own;
}

JobInput job_from(const ReadJob& read, TriangleMesh mesh, const Cell& cell) {
    JobInput job;
    job.piece = {read.piece, std::make_shared<TriangleMesh>(std::move(mesh)), read.half_spaces};
    job.piece_no = read.piece_no;
    job.piece_count = read.piece_count;
    job.program_version = read.program_version;
    job.project_id = read.project_id;
    job.scan_sha256 = read.scan_sha256;
    job.setup = read.setup;
    job.cell = with_tools(cell, job.setup.tools);
    job.stock_fit = read.stock_fit;
    job.max_unreachable = read.max_unreachable;
    for (const JobCap& cap : read.caps) job.caps.push_back({cap, {}, {}, {}});
    replace_reason(job, undecided, "");
    return job;
}

bool is_mesh(const TriangleMesh& mesh) {
    const auto has_points = [&](const Triangle& triangle) {
        return std::ranges::all_of(triangle, [&](std::uint32_t corner) { return corner < mesh.points.size(); });
    };
    const bool has_caps = mesh.cap_of.empty() || mesh.cap_of.size() == mesh.triangles.size();
    return !mesh.triangles.empty() && has_caps && std::ranges::all_of(mesh.triangles, has_points);
}

// Only what the manifest of the same job gives is exact.
WorkItem content_from(CacheReader& in, const fs::path& file, const std::string& program_version) {
    constexpr auto fine_tools = static_cast<std::uint8_t>(FineTools::none) + 1;
    WorkItem item;
    const std::string manifest = in.text();
    const ReadJob read = from_manifest(manifest, file.string());
    item.fine = static_cast<FineTools>(below(in, fine_tools, file));
    item.result = in.text();
    item.effort = in.get<double>();
    item.cell_file = in.get_all<std::uint8_t>();
    item.cell = parse_cell(std::string(item.cell_file.begin(), item.cell_file.end()), file.string());
    const bool is_consistent =
        read.program_version == program_version && item.cell.machine && read.setup.block.stock < item.cell.stock.size();
    if (!is_consistent || read.setup.access.orientations.empty()) refuse(file, "is damaged");
    item.job = job_from(read, mesh_from(in), item.cell);
    item.job.machine_reachability = reachability_from(in, item.job.setup, file);
    const bool is_name = fs::path(item.result).filename() == item.result && !item.result.empty();
    if (!in.is_whole() || !is_name || !is_mesh(*item.job.piece.mesh)) refuse(file, "is damaged");
    if (manifest_of(item.job) != manifest) refuse(file, "does not hold what its manifest says");
    item.piece_setup.choice.setups = {item.job.setup};
    item.piece_setup.stock_fit = item.job.stock_fit;
    item.piece_setup.machine_reachability = item.job.machine_reachability;
    if (!item.piece_setup.fits()) refuse(file, "is of a piece that does not fit");
    return item;
}

ProgramSource source_of(const WorkItem& item) {
    return {item.job, sha256(item.cell_file), item.fine};
}

WorkedPiece worked(const std::string& piece, const PiecePrograms& programs, bool was_kept) {
    WorkedPiece result{piece, ProgramOutcome::none, programs.none_because, was_kept};
    if (programs.parts.empty()) return result;
    const auto is_proven = [](const ProvenProgram& part) { return part.proof.is_proven(); };
    result.outcome = std::ranges::all_of(programs.parts, is_proven) ? ProgramOutcome::proven : ProgramOutcome::refused;
    for (const ProvenProgram& part : programs.parts) result.time_s += part.proof.time_s;
    return result;
}

}  // namespace

WorkItem work_item(const JobInput& job, const PlacedSetup& piece_setup, const Bytes& cell_file, FineTools fine,
                   const std::string& result) {
    WorkItem item;
    item.job = without_others(job);
    item.piece_setup = piece_setup;
    item.cell_file = cell_file;
    item.fine = fine;
    item.result = result;
    item.effort = program_effort(piece_setup.setup());
    return item;
}

Bytes to_bytes(const WorkItem& item) {
    CacheWriter out;
    out.put(std::string(mark));
    out.put(item.job.program_version);
    out.put(manifest_of(item.job));
    out.put(static_cast<std::uint8_t>(item.fine));
    out.put(item.result);
    out.put(item.effort);
    out.put_all(item.cell_file);
    put(out, *item.job.piece.mesh);
    put(out, item.piece_setup.machine_reachability);
    return sealed(out);
}

WorkItem item_from(const Bytes& bytes, const fs::path& source, const std::string& program_version) {
    const std::optional<Bytes> content = unsealed(bytes);
    if (!content) refuse(source, "is damaged: its SHA-256 is not that of its content");
    CacheReader in(*content);
    if (in.text() != mark) refuse(source, "is no item of qchopper");
    const std::string version = in.text();
    if (version != program_version) {
        refuse(source, "was written by build " + printable(version) + ", and this is " + program_version);
    }
    try {
        return content_from(in, source, program_version);
    } catch (const InputError& error) {  // of the cell file in it, or of its tools
        if (error.fault == InputFault::mesh) throw;
        refuse(source, std::string("is damaged: ") + error.what());
    }
}

std::optional<WorkedPiece> result_of(const WorkItem& item, const fs::path& results) {
    const std::optional<PiecePrograms> kept = kept_programs(results / item.result, source_of(item));
    if (!kept) return std::nullopt;
    return worked(item.job.piece.name, *kept, true);
}

WorkedPiece work_on(const WorkItem& item, const fs::path& results, const Context& context) {
    if (auto known = result_of(item, results)) return *std::move(known);
    const PiecePrograms programs = make_programs(item.job.piece, item.piece_setup, item.job.piece_no, item.cell,
                                                 item.job.caps, context, item.fine);
    const fs::path file = results / item.result;
    const Bytes made = programs_bytes(source_of(item), programs);
    std::error_code error;
    fs::create_directories(results, error);
    if (result_of(item, results) && read_file(file) != made) {
        const fs::path second = file.string() + ".second";
        write_file(second, made);
        throw std::logic_error("the programs of piece " + item.job.piece.name +
                               " that were made twice differ: " + file.string() + " and " + second.filename().string());
    }
    write_file(file, made);
    return worked(item.job.piece.name, programs, false);
}

}  // namespace qchopper
