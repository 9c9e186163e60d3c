// Packs by base/files/zip.h and hashes every entry once. O(bytes), with the files and the archive in memory; besides,
// two pictures are drawn (setup_picture.cpp).

#include "cam/job/write_job.h"

#include <algorithm>

#include "base/error.h"
#include "base/files/zip.h"
#include "cam/cell/job_tools.h"
#include "cam/job/envelope_document.h"
#include "cam/job/manifest.h"
#include "cam/job/read_job.h"
#include "cam/job/sheet/cap_template.h"
#include "cam/job/sheet/envelope_picture.h"
#include "cam/job/sheet/preview.h"
#include "cam/job/sheet/setup_picture.h"
#include "cam/job/sheet/setup_sheet.h"
#include "cam/job/sheet/sheet_details.h"
#include "cam/job/sheet/template_pdf.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/transform.h"

namespace qchopper {
namespace {

constexpr std::uint64_t largest_manifest = 16u << 20;  // bytes; it has kilobytes
constexpr const char* manifest_name = "manifest.json";
constexpr const char* ticket_name = "ticket.json";
constexpr const char* stock_name = "stock.bin";
constexpr const char* deviation_name = "deviation.png";

Bytes to_bytes(const std::string& text) {
    return {text.begin(), text.end()};
}

std::uint16_t base_plane(const JobInput& input) {
    if (!input.setup.base) return no_base_plane;
    if (*input.setup.base < 0 || *input.setup.base >= no_base_plane) {
        throw InputError(InputFault::use, "piece " + input.piece.name + ": cut " + std::to_string(*input.setup.base) +
                                              " has no place in a ticket, which counts up to 65534");
    }
    return static_cast<std::uint16_t>(*input.setup.base);
}

// The first tool that the program uses; diameter, speed and feed are the largest of all that it uses.
void set_tools(TicketTemplate& about, const ProgramInput& program, const Cell& cell) {
    if (program.tools.empty()) return;
    about.tool_no = program.tools.front();
    about.tool_diameter = 0;
    about.spindle_max_rpm = 0;
    about.feed_max_mm_per_min = 0;
    for (const Tool& tool : tools_of(cell)) {
        if (std::find(program.tools.begin(), program.tools.end(), tool.number) == program.tools.end()) continue;
        about.tool_diameter = std::max(about.tool_diameter, tool.diameter);
        about.spindle_max_rpm = std::max(about.spindle_max_rpm, tool.spindle_max_rpm);
        about.feed_max_mm_per_min = std::max(about.feed_max_mm_per_min, tool.feed_max_mm_per_min);
    }
}

void add_program(const ProgramInput& input, std::map<std::string, Bytes>& files) {
    for (const auto& [name, text] : input.texts) files[name] = to_bytes(text);
    if (input.program.has_stock()) files[stock_name] = input.stock;
    if (!input.deviation_picture.empty()) files[deviation_name] = input.deviation_picture;
}

std::vector<JobEntry> entries_of(const std::map<std::string, Bytes>& files, const std::string& piece) {
    std::vector<JobEntry> entries;
    std::uint64_t total = 0;
    for (const auto& [name, bytes] : files) {
        entries.push_back({name, bytes.size(), sha256(bytes)});
        total += bytes.size();
    }
    if (total > job_limit.bytes - largest_manifest) {
        throw InputError(InputFault::use, "piece " + piece + ": its job file would exceed 4 GB",
                         "cut the piece further");
    }
    return entries;
}

}  // namespace

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
    if (input.program) {
        const JobProgram& program = input.program->program;
        about.estimated_time_s = whole_seconds(program.time_s);
        if (program.part.count > 1) {
            about.part = program.part.number;
            about.parts = program.part.count;
        }
        set_tools(about, *input.program, input.cell);
    }
    return about;
}

Bytes job_file(const JobInput& input) {
    job_file_name(input.piece.name);  // throws if the name does not fit the wire
    const PreviewNotes notes{input.piece.name,  input.program_version,         input.piece_no,
                             input.piece_count, input.setup.base.value_or(-1), input.stock_fit.fits()};
    std::map<std::string, Bytes> files;
    {
        const TriangleMesh lying = apply(input.setup.piece_in_setup, *input.piece.mesh);
        files["preview.glb"] = preview_glb(lying, notes);
        files["piece.stl"] = to_stl(lying);
        const SetupPictures pictures = setup_pictures(input, lying);
        files["setup-1.png"] = pictures.front;
        files["setup-2.png"] = pictures.back;
        if (input.machine_reachability.is_arm_checked) files["envelope.png"] = envelope_picture(input, lying);
    }
    if (input.program) add_program(*input.program, files);
    for (const DrawnCap& cap : input.caps) {
        const CapTemplate drawing = cap_template(cap, input.piece.name);
        files[template_name(cap.cap.cut, "svg")] = to_bytes(template_svg(drawing));
        files[template_name(cap.cap.cut, "pdf")] = template_pdf(drawing);
    }
    const TicketTemplate ticket = ticket_template(input);
    files["setup.html"] = to_bytes(setup_sheet(input, ticket.estimated_time_s));
    files["details.html"] = to_bytes(sheet_details(input));
    files["envelope.json"] = to_bytes(envelope_document(input));
    files[ticket_name] = to_bytes(to_json(ticket));
    files[manifest_name] = to_bytes(to_manifest(input, entries_of(files, input.piece.name)));
    return zip(std::move(files));
}

Bytes restart_job_file(const ReadJob& first, const ProgramInput& program, const Cell& cell) {
    std::map<std::string, Bytes> files = first.files;
    for (const std::string& name : first.program->files) files.erase(name);
    for (const char* name : {manifest_name, stock_name, deviation_name}) files.erase(name);
    add_program(program, files);
    TicketTemplate ticket = first.ticket;
    ticket.estimated_time_s = whole_seconds(program.program.time_s);
    set_tools(ticket, program, cell);
    files[ticket_name] = to_bytes(to_json(ticket));
    ReadJob job = first;
    job.program = program.program;
    job.entries = entries_of(files, job.piece);
    files[manifest_name] = to_bytes(to_manifest(job));
    return zip(std::move(files));
}

}  // namespace qchopper
