// A document that is text already, as a value of a table of fields (base/json_fields.h).

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace qchopper {

struct JsonText {
    std::string text;  // empty: null
    bool operator==(const JsonText&) const = default;
};

void put(nlohmann::ordered_json& at, const JsonText& document);
void take(const nlohmann::ordered_json& json, const std::string& key, JsonText& document);

// Without line ends behind it.
std::string one_line(std::string document);

bool is_json(const std::string& text);

}  // namespace qchopper
