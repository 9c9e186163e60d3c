// What the JSON documents of the commands have in common.

#pragma once

#include <optional>
#include <string>

#include "app/store/value_fields.h"
#include "base/json_fields.h"
#include "base/sentence.h"

namespace qchopper {

// A value by its table of fields.
template <class T, class Json = json_values::Json>  // a parameter, because here it is only declared
Json json_of(const T& value) {
    Json json;
    json_values::put(json, value);
    return json;
}

// A list of what to_json makes of each value.
template <class Range, class ToJson>
auto list_of(const Range& values, const ToJson& to_json) {
    auto list = decltype(to_json(*values.begin()))::array();
    for (const auto& value : values) list.push_back(to_json(value));
    return list;
}

// The keys to_do, with this text, and remedy, by which a page words it itself: text, key and values of a sentence that
// has a key, else null.
void add_to_do(nlohmann::ordered_json& document, const Sentence& to_do, const std::optional<std::string>& text);

// What was found on the scan before the first cut: the keys ignored, no_cut and symmetry, where there is something.
void add_scan(nlohmann::ordered_json& document, const Project& project);

}  // namespace qchopper
