// Text and JSON from values.

#include "app/report/notices.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

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
    v("pieces", guide.pieces);
    v("joints", guide.joints);
    v("steps", guide.steps);
    v("files", guide.files);
    v("held", guide.held);
}

Document error_document(const std::string& error, const std::string& unchanged, const std::string& to_do,
                        int exit_code) {
    return compose({{"schema", "qchopper-error-1"},
                    {"error", error},
                    {"unchanged", unchanged},
                    {"to_do", to_do},
                    {"exit_code", exit_code}});
}

Document document(const ProgressState& state) {
    return compose_line(json_of(state));
}

Document notice_document(NoticeKind kind, const std::string& line) {
    constexpr std::array names{"message", "warning", "error"};
    return compose_line({{names[static_cast<std::size_t>(kind)], line}});
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
    return compose(json_of(guide));
}

Document listening_document(const std::string& address) {
    return compose_line({{"schema", "qchopper-cell-sim-1"}, {"listening", address}});
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
