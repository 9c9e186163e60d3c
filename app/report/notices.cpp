#include "app/report/notices.h"

#include <nlohmann/json.hpp>

#include "app/project/value_json.h"
#include "base/text.h"
#include "segment/import/inspect.h"
#include "segment/mesh/measure.h"

namespace qchopper {

std::string error_document(const std::string& error, const std::string& unchanged, const std::string& to_do,
                           int exit_code) {
    return text_of({{"schema", "qchopper-error-1"},
                    {"error", error},
                    {"unchanged", unchanged},
                    {"to_do", to_do},
                    {"exit_code", exit_code}});
}

std::vector<std::string> lines(const WrittenSample& sample) {
    std::vector<std::string> text{sample.file + ": " + sample.specimen + ", " +
                                  with_commas(sample.mesh.triangles.size()) + " faces, " +
                                  size_in_words(bounds(sample.mesh).size()) + ", in mm"};
    if (!sample.marks.lines.empty()) {
        text.push_back(std::to_string(sample.marks.lines.size()) + " marks, " + fixed(sample.marks.width, 1) +
                       " mm wide and " + fixed(sample.marks.depth, 2) + " mm deep");
    }
    return text;
}

std::string document(const WrittenSample& sample) {
    return text_of({{"schema", "qchopper-sample-1"},
                    {"specimen", sample.specimen},
                    {"file", sample.file},
                    {"faces", sample.mesh.triangles.size()},
                    {"vertices", sample.mesh.points.size()},
                    {"holes", sample.holes},
                    {"marks", sample.marks.lines.size()},
                    {"mark_width_mm", sample.marks.width},
                    {"mark_depth_mm", sample.marks.depth},
                    {"units", "mm"},
                    {"size", size_in_words(bounds(sample.mesh).size())}});
}

std::string listening_document(const std::string& address) {
    return nlohmann::ordered_json{{"schema", "qchopper-cell-sim-1"}, {"listening", address}}.dump();
}

}  // namespace qchopper
