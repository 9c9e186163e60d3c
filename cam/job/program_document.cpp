// One function per object of the JSON, first to write and then to read it. O(chunks).

#include "cam/job/program_document.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/files/portable_name.h"
#include "base/json.h"
#include "cam/job/cap_document.h"

namespace qchopper {
namespace {

using namespace json_values;

constexpr double most = std::numeric_limits<double>::max();

Json from_chunk(const JobChunk& chunk) {
    return {{"file", chunk.file},
            {"tool", chunk.tool},
            {"direction", chunk.orientation + 1},
            {"moves", chunk.moves},
            {"length_mm", chunk.length_mm},
            {"box", from_box(chunk.box)},
            {"first", from_vector(chunk.first)},
            {"last", from_vector(chunk.last)}};
}

Json from_part(const JobPart& part) {
    return {{"number", part.number},
            {"count", part.count},
            {"before_sha256", part.before ? Json(to_hex(*part.before)) : Json(nullptr)}};
}

JobChunk to_chunk(const Json& json) {
    JobChunk chunk;
    chunk.file = text(json, "file");
    chunk.tool = whole<std::uint16_t>(json, "tool");
    const auto direction = whole<std::uint32_t>(json, "direction");
    if (direction < 1) throw wrong("direction", "counts from 1");
    chunk.orientation = direction - 1;
    chunk.moves = whole<std::uint64_t>(json, "moves");
    chunk.length_mm = real_within(json, "length_mm", 0, most);
    chunk.box = box(json, "box");
    chunk.first = vector(json, "first");
    chunk.last = vector(json, "last");
    return chunk;
}

Json from_left_out(const std::vector<ToolLeftOut>& left_out) {
    Json list = Json::array();
    for (const ToolLeftOut& tool : left_out) {
        list.push_back({{"tool", tool.tool ? Json(*tool.tool) : Json(nullptr)},
                        {"direction", tool.orientation ? Json(*tool.orientation + 1) : Json(nullptr)},
                        {"because", tool.because}});
    }
    return list;
}

std::vector<ToolLeftOut> to_left_out(const Json& list) {
    std::vector<ToolLeftOut> left_out;
    for (const Json& json : list) {
        ToolLeftOut tool;
        if (!member(json, "tool").is_null()) tool.tool = whole<std::uint16_t>(json, "tool");
        if (!member(json, "direction").is_null()) {
            const auto direction = whole<std::uint32_t>(json, "direction");
            if (direction < 1) throw wrong("direction", "counts from 1");
            tool.orientation = direction - 1;
        }
        tool.because = text(json, "because");
        if (tool.because.empty()) throw wrong("because", "is empty");
        left_out.push_back(std::move(tool));
    }
    return left_out;
}

MovesLeftOut to_moves_left_out(const Json& json) {
    MovesLeftOut moves{real_within(json, "length_mm", 0, most), text(json, "because")};
    if ((moves.length_mm > 0) == moves.because.empty())
        throw wrong("because", "contradicts the length that is left out");
    return moves;
}

JobPart to_part(const Json& json) {
    JobPart part;
    part.number = whole<std::uint16_t>(json, "number");
    part.count = whole<std::uint16_t>(json, "count");
    if (part.number < 1 || part.number > part.count) throw wrong("number", "is not one of 1 to count");
    if (!member(json, "before_sha256").is_null()) part.before = Sha256{from_hex<32>(json, "before_sha256")};
    if (part.before.has_value() != (part.number > 1)) throw wrong("before_sha256", "is there for the first part alone");
    return part;
}

Dialect to_dialect(const std::string& word) {
    for (const Dialect dialect : {Dialect::krl, Dialect::rapid, Dialect::ngc}) {
        if (word == to_word(dialect)) return dialect;
    }
    throw wrong("dialect", "is none of krl, rapid, ngc");
}

bool is_listed(const std::vector<std::string>& files, const std::string& name) {
    return std::find(files.begin(), files.end(), name) != files.end();
}

void read_drilling(const Json& json, JobProgram& program) {
    for (const Json& direction : items(json, "drilling")) {
        program.drilling.push_back({vector(direction, "out"), real(direction, "table_angle_rad")});
        if (!(std::abs(norm(program.drilling.back().tool_axis) - 1) < 1e-6)) throw wrong("out", "is not of length 1");
    }
    for (const Json& hole : items(json, "holes")) {
        if (!hole.is_number_unsigned()) throw wrong("holes", "is not a list of numbers of holes");
        program.holes.push_back(hole.get<std::size_t>());
        const std::size_t count = program.holes.size();
        if (count > 1 && program.holes[count - 2] >= program.holes[count - 1]) throw wrong("holes", "are not in order");
    }
}

JobProgram to_single(const Json& json) {
    JobProgram program;
    program.dialect = to_dialect(text(json, "dialect"));
    program.entry = text(json, "entry");
    for (const Json& file : items(json, "files")) {
        if (!file.is_string() || !is_portable_name(file.get<std::string>())) {
            throw wrong("files", "is not a list of file names");
        }
        if (is_listed(program.files, file.get<std::string>())) throw wrong("files", "names a file twice");
        program.files.push_back(file.get<std::string>());
    }
    if (!is_listed(program.files, program.entry)) throw wrong("entry", "is none of the files");
    for (const Json& chunk : items(json, "chunks")) {
        program.chunks.push_back(to_chunk(chunk));
        if (!is_listed(program.files, program.chunks.back().file)) throw wrong("file", "is none of the files");
    }
    if (program.chunks.empty()) throw wrong("chunks", "is empty");
    program.part = to_part(member(json, "part"));
    read_drilling(json, program);
    program.scallop_mm = real_within(json, "scallop_mm", 0, most);
    program.time_s = real_within(json, "time_s", 0, most);
    program.left_out = to_left_out(items(json, "left_out"));
    program.moves_left_out = to_moves_left_out(member(json, "moves_left_out"));
    return program;
}

bool is_program_file(const std::string& name) {
    const std::string ending = name.substr(std::min(name.find_last_of('.'), name.size()));
    return ending == ".src" || ending == ".dat" || ending == ".mod" || ending == ".ngc";
}

}  // namespace

Json from_program(const std::optional<JobProgram>& program) {
    if (!program) return Json::array();
    Json chunks = Json::array();
    for (const JobChunk& chunk : program->chunks) chunks.push_back(from_chunk(chunk));
    Json drilling = Json::array();
    for (const DrillOrientation& orientation : program->drilling) {
        drilling.push_back({{"out", from_vector(orientation.tool_axis)}, {"table_angle_rad", orientation.table_angle}});
    }
    return Json::array(
        {Json{{"dialect", to_word(program->dialect)},
              {"entry", program->entry},
              {"files", program->files},
              {"part", from_part(program->part)},
              {"drilling", drilling},
              {"holes", program->holes},
              {"scallop_mm", program->scallop_mm},
              {"time_s", program->time_s},
              {"left_out", from_left_out(program->left_out)},
              {"moves_left_out",
               {{"length_mm", program->moves_left_out.length_mm}, {"because", program->moves_left_out.because}}},
              {"chunks", chunks}}});
}

std::optional<JobProgram> to_program(const Json& json) {
    if (!json.is_array() || json.size() > 1) throw wrong("programs", "is not a list of at most one program");
    if (json.empty()) return std::nullopt;
    return to_single(json.front());
}

std::string fault_of_holes(const std::optional<JobProgram>& program, const std::vector<JobCap>& caps) {
    const std::vector<std::size_t> drilled = program ? program->holes : std::vector<std::size_t>{};
    std::vector<std::size_t> by_robot;
    for (const JobHole& hole : holes_of(caps)) {
        if (hole.by_robot) by_robot.push_back(hole.number);
    }
    for (const std::size_t number : drilled) {
        if (std::find(by_robot.begin(), by_robot.end(), number) == by_robot.end()) {
            return "the program drills hole " + std::to_string(number) + ", which is not the robot's";
        }
    }
    const bool is_whole = !program || program->part.count == 1;
    return is_whole && drilled != by_robot ? "holes of the robot are drilled by no program" : "";
}

std::string fault_of_tools(const std::optional<JobProgram>& program, const std::vector<std::uint16_t>& allowed) {
    if (!program || allowed.empty()) return {};
    for (const JobChunk& chunk : program->chunks) {
        if (std::find(allowed.begin(), allowed.end(), chunk.tool) == allowed.end()) {
            return "tool " + std::to_string(chunk.tool) + " of " + chunk.file + " is none of those that are allowed";
        }
    }
    return {};
}

std::string fault_of_program_files(const std::optional<JobProgram>& program,
                                   const std::map<std::string, Bytes>& files) {
    const std::vector<std::string> named = program ? program->files : std::vector<std::string>{};
    for (const std::string& name : named) {
        if (!files.contains(name)) return name + ", a file of the program, is missing";
    }
    for (const auto& [name, bytes] : files) {
        if (is_program_file(name) && !is_listed(named, name)) return name + " belongs to no program of the manifest";
    }
    return {};
}

}  // namespace qchopper
