// By the tables of fields.

#include "app/report/report_json.h"

namespace qchopper {

void add_scan(nlohmann::ordered_json& document, const Project& project) {
    json_values::JsonWriter writer(document);
    writer.maybe("ignored", project.ignored);
    writer.maybe("no_cut", project.no_cut);
    writer.maybe("symmetry", project.settings.candidates.symmetry);
}

}  // namespace qchopper
