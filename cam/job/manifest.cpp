// One function per object of the JSON, first to write and then to read it.

#include "cam/job/manifest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json.h"
#include "cam/job/cap_document.h"
#include "cam/job/pose_json.h"
#include "cam/job/program_document.h"
#include "cam/job/workholding_json.h"
#include "cam/setup/block_placement.h"

namespace qchopper {
namespace {

using namespace json_values;

constexpr const char* format_name = "qchopper job";

constexpr double most = std::numeric_limits<double>::max();

const char* to_word(AccessMethod method) {
    return method == AccessMethod::mapped ? "mapped" : "sampled";
}

const char* state_word(const Setup& setup, double max_unreachable) {
    return is_unreachable(setup, max_unreachable) ? "unreachable" : "ready";
}

Json from_direction(const ToolOrientation& orientation) {
    return {{"out", from_vector(orientation.tool_axis)},
            {"tilt_deg", orientation.tilt_deg},
            {"gained_share", orientation.gained_share},
            {"depth_mm", orientation.depth_mm}};
}

Json from_access(const SurfaceAccess& access) {
    Json directions = Json::array();
    for (const ToolOrientation& orientation : access.orientations) directions.push_back(from_direction(orientation));
    Json json{{"method", to_word(access.method)},
              {"arm_checked", access.is_arm_checked},
              {"directions", directions},
              {"further", access.further ? from_direction(*access.further) : Json(nullptr)},
              {"area_mm2", access.area_mm2},
              {"hidden_mm2", access.hidden_mm2},
              {"steep_mm2", access.steep_mm2},
              {"holder_mm2", access.holder_mm2},
              {"too_narrow_mm2", access.too_narrow_mm2},
              {"steep_counts", access.steep_counts},
              {"narrow_counts", access.narrow_counts},
              {"unreachable_share", access.unreachable_share()},
              {"all_directions_share", access.all_directions_share},
              {"foam_mm3", access.foam_mm3},
              {"foam_depth_mm", access.foam_depth_mm},
              {"residue_mm3", access.rest_material_mm3}};
    if (access.ignored_mm2 > 0) json["ignored_mm2"] = access.ignored_mm2;
    return json;
}

Json from_alternatives(const std::vector<Alternative>& alternatives) {
    Json list = Json::array();
    for (const Alternative& other : alternatives) {
        list.push_back({{"base_number", other.base_number},
                        {"base_description", other.base_description},
                        {"method", to_word(other.method)},
                        {"unreachable_share", other.unreachable_share},
                        {"foam_mm3", other.foam_mm3},
                        {"residue_mm3", other.rest_material_mm3},
                        {"block", from_vector(other.block)},
                        {"directions", other.directions}});
    }
    return list;
}

Json from_placement(const BlockPlacement& placement) {
    return {{"x", placement.x},
            {"y", placement.y},
            {"turn_rad", placement.turn},
            {"table_angles_rad", placement.table_angles}};
}

Json from_frames(const JobInput& input) {
    Json frames = Json::array();
    const BlockPlacement& placement = input.setup.placement;
    for (std::size_t d = 0; d < std::max<std::size_t>(1, placement.table_angles.size()); ++d) {
        frames.push_back(from_pose(setup_in_cell(input.cell, input.setup.spoil, placement, d)));
    }
    return frames;
}

Json from_setup(const JobInput& input) {
    const Setup& setup = input.setup;
    return {{"base_number", setup.base_number},
            {"base", setup.base ? Json(*setup.base) : Json(nullptr)},
            {"base_description", setup.base_description},
            {"up", from_vector(setup.up)},
            {"piece_in_setup", from_pose(setup.piece_in_setup)},
            {"box", from_box(setup.box)},
            {"spoil", setup.spoil},
            {"tools", setup.tools.empty() ? Json(nullptr) : Json(setup.tools)},
            {"placement", from_placement(setup.placement)},
            {"setup_in_cell", from_frames(input)},
            {"undercut", setup.undercut},
            {"undercut_by_count", setup.undercut_by_count},
            {"base_mm2", setup.base_mm2},
            {"projected_area_mm2", setup.projected_area_mm2},
            {"workholding", setup.workholding ? from_workholding(*setup.workholding) : Json(nullptr)},
            {"reach", from_access(setup.access)},
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

Json from_envelope(const StockFit& stock_fit) {
    Json margins = Json::array();
    for (const Margin& margin : stock_fit.margins) {
        margins.push_back({{"name", margin.name}, {"mm", margin.mm}, {"problem", margin.problem}});
    }
    return {{"fits", stock_fit.fits()}, {"margins", margins}};
}

Json from_stock(const JobInput& input) {
    const Stock& stock = input.cell.stock[input.setup.block.stock];
    Json offcuts = Json::array();
    for (const Vec3& offcut : input.setup.block.offcuts) offcuts.push_back(from_vector(offcut));
    return {{"name", stock.name},
            {"number", input.setup.block.stock},
            {"material", to_word(stock.material)},
            {"size", from_vector(input.setup.block.size)},
            {"turned", input.setup.block.is_turned},
            {"sawn", input.setup.block.is_sawn},
            {"offcuts", offcuts},
            {"holds", input.setup.block.holds},
            {"margin", input.cell.stock_margin()}};
}

double not_negative(const Json& object, const std::string& key) {
    return real_within(object, key, 0, most);
}

std::int32_t cut_number(const Json& object, const std::string& key) {
    const auto number = whole<std::uint32_t>(object, key);
    if (number > std::numeric_limits<std::int32_t>::max()) throw wrong(key, "is no number of a cut");
    return static_cast<std::int32_t>(number);
}

int base_number(const Json& object) {
    return static_cast<int>(whole_up_to(object, "base_number", std::numeric_limits<std::int32_t>::max()));
}

AccessMethod to_method(const Json& object) {
    const std::string word = text(object, "method");
    if (word != "mapped" && word != "sampled") throw wrong("method", "is neither sampled nor mapped");
    return word == "mapped" ? AccessMethod::mapped : AccessMethod::sampled;
}

ToolOrientation to_direction(const Json& json) {
    ToolOrientation orientation{vector(json, "out"), real(json, "tilt_deg"), real(json, "gained_share"),
                                real(json, "depth_mm")};
    if (!(std::abs(norm(orientation.tool_axis) - 1) < 1e-6)) throw wrong("out", "is not of length 1");
    return orientation;
}

SurfaceAccess to_access(const Json& json) {
    SurfaceAccess access;
    access.method = to_method(json);
    access.is_arm_checked = truth(json, "arm_checked");
    for (const Json& direction : items(json, "directions")) access.orientations.push_back(to_direction(direction));
    if (const Json& further = member(json, "further"); !further.is_null()) access.further = to_direction(further);
    access.area_mm2 = not_negative(json, "area_mm2");
    access.hidden_mm2 = not_negative(json, "hidden_mm2");
    access.steep_mm2 = not_negative(json, "steep_mm2");
    access.holder_mm2 = not_negative(json, "holder_mm2");
    access.too_narrow_mm2 = not_negative(json, "too_narrow_mm2");
    if (json.contains("ignored_mm2")) access.ignored_mm2 = not_negative(json, "ignored_mm2");
    access.steep_counts = truth(json, "steep_counts");
    access.narrow_counts = truth(json, "narrow_counts");
    access.all_directions_share = not_negative(json, "all_directions_share");
    access.foam_mm3 = not_negative(json, "foam_mm3");
    access.foam_depth_mm = real(json, "foam_depth_mm");
    access.rest_material_mm3 = not_negative(json, "residue_mm3");
    const double stated = not_negative(json, "unreachable_share");
    if (!(std::abs(stated - access.unreachable_share()) <= 1e-9))
        throw wrong("unreachable_share", "is not that of the areas");
    return access;
}

std::vector<Alternative> to_alternatives(const Json& json) {
    std::vector<Alternative> alternatives;
    for (const Json& other : items(json, "alternatives")) {
        alternatives.push_back({base_number(other), text(other, "base_description"), to_method(other),
                                not_negative(other, "unreachable_share"), not_negative(other, "foam_mm3"),
                                not_negative(other, "residue_mm3"), vector(other, "block"),
                                whole<std::uint32_t>(other, "directions")});
    }
    return alternatives;
}

BlockPlacement to_placement(const Json& json) {
    BlockPlacement placement{real(json, "x"), real(json, "y"), real(json, "turn_rad"), {}};
    for (const Json& angle : items(json, "table_angles_rad")) {
        if (!angle.is_number()) throw wrong("table_angles_rad", "is not a list of numbers");
        placement.table_angles.push_back(angle.get<double>());
    }
    return placement;
}

// One per direction of the tool for which the table has an angle of its own, else one.
std::vector<Pose> to_frames(const Json& json, const Setup& setup) {
    std::vector<Pose> frames;
    for (const Json& frame : items(json, "setup_in_cell")) frames.push_back(to_pose(frame, "setup_in_cell"));
    const std::size_t angles = setup.placement.table_angles.size();
    if (angles != 0 && angles != setup.access.orientations.size()) {
        throw wrong("table_angles_rad", "is not one per direction");
    }
    if (frames.size() != std::max<std::size_t>(1, angles)) throw wrong("setup_in_cell", "is not one per angle");
    return frames;
}

// Ascending numbers, or null.
std::vector<std::uint16_t> to_tools(const Json& json) {
    std::vector<std::uint16_t> tools;
    if (json.is_null()) return tools;
    if (!json.is_array() || json.empty()) throw wrong("tools", "is not a list of numbers of tools");
    for (const Json& number : json) {
        const bool is_number = number.is_number_unsigned() && number.get<std::uint64_t>() <= 0xFFFF;
        if (!is_number) throw wrong("tools", "is not a list of numbers of tools");
        tools.push_back(number.get<std::uint16_t>());
        if (tools.size() > 1 && tools[tools.size() - 2] >= tools.back()) throw wrong("tools", "are not in order");
    }
    return tools;
}

Setup to_setup(const Json& json, const Json& stock) {
    Setup setup;
    setup.base_number = base_number(json);
    if (!member(json, "base").is_null()) setup.base = cut_number(json, "base");
    setup.base_description = text(json, "base_description");
    setup.up = vector(json, "up");
    setup.piece_in_setup = to_pose(member(json, "piece_in_setup"), "piece_in_setup");
    setup.box = box(json, "box");
    setup.spoil = not_negative(json, "spoil");
    setup.tools = to_tools(member(json, "tools"));
    setup.placement = to_placement(member(json, "placement"));
    setup.undercut = real(json, "undercut");
    setup.undercut_by_count = real(json, "undercut_by_count");
    setup.base_mm2 = real(json, "base_mm2");
    setup.projected_area_mm2 = real(json, "projected_area_mm2");
    const Json& workholding = member(json, "workholding");
    if (!workholding.is_null()) setup.workholding = to_workholding(workholding);
    setup.access = to_access(member(json, "reach"));
    setup.warnings = texts(json, "warnings");
    setup.block.stock = whole<std::uint16_t>(stock, "number");
    setup.block.size = vector(stock, "size");
    setup.block.is_turned = truth(stock, "turned");
    setup.block.is_sawn = truth(stock, "sawn");
    for (const Json& offcut : items(stock, "offcuts")) setup.block.offcuts.push_back(to_vector(offcut, "offcuts"));
    setup.block.holds = truth(stock, "holds");
    return setup;
}

StockFit to_envelope(const Json& json) {
    StockFit stock_fit;
    for (const Json& margin : items(json, "margins")) {
        stock_fit.margins.push_back({text(margin, "name"), text(margin, "problem"), real(margin, "mm")});
    }
    if (stock_fit.margins.empty()) throw wrong("margins", "is empty");
    if (truth(json, "fits") != stock_fit.fits()) throw wrong("fits", "contradicts the margins");
    return stock_fit;
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
    job.caps = to_caps(member(json, "caps"), job.setup.piece_in_setup);
    job.setup_in_cell = to_frames(member(json, "setup"), job.setup);
    job.alternatives = to_alternatives(json);
    job.max_unreachable = real_within(json, "max_unreachable", 0, 1);
    if (text(json, "state") != state_word(job.setup, job.max_unreachable)) {
        throw wrong("state", "contradicts the unreachable share and its limit");
    }
    job.block_name = text(member(json, "stock"), "name");
    job.stock_fit = to_envelope(member(json, "envelope"));
    const Json& poses = member(json, "work_envelope");
    job.is_arm_checked = truth(poses, "arm_checked");
    job.holds_poses = truth(poses, "holds");
    job.program = to_program(member(json, "programs"));
    const std::string fault = fault_of_holes(job.program, job.caps);
    if (!fault.empty()) throw wrong("holes", fault);
    const std::string of_tools = fault_of_tools(job.program, job.setup.tools);
    if (!of_tools.empty()) throw wrong("tools", of_tools);
    job.no_program_because = text(json, "no_program_because");
    if (job.program.has_value() != job.no_program_because.empty()) {
        throw wrong("no_program_because", "contradicts the programs");
    }
    job.entries = to_entries(json);
    return job;
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

std::string to_manifest(const JobInput& input, const std::vector<JobEntry>& entries) {
    Json files = Json::array();
    for (const JobEntry& entry : entries) {
        files.push_back({{"name", entry.name}, {"size", entry.size}, {"sha256", to_hex(entry.sha256)}});
    }
    std::vector<JobCap> caps;
    for (const DrawnCap& drawn : input.caps) caps.push_back(drawn.cap);
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
        {"caps", from_caps(caps)},
        {"setup", from_setup(input)},
        {"stock", from_stock(input)},
        {"alternatives", from_alternatives(alternatives_of(input))},
        {"max_unreachable", input.max_unreachable},
        {"state", state_word(input.setup, input.max_unreachable)},
        {"envelope", from_envelope(input.stock_fit)},
        {"work_envelope",
         {{"arm_checked", input.machine_reachability.is_arm_checked}, {"holds", input.machine_reachability.holds()}}},
        {"programs", from_program(input.program ? std::optional(input.program->program) : std::nullopt)},
        {"no_program_because", input.program ? std::string() : input.no_program_because},
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
