// One table per object of the JSON. O(chunks).

#include "cam/job/program_document.h"

#include <algorithm>

#include "base/enum_names.h"
#include "base/files/portable_name.h"
#include "base/json_fields.h"
#include "base/json_schema.h"
#include "cam/job/cap_document.h"
#include "cam/job/setup_fields.h"

namespace qchopper {
namespace {

using namespace json_values;

// Orientations count from 1 in the document.
std::uint32_t to_number(std::size_t index) {
    return static_cast<std::uint32_t>(index + 1);
}

std::size_t to_index(std::uint32_t number) {
    if (number < 1) throw wrong("orientation", "counts from 1");
    return number - 1;
}

bool is_listed(const std::vector<std::string>& files, const std::string& name) {
    return std::find(files.begin(), files.end(), name) != files.end();
}

bool are_different(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    return std::adjacent_find(names.begin(), names.end()) == names.end();
}

bool is_program_file(const std::string& name) {
    const std::string ending = name.substr(std::min(name.find_last_of('.'), name.size()));
    return ending == ".src" || ending == ".dat" || ending == ".mod" || ending == ".ngc";
}

}  // namespace

constexpr auto names_of(Dialect) {
    return EnumNames<Dialect, 3>{{{Dialect::krl, "krl"}, {Dialect::rapid, "rapid"}, {Dialect::ngc, "ngc"}}};
}

template <class V, Of<JobChunk> T>
void fields(V& v, T& chunk) {
    v("file", chunk.file);
    v("tool", chunk.tool);
    v.converted("orientation", chunk.orientation, to_number, to_index);
    v("moves", chunk.moves);
    v("length_mm", chunk.length_mm, not_negative);
    v("box", chunk.box);
    v("first", chunk.first);
    v("last", chunk.last);
}

template <class V, Of<JobPart> T>
void fields(V& v, T& part) {
    v("number", part.number);
    v("count", part.count);
    v.check(part.number >= 1 && part.number <= part.count, "number", "is not one of 1 to count");
    v("before_sha256", part.before);
    v.check(part.before.has_value() == (part.number > 1), "before_sha256", "is there for the first part alone");
}

template <class V, Of<JobRestart> T>
void fields(V& v, T& restart) {
    v("of_sha256", restart.of);
    v("chunks_before", restart.chunks_before);
}

template <class V, Of<DrillOrientation> T>
void fields(V& v, T& orientation) {
    v("tool_axis", orientation.tool_axis, is_direction);
    v.converted("table_angle_deg", orientation.table_angle, stated_degrees, radians);
}

template <class V, Of<ToolLeftOut> T>
void fields(V& v, T& tool) {
    v("tool", tool.tool);
    v.converted(
        "orientation", tool.orientation,
        [](const auto& index) { return index ? std::optional(to_number(*index)) : std::nullopt; },
        [](const auto& number) { return number ? std::optional(to_index(*number)) : std::nullopt; });
    v("because", tool.because);
    v.check(!tool.because.empty(), "because", "is empty");
}

template <class V, Of<MovesLeftOut> T>
void fields(V& v, T& moves) {
    v("length_mm", moves.length_mm, not_negative);
    v("because", moves.because);
    v.check((moves.length_mm > 0) != moves.because.empty(), "because", "contradicts the length that is left out");
}

template <class V, Of<JobProgram> T>
void fields(V& v, T& program) {
    v("dialect", program.dialect);
    v("entry", program.entry);
    v("files", program.files);
    v.check(std::all_of(program.files.begin(), program.files.end(), is_portable_name), "files",
            "is not a list of file names");
    v.check(are_different(program.files), "files", "names a file twice");
    v.check(is_listed(program.files, program.entry), "entry", "is none of the files");
    v("part", program.part);
    v.maybe("restart", program.restart);
    v("drilling", program.drilling);
    v("holes", program.holes);
    v.check(is_ascending(program.holes), "holes", "are not in order");
    v("scallop_mm", program.scallop_mm, not_negative);
    v("time_s", program.time_s, not_negative);
    v("left_out", program.left_out);
    v("moves_left_out", program.moves_left_out);
    v("chunks", program.chunks);
    v.check(!program.chunks.empty(), "chunks", "is empty");
    for (const JobChunk& chunk : program.chunks) {
        v.check(is_listed(program.files, chunk.file), "file", "is none of the files");
    }
}

void put(Json& at, const JobProgram& program) {
    put<JobProgram>(at, program);
}

void take(const Json& json, const std::string& key, JobProgram& program) {
    take<JobProgram>(json, key, program);
}

void put_schema(Json& at, const JobProgram& program) {
    put_schema<JobProgram>(at, program);
}

std::string to_json(const JobProgram& program) {
    return to_document(program);
}

JobProgram job_program_from_json(std::string_view text) {
    JobProgram program;
    from_document(text, program);
    return program;
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
    const bool is_whole = !program || (program->part.count == 1 && !program->restart);
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
