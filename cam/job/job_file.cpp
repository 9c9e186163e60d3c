// Packs by base/zip.h; every entry is hashed once when it is written and once when it is read. O(bytes), with the files
// and the archive in memory.

#include "cam/job/job_file.h"

#include "base/error.h"
#include "base/portable_name.h"
#include "base/zip.h"
#include "cam/job/manifest.h"
#include "cam/job/preview.h"
#include "cam/job/setup_sheet.h"
#include "segment/io/write_stl.h"
#include "segment/mesh/transform.h"

namespace qchopper {
namespace {

constexpr std::uint64_t largest_text = 16u << 20;  // of manifest and ticket, which have kilobytes
constexpr const char* manifest_name = "manifest.json";
constexpr const char* ticket_name = "ticket.json";

Bytes to_bytes(const std::string& text) {
    return {text.begin(), text.end()};
}

std::string_view as_text(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::uint16_t base_plane(const JobInput& input) {
    if (!input.setup.base) return no_base_plane;
    if (*input.setup.base < 0 || *input.setup.base >= no_base_plane) {
        throw InputError(InputFault::use, "piece " + input.piece.name + ": cut " + std::to_string(*input.setup.base) +
                                              " has no place in a ticket, which counts up to 65534");
    }
    return static_cast<std::uint16_t>(*input.setup.base);
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
    for (const char* name : {"piece.stl", "preview.glb", "setup.txt", ticket_name}) {
        if (!job.files.contains(name)) refuse(source, std::string(name) + " is missing");
    }
}

void check_ticket(const ReadJob& job, const std::string& source) {
    const TicketTemplate& ticket = job.ticket;
    const std::int32_t base = job.setup.base.value_or(no_base_plane);
    const bool same = ticket.piece == job.piece && ticket.piece_no == job.piece_no &&
                      ticket.piece_count == job.piece_count && ticket.project_id == job.project_id &&
                      ticket.box == job.setup.box && ticket.stock == job.setup.block.size && ticket.base_plane == base;
    if (!same) refuse(source, "ticket.json and manifest.json describe different jobs");
}

}  // namespace

std::string job_file_name(const std::string& piece) {
    std::string name = piece + ".qjob";
    if (!is_portable_name(name) || piece.empty()) {
        throw InputError(InputFault::use, "piece \"" + piece + "\" cannot name a job file",
                         "use up to 27 of A-Z a-z 0-9 . _ -");
    }
    return name;
}

TicketTemplate ticket_template(const JobInput& input) {
    const Vec3 block = input.setup.block.size;
    const Tool& tool = input.cell.tool;
    TicketTemplate about;
    about.piece = input.piece.name;
    about.piece_no = input.piece_no;
    about.piece_count = input.piece_count;
    about.project_id = input.project_id;
    about.box = input.setup.box;
    about.stock = block;
    about.material = input.cell.stock[input.setup.block.stock].material;
    about.tool_no = tool.number;
    about.tool_diameter = tool.diameter;
    about.spindle_max_rpm = tool.spindle_max_rpm;
    about.feed_max_mm_per_min = tool.feed_max_mm_per_min;
    about.estimated_time_s =
        crude_time_s(block.x * block.y * block.z, volume_mm3(*input.piece.mesh), tool.removal_mm3_per_s);
    about.base_plane = base_plane(input);
    return about;
}

Bytes job_file(const JobInput& input) {
    job_file_name(input.piece.name);  // throws if the name does not fit the wire
    const PreviewNotes notes{input.piece.name,  input.program_version,         input.piece_no,
                             input.piece_count, input.setup.base.value_or(-1), input.envelope.fits()};
    std::map<std::string, Bytes> files;
    {
        const TriangleMesh lying = apply(input.setup.piece_in_setup, *input.piece.mesh);
        files["preview.glb"] = preview_glb(lying, notes);
        files["piece.stl"] = to_stl(lying);
    }
    const TicketTemplate ticket = ticket_template(input);
    files["setup.txt"] = to_bytes(setup_sheet(input, ticket.estimated_time_s));
    files[ticket_name] = to_bytes(to_json(ticket));
    std::vector<JobEntry> entries;
    std::uint64_t total = 0;
    for (const auto& [name, bytes] : files) {
        entries.push_back({name, bytes.size(), sha256(bytes)});
        total += bytes.size();
    }
    if (total > job_limit.bytes - largest_text) {
        throw InputError(InputFault::use, "piece " + input.piece.name + ": its job file would exceed 4 GB",
                         "cut the piece further");
    }
    files[manifest_name] = to_bytes(to_manifest(input, entries));
    return zip(std::move(files));
}

ReadJob parse_job(const Bytes& bytes, const std::string& source) {
    if (bytes.size() > job_limit.bytes) refuse(source, "it is larger than 4 GB");
    std::map<std::string, Bytes> files = unzip(bytes, source);
    for (const char* name : {manifest_name, ticket_name}) {
        if (!files.contains(name)) refuse(source, std::string(name) + " is missing");
        if (files[name].size() > largest_text) refuse(source, std::string(name) + " is too large");
    }
    ReadJob job = from_manifest(as_text(files[manifest_name]), source);
    job.files = std::move(files);
    check_entries(job, source);
    job.ticket = ticket_template_from_json(as_text(job.files[ticket_name]), source);
    check_ticket(job, source);
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
