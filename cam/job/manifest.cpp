// One table per object of the JSON. A job that is written becomes what its reader gets, so both have the same table.
// O(orientations + caps + chunks).

#include "cam/job/manifest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/json_fields.h"
#include "base/json_schema.h"
#include "cam/job/cap_document.h"
#include "cam/job/document_schemas.h"
#include "cam/job/glue_faces.h"
#include "cam/job/program_document.h"
#include "cam/job/setup_fields.h"
#include "cam/setup/block_placement.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

using namespace json_values;

std::string state_word(const ReadJob& job) {
    return is_unreachable(job.setup, job.max_unreachable) ? "unreachable" : "ready";
}

template <class T>
std::optional<std::vector<T>> null_if_empty(const std::vector<T>& values) {
    return values.empty() ? std::nullopt : std::optional(values);
}

}  // namespace

template <class V, Of<Alternative> T>
void fields(V& v, T& other) {
    v("base_number", other.base_number);
    v.check(other.base_number >= 0, "base_number", "is not a whole number in bounds");
    v("base_description", other.base_description);
    v("method", other.method);
    v("unreachable_share", other.unreachable_share, not_negative);
    v("foam_mm3", other.foam_mm3, not_negative);
    v("rest_material_mm3", other.rest_material_mm3, not_negative);
    v("block_mm", other.block);
    v("orientations", other.directions);
}

template <class V, Of<HalfSpace> T>
void fields(V& v, T& half_space) {
    v("cut", half_space.cut);
    v.check(half_space.cut >= 0, "cut", "is no number of a cut");
    v("normal", half_space.plane.normal);
    v("offset_mm", half_space.plane.offset);
    v("above", half_space.above);
}

template <class V, Of<Margin> T>
void fields(V& v, T& margin) {
    v("name", margin.name);
    v("mm", margin.mm);
    v("problem", margin.problem);
}

template <class V, Of<StockFit> T>
void fields(V& v, T& stock_fit) {
    v.derived(
        "fits", [&] { return stock_fit.fits(); }, "contradicts the margins");
    v("margins", stock_fit.margins);
    v.check(!stock_fit.margins.empty(), "margins", "is empty");
}

template <class V, Of<JobEntry> T>
void fields(V& v, T& entry) {
    v("name", entry.name);
    v("size", entry.size);
    v("sha256", entry.sha256);
}

template <class V, Of<FlushCap> T>
void fields(V& v, T& cap) {
    v("cut", cap.cut);
    v.check(cap.cut >= 0, "cut", "is no number of a cut");
    v("face", cap.face);
    v("area_mm2", cap.area_mm2, not_negative);
}

namespace {

template <class V, class Job>
void setup_fields(V& v, Job& job) {
    auto& setup = job.setup;
    base_fields(v, setup);
    v("up", setup.up);
    v("piece_in_setup", setup.piece_in_setup);
    v("box", setup.box);
    v("spoil", setup.spoil, not_negative);
    v.maybe("flush_caps", setup.flush_caps);
    v.maybe("milled_caps_mm2", setup.milled_caps_mm2, 0, not_negative);
    v.converted("tools", setup.tools, null_if_empty<std::uint16_t>, [](const auto& tools) {
        if (tools && tools->empty()) throw wrong("tools", "is not a list of numbers of tools");
        return tools.value_or(std::vector<std::uint16_t>());
    });
    v.check(is_ascending(setup.tools), "tools", "are not in order");
    v("placement", setup.placement);
    v("setup_in_cell", job.setup_in_cell);
    v("undercut", setup.undercut);
    v("undercut_by_count", setup.undercut_by_count);
    v("base_mm2", setup.base_mm2);
    v("projected_area_mm2", setup.projected_area_mm2);
    v("workholding", setup.workholding);
    v("reach", setup.access);
    v("warnings", setup.warnings);
    // One per direction of the tool for which the table has an angle of its own, else one.
    const std::size_t angles = setup.placement.table_angles.size();
    v.check(angles == 0 || angles == setup.access.orientations.size(), "table_angles_deg",
            "is not one per orientation");
    v.check(job.setup_in_cell.size() == std::max<std::size_t>(1, angles), "setup_in_cell", "is not one per angle");
}

template <class V, class Job>
void stock_fields(V& v, Job& job) {
    auto& block = job.setup.block;
    v("name", job.block_name);
    v("number", block.stock);
    v.check(block.stock <= std::numeric_limits<std::uint16_t>::max(), "number", "is not a whole number in bounds");
    v("material", job.material);
    v("size", block.size);
    v("turned", block.is_turned);
    v("sawn", block.is_sawn);
    v("offcuts_mm", block.offcuts);
    v("holds", block.holds);
    v("stock_margin", job.margin);
    v.maybe("foam_at_faces_mm", job.foam_at_faces);
}

template <class V, class Job>
void piece_fields(V& v, Job& job) {
    v("name", job.piece);
    v("number", job.piece_no);
    v("count", job.piece_count);
    v.check(job.piece_no >= 1 && job.piece_no <= job.piece_count, "number", "is not one of 1 to count");
    v("faces", job.faces);
    v("volume_mm3", job.volume_mm3);
}

// A list of one program, or of none.
std::vector<JobProgram> to_list(const std::optional<JobProgram>& program) {
    return program ? std::vector{*program} : std::vector<JobProgram>();
}

std::optional<JobProgram> to_program(const std::vector<JobProgram>& list) {
    if (list.size() > 1) throw wrong("programs", "is not a list of at most one program");
    return list.empty() ? std::nullopt : std::optional(list.front());
}

}  // namespace

template <class V, Of<ReadJob> T>
void fields(V& v, T& job) {
    v.constant("format", "qchopper job", "is not a qchopper job");
    v.version("schema", job_schema_version);
    v.object("program", [&](auto& program) {
        program.constant("name", "qchopper", "is not qchopper");
        program("version", job.program_version);
    });
    v.object("units", [](auto& units) {
        units.constant("length", "mm", "is not mm");
        units.constant("area", "mm2", "is not mm2");
        units.constant("volume", "mm3", "is not mm3");
    });
    v.object("piece", [&](auto& piece) { piece_fields(piece, job); });
    v("project_id", job.project_id);
    v("scan_sha256", job.scan_sha256);
    v.object("cell", [&](auto& cell) {
        cell("name", job.cell);
        cell("id", job.cell_id);
        cell.check(job.cell_id != 0, "id", "is the number of no cell");
    });
    v("half_spaces", job.half_spaces);
    v("caps", job.caps);
    v.object("setup", [&](auto& setup) { setup_fields(setup, job); });
    v.object("stock", [&](auto& stock) { stock_fields(stock, job); });
    v("alternatives", job.alternatives);
    v("max_unreachable", job.max_unreachable, not_negative);
    v.check(job.max_unreachable <= 1, "max_unreachable", "is out of range");
    v.derived(
        "state", [&] { return state_word(job); }, "contradicts the unreachable share and its limit");
    v("stock_fit", job.stock_fit);
    v.object("work_envelope", [&](auto& poses) {
        poses("arm_checked", job.is_arm_checked);
        poses("holds", job.holds_poses);
    });
    v.converted("programs", job.program, to_list, to_program);
    v("no_program_because", job.no_program_because);
    v.check(job.program.has_value() == job.no_program_because.empty(), "no_program_because",
            "contradicts the programs");
    v("warnings", job.warnings);
    v("files", job.entries);
}

namespace {

// What reading the manifest of this job gives.
ReadJob described(const JobInput& input, std::vector<JobEntry> entries) {
    ReadJob job;
    job.piece = input.piece.name;
    job.piece_no = input.piece_no;
    job.piece_count = input.piece_count;
    job.program_version = input.program_version;
    job.project_id = input.project_id;
    job.scan_sha256 = input.scan_sha256;
    job.cell = input.cell.name;
    job.cell_id = input.cell.id;
    job.setup = input.setup;
    job.alternatives = alternatives_of(input);
    job.max_unreachable = input.max_unreachable;
    const Stock& stock = input.cell.stock[input.setup.block.stock];
    job.block_name = stock.name;
    job.material = stock.material;
    job.margin = input.cell.stock_margin();
    if (!input.setup.flush_caps.empty()) job.foam_at_faces = foam_around(input.setup);
    job.half_spaces = input.piece.half_spaces;
    for (const DrawnCap& drawn : input.caps) job.caps.push_back(drawn.cap);
    job.stock_fit = input.stock_fit;
    job.is_arm_checked = input.machine_reachability.is_arm_checked;
    job.holds_poses = input.machine_reachability.holds();
    const BlockPlacement& placement = input.setup.placement;
    for (std::size_t d = 0; d < std::max<std::size_t>(1, placement.table_angles.size()); ++d) {
        job.setup_in_cell.push_back(setup_in_cell(input.cell, input.setup.spoil, placement, d));
    }
    job.faces = input.piece.mesh->triangles.size();
    job.volume_mm3 = volume_mm3(*input.piece.mesh);
    if (input.program) {
        job.program = input.program->program;
    } else {
        job.no_program_because = input.no_program_because;
    }
    job.warnings = input.warnings;
    job.entries = std::move(entries);
    return job;
}

// Each flush cap is that of a half-space of the piece and not the base; foam stands at no flush face, and at the others
// what block and piece say.
void check_flush_caps(const ReadJob& job) {
    constexpr double agreement = 1e-3;  // mm
    const Setup& setup = job.setup;
    for (const FlushCap& cap : setup.flush_caps) {
        const auto is_its = [&](const HalfSpace& half_space) { return half_space.cut == cap.cut; };
        if (cap.cut == setup.base || std::none_of(job.half_spaces.begin(), job.half_spaces.end(), is_its)) {
            throw wrong("flush_caps", "name cut " + std::to_string(cap.cut) + ", which has no such cap of the piece");
        }
    }
    const auto is_not_before = [](const FlushCap& cap, const FlushCap& next) { return cap.cut >= next.cut; };
    if (std::ranges::adjacent_find(setup.flush_caps, is_not_before) != setup.flush_caps.end()) {
        throw wrong("flush_caps", "are not in the order of their cuts");
    }
    if (setup.flush_caps.empty() != job.foam_at_faces.empty())
        throw wrong("foam_at_faces_mm", "contradicts flush_caps");
    if (setup.flush_caps.empty()) return;
    if (!setup.base) throw wrong("flush_caps", "are given for a piece without a base");
    const std::vector<double> foam = foam_around(setup);
    const FlushFaces flush = setup.flush_faces();
    if (job.foam_at_faces.size() != block_faces) throw wrong("foam_at_faces_mm", "is not one number for each face");
    for (std::size_t f = 0; f < block_faces; ++f) {
        const bool is_none = std::abs(foam[f]) <= 0.5 * flush_step + agreement;
        if (std::abs(foam[f] - job.foam_at_faces[f]) > agreement || (flush[f] && !is_none)) {
            throw wrong("foam_at_faces_mm", "contradicts block, box and flush_caps");
        }
    }
}

void check_parts(const ReadJob& job) {
    check_flush_caps(job);
    check_caps(job.caps, job.setup.piece_in_setup);
    const std::string of_holes = fault_of_holes(job.program, job.caps);
    if (!of_holes.empty()) throw wrong("holes", of_holes);
    const std::string of_tools = fault_of_tools(job.program, job.setup.tools);
    if (!of_tools.empty()) throw wrong("tools", of_tools);
}

}  // namespace

std::vector<Alternative> alternatives_of(const JobInput& input) {
    std::vector<Alternative> alternatives;
    for (const Setup& other : input.alternatives) {
        alternatives.push_back({other.base_number, other.base_description, other.access.method,
                                other.access.unreachable_share(), other.access.foam_mm3, other.access.rest_material_mm3,
                                other.block.size, static_cast<std::uint32_t>(other.access.orientations.size())});
    }
    return alternatives;
}

std::string to_manifest(const JobInput& input, std::vector<JobEntry> entries) {
    return to_document(described(input, std::move(entries)));
}

std::string to_manifest(const ReadJob& job) {
    return to_document(job);
}

std::string manifest_schema() {
    return schema_of_document<ReadJob>("manifest of a job of qchopper");
}

ReadJob from_manifest(std::string_view text, const std::string& source) {
    try {
        ReadJob job;
        from_document(text, job);
        check_parts(job);
        return job;
    } catch (const std::runtime_error& error) {
        throw InputError(InputFault::mesh, source + ": manifest.json: " + error.what(),
                         "write the job again with qchopper prepare");
    }
}

}  // namespace qchopper
