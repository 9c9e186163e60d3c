// The manifest of a job holds its setup, caps and half-spaces with numbers that are read as they were written. The
// other setups stand as manifests of the jobs that they would make; beside them the mesh to the bit, the reachability,
// and the text of the cell file. O(bytes).

#include "app/jobs/work_item.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "app/jobs/kept_programs.h"
#include "app/jobs/piece_program.h"
#include "app/jobs/program_effort.h"
#include "app/store/caches/cache_file.h"
#include "base/error.h"
#include "base/json_fields.h"
#include "base/printable.h"
#include "cam/cell/job_tools.h"
#include "cam/job/manifest.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr const char* mark = "qchopper item 2";

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
    throw InputError(InputFault::mesh, file.string() + " " + what,
                     Sentence::with_key("write_items_again", {}, "write the items again"));
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

// Their values one by one, written by the first and read by the second.
struct PutValue {
    CacheWriter& out;
    template <class T>
    void operator()(const T& value) {
        if constexpr (std::is_enum_v<T>) {
            out.put(static_cast<std::uint8_t>(value));
        } else if constexpr (std::is_same_v<T, std::vector<double>>) {
            out.put_all(value);
        } else {
            out.put(value);
        }
    }
};

struct GetValue {
    CacheReader& in;
    template <class T>
    void operator()(T& value) {
        if constexpr (std::is_same_v<T, std::string>) {
            value = in.text();
        } else if constexpr (std::is_same_v<T, std::vector<double>>) {
            value = in.get_all<double>();
        } else if constexpr (std::is_same_v<T, bool>) {
            value = in.get<std::uint8_t>() != 0;
        } else if constexpr (std::is_same_v<T, Remedy>) {
            value = in.one_of(Remedy::cut);
        } else if constexpr (std::is_same_v<T, PoseKind>) {
            value = in.one_of(PoseKind::tool_change);
        } else if constexpr (std::is_same_v<T, PoseCheck>) {
            value = in.one_of(PoseCheck::tool_to_arm);
        } else {
            value = in.get<T>();
        }
    }
};

template <class V, Of<Vec3> T>
void each(V& v, T& vector) {
    for (auto* x : {&vector.x, &vector.y, &vector.z}) v(*x);
}

template <class V, Of<RegionReachability> T>
void each(V& v, T& region) {
    v(region.orientation);
    v(region.poses);
    v(region.holds);
    v(region.configuration.is_back);
    v(region.configuration.is_elbow_negative);
    v(region.configuration.is_wrist_flipped);
    v(region.redundancy_angle);
    v(region.relative);
}

template <class V, Of<ReachabilityPose> T>
void each(V& v, T& pose) {
    v(pose.kind);
    v(pose.orientation);
    each(v, pose.tip);
    each(v, pose.tip_in_cell);
    each(v, pose.tool_axis_in_cell);
    v(pose.table_angle);
    v(pose.redundancy_angle);
    bool has_joints = pose.joints.has_value();
    v(has_joints);
    if constexpr (!std::is_const_v<T>) {
        if (has_joints) pose.joints.emplace();
    }
    if (has_joints) {
        for (auto& joint : *pose.joints) v(joint);
    }
}

template <class V, Of<ReachabilityMargin> T>
void each(V& v, T& margin) {
    v(margin.check);
    v(margin.margin);
    v(margin.relative);
    v(margin.pair);
    each(v, margin.pose);
}

template <class V, Of<MachineReachability> T>
void each(V& v, T& reachability) {
    v(reachability.is_arm_checked);
    v(reachability.remedy);
    v(reachability.poses);
    v(reachability.places);
    v(reachability.placement.x);
    v(reachability.placement.y);
    v(reachability.placement.turn);
    v(reachability.placement.table_angles);
}

template <class Element>
void put_each(CacheWriter& out, const std::vector<Element>& elements) {
    out.put(elements.size());
    PutValue v{out};
    for (const Element& element : elements) each(v, element);
}

template <class Element>
void get_each(CacheReader& in, std::vector<Element>& elements) {
    GetValue v{in};
    for (std::size_t count = in.count(); count > 0; --count) each(v, elements.emplace_back());
}

void put(CacheWriter& out, const MachineReachability& reachability) {
    PutValue v{out};
    each(v, reachability);
    put_each(out, reachability.margins);
    put_each(out, reachability.regions);
}

MachineReachability reachability_from(CacheReader& in, const fs::path& file) {
    MachineReachability reachability;
    GetValue v{in};
    each(v, reachability);
    get_each(in, reachability.margins);
    get_each(in, reachability.regions);
    if (reachability.is_arm_checked && reachability.margins.empty()) refuse(file, "is damaged");
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

// The manifest of the same job with another setup, of which it says all that is known; the holes are those of the
// first.
std::string manifest_with(JobInput job, const Setup& setup) {
    job.setup = setup;
    job.caps.clear();
    return manifest_of(std::move(job));
}

void put_states(CacheWriter& out, const std::vector<SurfaceState>& states) {
    out.put(states.size());
    for (const SurfaceState state : states) out.put(static_cast<std::uint8_t>(state));
}

// Of each triangle, or none.
std::vector<SurfaceState> states_from(CacheReader& in, std::size_t triangles, const fs::path& file) {
    std::vector<SurfaceState> states(in.count());
    for (SurfaceState& state : states) state = in.one_of(SurfaceState::ignored);
    if (!states.empty() && states.size() != triangles) refuse(file, "is damaged");
    return states;
}

bool is_of_cell(const Setup& setup, const Cell& cell) {
    return setup.block.stock < cell.stock.size() && !setup.access.orientations.empty();
}

// Only what the manifest of the same job gives is exact.
WorkItem content_from(CacheReader& in, const fs::path& file, const std::string& program_version) {
    WorkItem item;
    const std::string manifest = in.text();
    const ReadJob read = from_manifest(manifest, file.string());
    item.fine = in.one_of(FineTools::none);
    item.result = in.text();
    item.is_settled = in.get<std::uint8_t>() != 0;
    item.effort = in.get<double>();
    item.cell_file = in.get_all<std::uint8_t>();
    item.cell = parse_cell(std::string(item.cell_file.begin(), item.cell_file.end()), file.string());
    const bool is_consistent = read.program_version == program_version && item.cell.machine;
    if (!is_consistent || !is_of_cell(read.setup, item.cell)) refuse(file, "is damaged");
    item.job = job_from(read, mesh_from(in), item.cell);
    item.job.machine_reachability = reachability_from(in, file);
    const TriangleMesh& mesh = *item.job.piece.mesh;
    if (!is_mesh(mesh) || fs::path(item.result).filename() != item.result) refuse(file, "is damaged");
    if (manifest_of(item.job) != manifest) refuse(file, "does not hold what its manifest says");
    PlacedSetup& placed = item.piece_setup;
    placed.choice.setups = {item.job.setup};
    for (std::size_t others = in.count(); others > 0; --others) {
        const std::string other = in.text();
        Setup setup = from_manifest(other, file.string()).setup;
        if (!is_of_cell(setup, item.cell)) refuse(file, "is damaged");
        placed.choice.setups.push_back(std::move(setup));
        if (manifest_with(item.job, placed.choice.setups.back()) != other) refuse(file, "is damaged");
    }
    placed.choice.states = states_from(in, mesh.triangles.size(), file);
    placed.stock_fit = item.job.stock_fit;
    placed.machine_reachability = item.job.machine_reachability;
    if (!in.is_whole()) refuse(file, "is damaged");
    if (item.has_program() && !placed.fits()) refuse(file, "is of a piece that does not fit");
    return item;
}

ProgramSource source_of(const WorkItem& item) {
    return {item.job, sha256(item.cell_file), item.fine};
}

WorkedPiece worked(const std::string& piece, const PiecePrograms& programs, bool was_kept) {
    WorkedPiece result{piece, ProgramOutcome::none, programs.none_because, was_kept};
    result.is_machine_refusing = programs.is_machine_refusing;
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
    item.effort = item.has_program() ? program_effort(piece_setup.setup()) : 0;
    return item;
}

Bytes to_bytes(const WorkItem& item) {
    CacheWriter out;
    out.put(std::string(mark));
    out.put(item.job.program_version);
    out.put(manifest_of(item.job));
    out.put(static_cast<std::uint8_t>(item.fine));
    out.put(item.result);
    out.put(static_cast<std::uint8_t>(item.is_settled));
    out.put(item.effort);
    out.put_all(item.cell_file);
    put(out, *item.job.piece.mesh);
    put(out, item.piece_setup.machine_reachability);
    const SetupChoice& choice = item.piece_setup.choice;
    out.put(choice.setups.size() - 1);
    for (std::size_t k = 1; k < choice.setups.size(); ++k) out.put(manifest_with(item.job, choice.setups[k]));
    put_states(out, choice.states);
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

void copy_result(const WorkItem& item, const fs::path& from, const fs::path& to) {
    std::error_code error;  // told by the file
    fs::create_directories(to, error);
    write_file(to / item.result, read_file(from / item.result));
}

WorkedPiece work_on(const WorkItem& item, const fs::path& results, const Context& context) {
    if (auto known = result_of(item, results)) return *std::move(known);
    const PiecePrograms programs = make_programs(item.job.piece, item.piece_setup, program_name(item.job), item.cell,
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
