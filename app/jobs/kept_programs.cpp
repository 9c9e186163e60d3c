// Job files are read and hashed whole; the mesh of the piece is compared as bytes. O(bytes).

#include "app/jobs/kept_programs.h"

#include <algorithm>
#include <map>
#include <utility>

#include "app/jobs/job_verdict.h"
#include "base/error.h"
#include "cam/job/job_caps.h"
#include "cam/job/read_job.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/transform.h"

namespace qchopper {
namespace {

// The caps of the source with the decisions of the job; nothing if the job has other holes.
std::optional<std::vector<DrawnCap>> decided(const ReadJob& job, const ProgramSource& source) {
    std::vector<DrawnCap> caps = source.caps;
    std::vector<std::size_t> drilled;
    std::map<std::size_t, std::string> reasons;
    for (const JobHole& hole : holes_of(job.caps)) {
        if (hole.by_robot) drilled.push_back(hole.number);
        reasons[hole.number] = hole.by_hand;
    }
    decide_holes(caps, drilled, reasons, {});
    std::vector<JobCap> own;
    own.reserve(caps.size());
    for (const DrawnCap& drawn : caps) own.push_back(drawn.cap);
    if (own != job.caps) return std::nullopt;
    return caps;
}

bool is_text(const Bytes& bytes, const std::string& text) {
    return std::equal(bytes.begin(), bytes.end(), text.begin(), text.end());
}

bool is_made_from(const ReadJob& job, const JobVerdict& verdict, const ProgramSource& source, const Bytes& mesh) {
    return job.program && job.setup == source.setup && job.piece_no == source.piece_no &&
           job.program_version == source.program_version && job.files.at("piece.stl") == mesh &&
           is_text(job.files.at("envelope.json"), source.envelope_document) && verdict.job_sha256 == job.file_sha256 &&
           verdict.cell_sha256 == source.cell_sha256 && verdict.program_version == source.program_version;
}

ProvenProgram program_of(const ReadJob& job, const JobVerdict& verdict) {
    ProvenProgram proven;
    ProgramInput& input = proven.input;
    input.program = *job.program;
    input.program.part.before.reset();
    for (const std::string& name : job.program->files) {
        const Bytes& bytes = job.files.at(name);
        input.texts[name] = {bytes.begin(), bytes.end()};
    }
    for (const JobChunk& chunk : job.program->chunks) {
        if (input.tools.empty() || input.tools.back() != chunk.tool) input.tools.push_back(chunk.tool);
    }
    input.proof = verdict;
    const auto picture = job.files.find("deviation.png");
    if (picture != job.files.end()) input.deviation_picture = picture->second;
    const auto stock = job.files.find("stock.bin");
    if (stock != job.files.end()) input.stock = stock->second;
    proven.proof.chunks = job.program->chunks;
    static_cast<ProofResult&>(proven.proof) = verdict;
    proven.proof.time_s = verdict.figure("time_s");
    proven.proof.length_mm = 1000 * verdict.figure("path_m");
    return proven;
}

}  // namespace

std::optional<PiecePrograms> kept_programs(const std::filesystem::path& jobs, const ProgramSource& source) {
    const Bytes mesh = to_stl(apply(source.setup.piece_in_setup, *source.piece.mesh));
    PiecePrograms programs;
    try {
        for (std::uint16_t part = 1, count = 1; part <= count; ++part) {
            const std::filesystem::path file = jobs / job_file_name(source.piece.name, part);
            const std::optional<JobVerdict> verdict = read_verdict(file);
            if (!verdict) return std::nullopt;
            const ReadJob job = parse_job(read_job(file), file.string());
            if (!is_made_from(job, *verdict, source, mesh) || job.program->part.number != part) return std::nullopt;
            std::optional<std::vector<DrawnCap>> caps = decided(job, source);
            if (!caps) return std::nullopt;
            programs.caps = std::move(*caps);
            count = job.program->part.count;
            programs.parts.push_back(program_of(job, *verdict));
        }
    } catch (const InputError&) {
        return std::nullopt;  // missing or damaged: made again
    }
    return programs;
}

}  // namespace qchopper
