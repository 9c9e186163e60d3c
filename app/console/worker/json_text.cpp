// By nlohmann::json. O(document).

#include "app/console/worker/json_text.h"

#include <nlohmann/json.hpp>

namespace qchopper {

using Json = nlohmann::ordered_json;

void put(Json& at, const JsonText& document) {
    if (!document.text.empty()) at = Json::parse(document.text, nullptr, false);
}

void take(const Json& json, const std::string& /*key*/, JsonText& document) {
    document.text = json.is_null() ? std::string() : json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string one_line(std::string document) {
    while (!document.empty() && document.back() == '\n') document.pop_back();
    return document;
}

bool is_json(const std::string& text) {
    return Json::accept(text);
}

}  // namespace qchopper
