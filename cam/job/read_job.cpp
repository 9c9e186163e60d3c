// Unpacks by base/files/zip.h and hashes every entry once. O(bytes), with the archive and the files in memory.

#include "cam/job/read_job.h"

#include <array>

#include "base/error.h"
#include "base/files/portable_name.h"
#include "base/files/zip.h"
#include "cam/job/cap_document.h"
#include "cam/job/envelope_document.h"
#include "cam/job/manifest.h"
#include "cam/job/program_document.h"

namespace qchopper {
namespace {

constexpr std::uint64_t largest_text = 16u << 20;  // of manifest and ticket, which have kilobytes
constexpr const char* manifest_name = "manifest.json";
constexpr const char* ticket_name = "ticket.json";
constexpr const char* envelope_name = "envelope.json";
constexpr const char* stock_name = "stock.bin";

std::string_view as_text(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

[[noreturn]] void refuse(const std::string& source, const std::string& why) {
    throw InputError(InputFault::mesh, source + " is not a whole job file: " + why,
                     "write it again with qchopper prepare, or copy it again");
}

// The manifest must list exactly the files that are there.
void check_entries(const ReadJob& job, const std::string& source) {
    if (job.entries.size() + 1 != job.files.size()) refuse(source, "the manifest lists other files than are there");
    for (const JobEntry& entry : job.entries) {
        const auto found = job.files.find(entry.name);
        if (entry.name == manifest_name || found == job.files.end()) refuse(source, entry.name + " is missing");
        if (found->second.size() != entry.size)
            refuse(source, entry.name + " has another size than the manifest lists");
        if (sha256(found->second) != entry.sha256) refuse(source, entry.name + " does not match its SHA-256");
    }
    constexpr std::array names{envelope_name, "piece.stl",  "preview.glb", "setup-1.png",
                               "setup-2.png", "setup.html", ticket_name};
    for (const char* name : names) {
        if (!job.files.contains(name)) refuse(source, std::string(name) + " is missing");
    }
    const bool continues = job.program && job.program->has_stock();
    if (continues != job.files.contains(stock_name)) {
        refuse(source,
               std::string(stock_name) + (continues ? " is missing" : " belongs to a later part or to a restart"));
    }
    for (const std::string& fault :
         {fault_of_program_files(job.program, job.files), fault_of_templates(job.caps, job.files)}) {
        if (!fault.empty()) refuse(source, fault);
    }
}

void check_ticket(const ReadJob& job, const std::string& source) {
    const TicketTemplate& ticket = job.ticket;
    const std::int32_t base = job.setup.base.value_or(no_base_plane);
    const JobPart part = job.program ? job.program->part : JobPart{};
    const bool same = ticket.part == (part.count > 1 ? part.number : 0) &&
                      ticket.parts == (part.count > 1 ? part.count : 0) && ticket.piece == job.piece &&
                      ticket.piece_no == job.piece_no && ticket.piece_count == job.piece_count &&
                      ticket.project_id == job.project_id && ticket.box == job.setup.box &&
                      ticket.stock == job.setup.block.size && ticket.base_plane == base;
    if (!same) refuse(source, "ticket.json and manifest.json describe different jobs");
}

void check_poses(const ReadJob& job, const std::string& source) {
    const ReachabilitySummary poses = read_envelope_document(as_text(job.files.at(envelope_name)), source);
    const bool same = poses.piece == job.piece && poses.is_arm_checked == job.is_arm_checked &&
                      poses.holds == job.holds_poses && poses.placement == job.setup.placement;
    if (!same) refuse(source, "envelope.json and manifest.json describe different jobs");
    const bool has_picture = job.files.contains("envelope.png");
    if (has_picture != job.is_arm_checked) refuse(source, "envelope.png is there without poses, or missing");
}

}  // namespace

std::string job_file_name(const std::string& piece, std::uint16_t part, std::uint32_t from_chunk) {
    std::string name = piece;
    if (part > 1) name += ".p" + std::to_string(part);
    if (from_chunk > 0) name += ".r" + std::to_string(from_chunk);
    name += ".qjob";
    if (!is_portable_name(name) || piece.empty()) {
        throw InputError(InputFault::use, "piece \"" + piece + "\" cannot name a job file",
                         "use up to 27 of A-Z a-z 0-9 . _ -");
    }
    return name;
}

ReadJob parse_job(const Bytes& bytes, const std::string& source) {
    if (bytes.size() > job_limit.bytes) refuse(source, "it is larger than 4 GB");
    std::map<std::string, Bytes> files = unzip(bytes, source);
    for (const char* name : {manifest_name, ticket_name, envelope_name}) {
        if (!files.contains(name)) refuse(source, std::string(name) + " is missing");
        if (files[name].size() > largest_text) refuse(source, std::string(name) + " is too large");
    }
    ReadJob job = from_manifest(as_text(files[manifest_name]), source);
    job.files = std::move(files);
    check_entries(job, source);
    job.ticket = ticket_template_from_json(as_text(job.files[ticket_name]), source);
    check_ticket(job, source);
    check_poses(job, source);
    job.file_size = static_cast<std::uint32_t>(bytes.size());
    job.file_sha256 = sha256(bytes);
    return job;
}

Bytes read_job(const std::filesystem::path& path) {
    return read_file(path, job_limit);
}

JobTicket job_ticket(const ReadJob& job, const std::string& file_name) {
    if (!is_portable_name(file_name)) {
        throw InputError(InputFault::use, "the cell takes no file of the name " + file_name,
                         "use 1 to 32 of A-Z a-z 0-9 . _ -, not beginning with a dot");
    }
    return {job.ticket, file_name, job.file_size, job.file_sha256};
}

}  // namespace qchopper
