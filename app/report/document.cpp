// By nlohmann::json. O(document).

#include "app/report/document.h"

#include <nlohmann/json.hpp>

namespace qchopper {

Document compose(nlohmann::ordered_json json) {
    return {std::make_shared<const nlohmann::ordered_json>(std::move(json))};
}

Document compose_line(nlohmann::ordered_json json) {
    Document document = compose(std::move(json));
    document.is_one_line = true;
    return document;
}

std::string text_of(const Document& document) {
    const int indent = document.is_one_line ? -1 : 1;
    return document.json->dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace qchopper
