// Text and JSON from values.

#include "app/report/notices.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "app/report/command_line_text.h"
#include "app/report/joint_report.h"
#include "app/report/report_json.h"
#include "base/text.h"
#include "segment/import/inspect.h"
#include "segment/mesh/measure.h"
#include "sim/cell/faults.h"

namespace qchopper {

template <class V, Of<ProgressState> T>
void fields(V& v, T& state) {
    v("progress", state.progress);
    v("done", state.done);
    v("total", state.total);
    v("elapsed_s", state.elapsed_s);
    v("left_s", state.left_s);
}

template <class V, Of<WrittenGuide> T>
void fields(V& v, T& guide) {
    v.constant("schema", "qchopper-guide-1", nullptr);
    v.written("pieces", [&] { return guide.joints.pieces.size(); });
    v.written("joints", [&] { return guide.joints.joints.size(); });
    v.written("steps", [&] { return guide.joints.assembly.steps.size(); });
    v("files", guide.files);
    v("held", guide.held);
}

Document error_document(const std::string& error, const std::string& unchanged, const Sentence& to_do, int exit_code) {
    nlohmann::ordered_json json{{"schema", "qchopper-error-1"}, {"error", error}, {"unchanged", unchanged}};
    add_to_do(json, to_do, command_line_text(to_do));
    json["exit_code"] = exit_code;
    return compose(std::move(json));
}

Document document(const ProgressState& state) {
    return compose_line(json_of(state));
}

namespace {
constexpr std::array notice_keys{"message", "warning", "error"};  // in the order of NoticeKind
}  // namespace

Document notice_document(NoticeKind kind, const std::string& line) {
    return compose_line({{notice_keys[static_cast<std::size_t>(kind)], line}});
}

std::optional<ProgressState> read_progress(const std::string& line) {
    try {
        ProgressState state;
        json_values::from_document(line, state, false);
        return state;
    } catch (const std::runtime_error&) {
        return {};
    }
}

std::optional<std::string> read_notice(const std::string& line) {
    const auto json = nlohmann::ordered_json::parse(line, nullptr, false);
    if (!json.is_object() || json.size() != 1 || !json.begin()->is_string()) return {};
    return json.begin()->get<std::string>();
}

std::vector<std::string> lines(const WrittenSample& sample) {
    std::vector<std::string> text{sample.file + ": " + sample.specimen + ", " +
                                  with_commas(sample.mesh.triangles.size()) + " faces, " +
                                  describe_size(bounds(sample.mesh).size()) + ", in mm"};
    if (!sample.pen_grooves.lines.empty()) {
        text.push_back(std::to_string(sample.pen_grooves.lines.size()) + " pen grooves, " +
                       fixed(sample.pen_grooves.width, 1) + " mm wide and " + fixed(sample.pen_grooves.depth, 2) +
                       " mm deep");
    }
    return text;
}

Document document(const WrittenSample& sample) {
    return compose({{"schema", "qchopper-sample-1"},
                    {"specimen", sample.specimen},
                    {"file", sample.file},
                    {"faces", sample.mesh.triangles.size()},
                    {"vertices", sample.mesh.points.size()},
                    {"holes", sample.holes},
                    {"pen_grooves", sample.pen_grooves.lines.size()},
                    {"groove_width_mm", sample.pen_grooves.width},
                    {"groove_depth_mm", sample.pen_grooves.depth},
                    {"units", "mm"},
                    {"size", describe_size(bounds(sample.mesh).size())}});
}

Document document(const WrittenGuide& guide) {
    nlohmann::ordered_json json = json_of(guide);
    json[assembly_key] = assembly_json(guide.joints);
    return compose(std::move(json));
}

namespace {

// A text of a document as it is printed; empty where there is none.
std::string text_in(const std::string& document, const char* key) {
    const auto json = nlohmann::ordered_json::parse(document, nullptr, false);
    return json.is_object() ? json.value(key, std::string()) : std::string();
}

constexpr const char* address_key = "listening";
constexpr const char* mesh_key = "mesh";

}  // namespace

Document listening_document(const std::string& address) {
    return compose_line({{"schema", "qchopper-cell-sim-1"}, {address_key, address}});
}

std::string listening_address(const std::string& document) {
    return text_in(document, address_key);
}

Document mesh_document(const std::string& id, double deviation) {
    return compose_line({{mesh_key, id}, {"deviation", deviation}});
}

Document painted_document(std::size_t points) {
    return compose_line({{"points_asked", points}});
}

std::string read_mesh_id(const std::string& document) {
    return text_in(document, mesh_key);
}

std::vector<std::string> fault_lines() {
    std::vector<std::string> lines;
    for (const NamedFault& row : all_faults()) {
        std::string line = row.name;
        line.resize(std::max<std::size_t>(22, line.size()), ' ');
        line.append(row.meaning);
        if ((row.argument[0] != '\0'))
            line += " (number: " + std::string(row.argument) + ", " + std::to_string(row.usual) + ")";
        lines.push_back(std::move(line));
    }
    return lines;
}

Document fault_document() {
    nlohmann::ordered_json faults = nlohmann::ordered_json::array();
    for (const NamedFault& row : all_faults()) {
        nlohmann::ordered_json one{{"name", row.name}, {"meaning", row.meaning}};
        if (row.argument[0] != '\0') {
            one["number"] = row.argument;
            one["usual"] = row.usual;
        }
        faults.push_back(std::move(one));
    }
    return compose_line({{"schema", "qchopper-faults-1"}, {"faults", std::move(faults)}});
}

}  // namespace qchopper
