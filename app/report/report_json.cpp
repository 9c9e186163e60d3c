// By the tables of fields.

#include "app/report/report_json.h"

namespace qchopper {

template <class V, Of<Sentence> T>
void fields(V& v, T& sentence) {
    v("text", sentence.text);
    v("key", sentence.key);
    v("values", sentence.values);
}

void add_to_do(nlohmann::ordered_json& document, const Sentence& to_do, const std::optional<std::string>& text) {
    json_values::JsonWriter writer(document);
    writer("to_do", text);
    writer("remedy", to_do.key.empty() ? std::nullopt : std::optional(to_do));
}

void add_scan(nlohmann::ordered_json& document, const Project& project) {
    json_values::JsonWriter writer(document);
    writer.maybe("ignored", project.ignored);
    writer.maybe("no_cut", project.no_cut);
    writer.maybe("symmetry", project.settings.candidates.symmetry);
}

}  // namespace qchopper
