// The tables of spindle, extraction and programs, and the signals between programs and machine. O(tools).

#include <algorithm>
#include <array>
#include <utility>

#include "cam/cell/cell_tables.h"

namespace qchopper {
namespace {

constexpr std::size_t longest_name = 24;  // of a KRL program
constexpr std::uint32_t max_signals = 8'192;

constexpr std::array<std::pair<const char*, SignalKind>, 3> signal_kinds{
    {{"output", SignalKind::output}, {"input", SignalKind::input}, {"call", SignalKind::call}}};

constexpr std::array<const char*, 3> dialects{"krl", "rapid", "ngc"};       // in the order of Dialect
constexpr std::array<std::uint32_t, 3> default_lines{1'400, 5'000, 5'000};  // per chunk, in the order of Dialect

bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

// A name that every dialect takes: a letter, then letters, digits and _.
bool is_identifier(const std::string& name) {
    return name.size() <= longest_name && !name.empty() && is_letter(name.front()) &&
           std::all_of(name.begin(), name.end(),
                       [](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

std::string read_identifier(const TomlReader& reader, std::string_view key) {
    std::string name = reader.text(key);
    if (!is_identifier(name)) {
        reader.refuse(key, name + " is not a name: a letter, then letters, digits and _, at most 24 characters");
    }
    return name;
}

// RAPID has names for its signals, the others numbers; a program called has a name everywhere.
std::string read_target(const TomlReader& reader, std::string_view key, SignalKind kind, Dialect dialect) {
    if (kind == SignalKind::call || dialect == Dialect::rapid) return read_identifier(reader, key);
    const std::uint32_t first = dialect == Dialect::krl ? 1 : 0;
    return std::to_string(reader.whole(key, first, max_signals));
}

std::optional<Signal> read_signal(const TomlReader& parent, const char* key, const TableKeys& table, Dialect dialect) {
    if (!parent.has(key)) return std::nullopt;
    const TomlReader reader = parent.table(key, table);
    std::optional<Signal> signal;
    for (const auto& [word, kind] : signal_kinds) {
        if (!reader.has(word)) continue;
        if (signal) reader.refuse(word, "a signal is one of output, input and call");
        signal = Signal{kind, read_target(reader, word, kind, dialect), 1};
    }
    if (!signal) {
        parent.refuse(key, "does not say which signal it is",
                      "add " + std::string(Keys(table)[0]) + " or " + std::string(Keys(table)[1]));
    }
    if (reader.has("scale")) signal->scale = reader.number("scale", 1e-9, 1e9);
    return signal;
}

void read_body(const TomlReader& reader, Spindle& spindle) {
    spindle.body_radius = reader.number("body_radius", smallest, farthest_2);
    spindle.body_length = reader.number("body_length", smallest, farthest_2);
    spindle.body_offset = reader.number("body_offset", 0, farthest_2);
    spindle.mass_kg = reader.number("mass_kg", smallest, 10'000);
}

ToolAxis read_tool_axis(const TomlReader& reader) {
    const std::string axis = reader.text("tool_axis");
    if (axis != "z" && axis != "x") reader.refuse("tool_axis", "must be \"z\" or \"x\"");
    return axis == "x" ? ToolAxis::x : ToolAxis::z;
}

void check_payload(const TomlReader& reader, double spindle_kg, const Robot& robot,
                   const std::vector<CuttingTool>& tools) {
    double heaviest = 0;
    for (const CuttingTool& tool : tools) heaviest = std::max(heaviest, tool.mass_kg);
    if (spindle_kg + heaviest > robot.payload_kg) {
        reader.refuse("mass_kg", "with the heaviest tool it is more than robot.payload_kg");
    }
}

Dialect read_dialect(const TomlReader& reader, bool has_robot) {
    const std::string word = reader.text("dialect");
    const auto* found = std::find(dialects.begin(), dialects.end(), word);
    if (found == dialects.end()) reader.refuse("dialect", "unknown dialect " + word, "use krl, rapid or ngc");
    const auto dialect = static_cast<Dialect>(found - dialects.begin());
    if (has_robot == (dialect == Dialect::ngc)) {
        reader.refuse("dialect", has_robot ? "a robot is programmed in krl or rapid" : "a gantry is programmed in ngc");
    }
    return dialect;
}

std::optional<std::string> read_tool_change(const TomlReader& reader) {
    const std::string text = reader.text("tool_change");
    if (text == "stop") return std::nullopt;
    const std::string call = "call ";
    const std::string name = text.starts_with(call) ? text.substr(call.size()) : "";
    if (!is_identifier(name)) {
        reader.refuse("tool_change", "must be \"stop\" or \"call NAME\"",
                      "NAME is a letter, then letters, digits and _, at most 24 characters");
    }
    return name;
}

void read_motion(const TomlReader& reader, ProgramSettings& program) {
    reader.number_if_given("acceleration", 10, 20'000, program.acceleration);
    if (reader.has("turn_speed_deg_per_s")) {
        program.turn_speed = reader.number("turn_speed_deg_per_s", 1, 3'600) * degree;
    }
    if (reader.has("joint_move_percent")) program.joint_share = 0.01 * reader.whole("joint_move_percent", 1, 100);
    reader.number_if_given("scallop", 0.01, 2, program.scallop);
}

}  // namespace

const char* to_word(Dialect dialect) {
    return dialects[static_cast<std::size_t>(dialect)];
}

Spindle read_spindle(const TomlReader& root, const std::optional<Robot>& robot, const std::vector<CuttingTool>& tools,
                     Dialect dialect, Origins& origins) {
    const TomlReader reader = root.table("spindle", keys_2::spindle);
    Spindle spindle;
    spindle.tool_axis = read_tool_axis(reader);
    read_body(reader, spindle);
    if (robot) {
        spindle.spindle_in_flange = read_pose(reader);
        check_payload(reader, spindle.mass_kg, *robot, tools);
    } else {
        for (const char* key : {"position", "abc_deg"}) {
            if (reader.has(key)) reader.refuse(key, "a gantry has no flange", "leave it out");
        }
        if (spindle.tool_axis != ToolAxis::z) reader.refuse("tool_axis", "must be \"z\" in a gantry");
    }
    spindle.on = read_signal(reader, "on", keys_2::spindle_on, dialect);
    spindle.speed = read_signal(reader, "speed", keys_2::spindle_speed, dialect);
    spindle.at_speed = read_signal(reader, "at_speed", keys_2::spindle_at_speed, dialect);
    spindle.off = read_signal(reader, "off", keys_2::spindle_off, dialect);
    add_origins(reader, keys_2::spindle, "spindle", origins);
    return spindle;
}

std::optional<Extraction> read_extraction(const TomlReader& root, Dialect dialect) {
    if (!root.has("extraction")) return std::nullopt;
    const TomlReader reader = root.table("extraction", keys_2::extraction);
    Extraction extraction{read_signal(reader, "on", keys_2::extraction_on, dialect),
                          read_signal(reader, "off", keys_2::extraction_off, dialect),
                          read_signal(reader, "running", keys_2::extraction_running, dialect)};
    if (extraction.running && !extraction.on) {
        reader.refuse("running", "nothing switches the extraction on, which would be waited for", "name extraction.on");
    }
    if (extraction.running && dialect != Dialect::krl) {
        reader.refuse("running", "only programs in KRL wait for the extraction", "leave it out");
    }
    return extraction;
}

ProgramSettings read_program(const TomlReader& root, bool has_robot, Origins& origins) {
    const TomlReader reader = root.table("program", keys_2::program);
    ProgramSettings program;
    program.dialect = read_dialect(reader, has_robot);
    program.lines_per_chunk = default_lines[static_cast<std::size_t>(program.dialect)];
    if (reader.has("memory_bytes")) program.memory_bytes = reader.whole("memory_bytes", 10'000, 2'000'000'000);
    if (reader.has("lines_per_chunk")) program.lines_per_chunk = reader.whole("lines_per_chunk", 10, 10'000'000);
    program.link_feed_mm_per_s = reader.number("link_feed", 1, 5'000);
    program.tool_change_call = read_tool_change(reader);
    reader.number_if_given("interpolation_cycle", 0.001, 1, program.interpolation_cycle_s);
    reader.number_if_given("tool_change_time", 0, 3'600, program.tool_change_s);
    read_motion(reader, program);
    add_origins(reader, keys_2::program, "program", origins);
    add_defaults(reader, keys_2::program.with_origin(), "program", origins);
    return program;
}

LoadTolerance read_load_tolerance(const TomlReader& root) {
    LoadTolerance tolerance;
    const TomlReader reader = root.table_if_given("load_tolerance", keys_2::load_tolerance);
    reader.number_if_given("mass_kg", 0, 100, tolerance.mass_kg);
    reader.number_if_given("centre_mm", 0, 1'000, tolerance.centre_mm);
    reader.number_if_given("inertia_kg_m2", 0, 100, tolerance.inertia_kg_m2);
    return tolerance;
}

}  // namespace qchopper
