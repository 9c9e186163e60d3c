// By nlohmann::json.

#include "app/report/report_json.h"

#include <nlohmann/json.hpp>

namespace qchopper {

void add_scan(nlohmann::ordered_json& document, const Project& project) {
    json_values::JsonWriter writer(document);
    writer.maybe("ignored", project.ignored);
    writer.maybe("no_cut", project.no_cut);
    writer.maybe("symmetry", project.settings.candidates.symmetry);
}

std::string text_of(const nlohmann::ordered_json& document) {
    return document.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace qchopper
