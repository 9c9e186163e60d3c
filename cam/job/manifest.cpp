// One function per object of the JSON, first to write and then to read it.

#include "cam/job/manifest.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json.h"

namespace qchopper {
namespace {

using namespace json_values;

constexpr const char* format_name = "qchopper job";

Json from_setup(const Setup& setup) {
    Json rows = Json::array();
    for (const Vec3& row : setup.piece_in_setup.row) rows.push_back(from_vector(row));
    return {{"base", setup.base ? Json(*setup.base) : Json(nullptr)},
            {"base_description", setup.base_description},
            {"up", from_vector(setup.up)},
            {"piece_in_setup", {{"rows", rows}, {"shift", from_vector(setup.piece_in_setup.shift)}}},
            {"box", from_box(setup.box)},
            {"undercut", setup.undercut},
            {"base_mm2", setup.base_mm2},
            {"projected_area_mm2", setup.projected_area_mm2},
            {"warnings", setup.warnings}};
}

Json from_half_spaces(const std::vector<HalfSpace>& half_spaces) {
    Json list = Json::array();
    for (const HalfSpace& half_space : half_spaces) {
        list.push_back({{"cut", half_space.cut},
                        {"normal", from_vector(half_space.plane.normal)},
                        {"offset", half_space.plane.offset},
                        {"above", half_space.above}});
    }
    return list;
}

Json from_envelope(const EnvelopeReport& envelope) {
    Json margins = Json::array();
    for (const Margin& margin : envelope.margins) {
        margins.push_back({{"name", margin.name}, {"mm", margin.mm}, {"problem", margin.problem}});
    }
    return {{"fits", envelope.fits()}, {"margins", margins}};
}

Json from_stock(const JobInput& input) {
    const Stock& stock = input.cell.stock[input.setup.block.stock];
    return {{"name", stock.name},
            {"number", input.setup.block.stock},
            {"material", to_word(stock.material)},
            {"size", from_vector(input.setup.block.size)},
            {"turned", input.setup.block.is_turned},
            {"holds", input.setup.block.holds},
            {"margin", input.cell.stock_margin}};
}

std::vector<std::string> texts(const Json& object, const std::string& key) {
    std::vector<std::string> list;
    for (const Json& value : items(object, key)) {
        if (!value.is_string()) throw wrong(key, "is not a list of texts");
        list.push_back(value.get<std::string>());
    }
    return list;
}

std::int32_t cut_number(const Json& object, const std::string& key) {
    const auto number = whole<std::uint32_t>(object, key);
    if (number > std::numeric_limits<std::int32_t>::max()) throw wrong(key, "is no number of a cut");
    return static_cast<std::int32_t>(number);
}

Pose to_pose(const Json& json) {
    const Json& rows = member(json, "rows");
    if (!rows.is_array() || rows.size() != 3) throw wrong("rows", "is not three rows");
    Pose pose;
    for (std::size_t i = 0; i < 3; ++i) pose.row[i] = to_vector(rows[i], "rows");
    pose.shift = vector(json, "shift");
    // A mirror image would pass all other checks and be carved.
    const double turn = dot(pose.row[0], cross(pose.row[1], pose.row[2]));
    if (!(std::abs(turn - 1) < 1e-6)) throw wrong("piece_in_setup", "is not a rotation");
    return pose;
}

Setup to_setup(const Json& json, const Json& stock) {
    Setup setup;
    if (!member(json, "base").is_null()) setup.base = cut_number(json, "base");
    setup.base_description = text(json, "base_description");
    setup.up = vector(json, "up");
    setup.piece_in_setup = to_pose(member(json, "piece_in_setup"));
    setup.box = box(json, "box");
    setup.undercut = real(json, "undercut");
    setup.base_mm2 = real(json, "base_mm2");
    setup.projected_area_mm2 = real(json, "projected_area_mm2");
    setup.warnings = texts(json, "warnings");
    setup.block.stock = whole<std::uint16_t>(stock, "number");
    setup.block.size = vector(stock, "size");
    setup.block.is_turned = truth(stock, "turned");
    setup.block.holds = truth(stock, "holds");
    return setup;
}

EnvelopeReport to_envelope(const Json& json) {
    EnvelopeReport envelope;
    for (const Json& margin : items(json, "margins")) {
        envelope.margins.push_back({text(margin, "name"), text(margin, "problem"), real(margin, "mm")});
    }
    if (envelope.margins.empty()) throw wrong("margins", "is empty");
    if (truth(json, "fits") != envelope.fits()) throw wrong("fits", "contradicts the margins");
    return envelope;
}

std::vector<HalfSpace> to_half_spaces(const Json& json) {
    std::vector<HalfSpace> half_spaces;
    for (const Json& half_space : items(json, "half_spaces")) {
        half_spaces.push_back({cut_number(half_space, "cut"),
                               {vector(half_space, "normal"), real(half_space, "offset")},
                               truth(half_space, "above")});
    }
    return half_spaces;
}

std::vector<JobEntry> to_entries(const Json& json) {
    std::vector<JobEntry> entries;
    for (const Json& entry : items(json, "files")) {
        entries.push_back({text(entry, "name"), whole<std::uint64_t>(entry, "size"), {from_hex<32>(entry, "sha256")}});
    }
    return entries;
}

ReadJob to_job(const Json& json) {
    if (text(json, "format") != format_name) throw wrong("format", "is not a qchopper job");
    const auto schema = whole<std::uint32_t>(json, "schema");
    if (schema != job_schema_version) {
        throw wrong("schema", std::to_string(schema) + " is not " + std::to_string(job_schema_version) +
                                  ", the one that this program reads");
    }
    ReadJob job;
    const Json& piece = member(json, "piece");
    job.piece = text(piece, "name");
    job.piece_no = whole<std::uint16_t>(piece, "number");
    job.piece_count = whole<std::uint16_t>(piece, "count");
    if (job.piece_no < 1 || job.piece_no > job.piece_count) throw wrong("number", "is not one of 1 to count");
    job.faces = whole<std::uint64_t>(piece, "faces");
    job.volume_mm3 = real(piece, "volume_mm3");
    job.program_version = text(member(json, "program"), "version");
    job.project_id = from_hex<16>(json, "project_id");
    job.scan_sha256 = {from_hex<32>(json, "scan_sha256")};
    job.cell_id = whole<std::uint16_t>(member(json, "cell"), "id");
    if (job.cell_id == 0) throw wrong("id", "is the number of no cell");
    job.half_spaces = to_half_spaces(json);
    job.setup = to_setup(member(json, "setup"), member(json, "stock"));
    job.block_name = text(member(json, "stock"), "name");
    job.envelope = to_envelope(member(json, "envelope"));
    job.entries = to_entries(json);
    return job;
}

}  // namespace

std::string to_manifest(const JobInput& input, const std::vector<JobEntry>& entries) {
    Json files = Json::array();
    for (const JobEntry& entry : entries) {
        files.push_back({{"name", entry.name}, {"size", entry.size}, {"sha256", to_hex(entry.sha256)}});
    }
    const Json json = {
        {"format", format_name},
        {"schema", job_schema_version},
        {"program", {{"name", "qchopper"}, {"version", input.program_version}}},
        {"units", {{"length", "mm"}, {"area", "mm2"}, {"volume", "mm3"}}},
        {"piece",
         {{"name", input.piece.name},
          {"number", input.piece_no},
          {"count", input.piece_count},
          {"faces", input.piece.mesh->triangles.size()},
          {"volume_mm3", volume_mm3(*input.piece.mesh)}}},
        {"project_id", to_hex(input.project_id)},
        {"scan_sha256", to_hex(input.scan_sha256)},
        {"cell", {{"name", input.cell.name}, {"id", input.cell.id}}},
        {"half_spaces", from_half_spaces(input.piece.half_spaces)},
        {"setup", from_setup(input.setup)},
        {"stock", from_stock(input)},
        {"envelope", from_envelope(input.envelope)},
        {"warnings", input.warnings},
        {"files", files},
    };
    return written(json);
}

ReadJob from_manifest(std::string_view text, const std::string& source) {
    try {
        const Json json = parsed(text);
        ReadJob job = to_job(json);
        check_form(json, text);
        return job;
    } catch (const std::runtime_error& error) {
        throw InputError(InputFault::mesh, source + ": manifest.json: " + error.what(),
                         "write the job again with qchopper prepare");
    }
}

}  // namespace qchopper
