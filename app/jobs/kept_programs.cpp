// The source is the manifest that the job would have without its program, and what that does not hold: the mesh to the
// bit, the holes, how the arm holds each region of poses. What says nothing about the program is left out of it. The
// content is what the job file and its verdict hold of the programs, in their own words. O(bytes).

#include "app/jobs/kept_programs.h"

#include <algorithm>
#include <map>
#include <utility>

#include "app/jobs/job_verdict.h"
#include "app/store/caches/cache_file.h"
#include "cam/job/envelope_document.h"
#include "cam/job/job_caps.h"
#include "cam/job/manifest.h"
#include "cam/job/program_document.h"
#include "cam/post/post.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// To be raised whenever toolpath, program, post or proof make something else of the same source.
constexpr std::uint32_t version_of_programs = 9;

void put(CacheWriter& out, const JobHole& hole) {
    out.put(hole.number);
    out.put(hole.diameter);
    out.put(hole.depth);
    out.put(hole.point);
    out.put(hole.axis);
    out.put(hole.by_hand);
}

std::vector<JobHole> holes_of(const std::vector<DrawnCap>& caps) {
    std::vector<JobCap> bare;
    bare.reserve(caps.size());
    for (const DrawnCap& drawn : caps) bare.push_back(drawn.cap);
    return qchopper::holes_of(bare);
}

// Of a job, what says something about its program.
JobInput without_others(const JobInput& job) {
    JobInput own = job;
    own.piece_no = own.piece_count = 1;
    own.program_version.resize(std::min(own.program_version.find('+'), own.program_version.size()));  // any build
    own.project_id = {};
    own.scan_sha256 = {};
    own.alternatives.clear();
    own.states.clear();
    own.max_unreachable = 1;
    own.warnings.clear();
    own.program.reset();
    own.caps.clear();
    own.no_program_because.clear();
    return own;
}

void put(CacheWriter& out, const ProvenProgram& part) {
    JobProgram program = part.input.program;
    if (program.part.number > 1) program.part.before = Sha256{};  // not known yet; the document asks for one
    out.put(to_json(program));
    JobVerdict verdict;
    static_cast<ProofResult&>(verdict) = part.input.proof;
    out.put(to_json(verdict));
    out.put(part.input.texts.size());
    for (const auto& [name, text] : part.input.texts) {
        out.put(name);
        out.put(text);
    }
    out.put_all(part.input.tools);
    out.put_all(part.input.deviation_picture);
    out.put_all(part.input.stock);
    out.put(part.proof.time_s);
    out.put(part.proof.length_mm);
}

// Throws std::runtime_error if the bytes are not those of a part.
ProvenProgram part_from(CacheReader& in) {
    ProvenProgram part;
    part.input.program = job_program_from_json(in.text());
    part.input.program.part.before.reset();
    part.input.proof = job_verdict_from_json(in.text(), "a kept verdict");
    for (std::size_t texts = in.count(); texts > 0; --texts) {
        std::string name = in.text();
        part.input.texts[std::move(name)] = in.text();
    }
    part.input.tools = in.get_all<std::uint16_t>();
    part.input.deviation_picture = in.get_all<std::uint8_t>();
    part.input.stock = in.get_all<std::uint8_t>();
    static_cast<ProofResult&>(part.proof) = part.input.proof;
    part.proof.chunks = part.input.program.chunks;
    part.proof.time_s = in.get<double>();
    part.proof.length_mm = in.get<double>();
    return part;
}

// The part for a piece of another name.
void rename(ProvenProgram& part, const ProgramName& from, const ProgramName& to) {
    JobProgram& program = part.input.program;
    program.entry = renamed_file(program.entry, from, to);
    for (std::string& file : program.files) file = renamed_file(file, from, to);
    for (JobChunk& chunk : program.chunks) chunk.file = renamed_file(chunk.file, from, to);
    part.proof.chunks = program.chunks;
    for (ProofResult* proof : {static_cast<ProofResult*>(&part.proof), &part.input.proof}) {
        for (ProofFinding& finding : proof->findings) finding.file = renamed_file(finding.file, from, to);
    }
    std::map<std::string, std::string> texts;
    for (const auto& [name, text] : part.input.texts) {
        texts[renamed_file(name, from, to)] = renamed_text(text, from, to);
    }
    part.input.texts = std::move(texts);
}

// The caps of the source with what was decided about their holes.
std::vector<DrawnCap> decided(const ProgramSource& source, const std::vector<std::size_t>& drilled,
                              const std::map<std::size_t, std::string>& reasons) {
    std::vector<DrawnCap> caps = source.job.caps;
    decide_holes(caps, drilled, reasons, {});
    return caps;
}

bool has_name(const std::string& words) {
    return words.find("qc_") != std::string::npos;
}

// Whether nothing but the names of files tells which piece it is. Reasons, findings and notes may name a chunk.
bool can_be_renamed(const PiecePrograms& programs, const std::map<std::size_t, std::string>& reasons) {
    const auto names_chunk = [](const ProvenProgram& part) {
        return std::ranges::any_of(part.proof.findings, has_name, &ProofFinding::text) ||
               std::ranges::any_of(part.proof.notes, has_name);
    };
    return !has_name(programs.none_because) && std::ranges::none_of(programs.parts, names_chunk) &&
           std::ranges::none_of(reasons, [](const auto& reason) { return has_name(reason.second); });
}

std::optional<PiecePrograms> programs_from(CacheReader& in, const ProgramSource& source) {
    PiecePrograms programs;
    const auto number = in.get<std::uint16_t>();
    const ProgramName name{number, in.text()};
    programs.none_because = in.text();
    programs.is_machine_refusing = in.get<std::uint8_t>() != 0;
    if (in.get<std::uint8_t>() != 0) programs.place = block_placement_from(in);
    std::vector<std::size_t> drilled;
    std::map<std::size_t, std::string> reasons;
    for (std::size_t holes = in.count(); holes > 0; --holes) {
        const auto hole = in.get<std::size_t>();
        if (in.get<std::uint8_t>() != 0) drilled.push_back(hole);
        reasons[hole] = in.text();
    }
    programs.caps = decided(source, drilled, reasons);
    for (std::size_t parts = in.count(); parts > 0; --parts) programs.parts.push_back(part_from(in));
    if (!in.is_whole()) return std::nullopt;
    const ProgramName wanted = program_name(source.job);
    if (name == wanted) return programs;
    if (!can_be_renamed(programs, reasons)) return std::nullopt;
    for (ProvenProgram& part : programs.parts) rename(part, name, wanted);
    return programs;
}

}  // namespace

void put(CacheWriter& out, const BlockPlacement& place) {
    for (const double x : {place.x, place.y, place.turn}) out.put(x);
    out.put_all(place.table_angles);
}

BlockPlacement block_placement_from(CacheReader& in) {
    BlockPlacement place;
    for (double* x : {&place.x, &place.y, &place.turn}) *x = in.get<double>();
    place.table_angles = in.get_all<double>();
    return place;
}

CacheWriter toolpath_source(const ProgramSource& source) {
    CacheWriter out;
    out.put(version_of_programs);
    const JobInput own = without_others(source.job);
    out.put(to_manifest(own, {}));
    out.put(envelope_document(own));
    const Piece& piece = source.job.piece;
    for (const Vec3& point : piece.mesh->points) out.put(point);
    out.put_all(piece.mesh->triangles);
    out.put_all(piece.mesh->cap_of);
    out.put_all(std::vector<std::uint8_t>(source.cell_sha256.bytes.begin(), source.cell_sha256.bytes.end()));
    out.put(static_cast<std::uint8_t>(source.fine));
    return out;
}

fs::path programs_file(const fs::path& folder, const ProgramSource& source) {
    CacheWriter out = toolpath_source(source);
    const std::vector<JobHole> holes = holes_of(source.job.caps);
    out.put(holes.size());
    for (const JobHole& hole : holes) put(out, hole);
    out.put(std::to_string(source.job.piece_no).size());
    return cache_file(folder, out, programs_ending);
}

std::optional<PiecePrograms> kept_programs(const fs::path& file, const ProgramSource& source) {
    const std::optional<Bytes> bytes = kept(file);
    if (!bytes) return std::nullopt;
    CacheReader in(*bytes);
    try {
        std::optional<PiecePrograms> programs = programs_from(in, source);
        std::error_code error;
        if (programs) fs::last_write_time(file, fs::file_time_type::clock::now(), error);
        return programs;
    } catch (const std::runtime_error&) {
        return std::nullopt;  // of another schema: made again
    }
}

namespace {

CacheWriter written(const ProgramSource& source, const PiecePrograms& programs) {
    CacheWriter out;
    out.put(source.job.piece_no);
    out.put(program_name(source.job).order);
    out.put(programs.none_because);
    out.put(static_cast<std::uint8_t>(programs.is_machine_refusing));
    out.put(static_cast<std::uint8_t>(programs.place.has_value()));
    if (programs.place) put(out, *programs.place);
    const std::vector<JobHole> holes = holes_of(programs.caps);
    out.put(holes.size());
    for (const JobHole& hole : holes) {
        out.put(hole.number);
        out.put(static_cast<std::uint8_t>(hole.by_robot));
        out.put(hole.by_hand);
    }
    out.put(programs.parts.size());
    for (const ProvenProgram& part : programs.parts) put(out, part);
    return out;
}

}  // namespace

Bytes programs_bytes(const ProgramSource& source, const PiecePrograms& programs) {
    return sealed(written(source, programs));
}

void keep_programs(const fs::path& file, const ProgramSource& source, const PiecePrograms& programs) {
    keep(file, written(source, programs));
}

}  // namespace qchopper
