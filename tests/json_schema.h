// Holds documents and pages against a JSON schema, as far as base/json_schema.h makes use of the language.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace qchopper {

using SchemaJson = nlohmann::json;

inline bool is_of_kind(const SchemaJson& value, const std::string& kind) {
    if (kind == "object") return value.is_object();
    if (kind == "array") return value.is_array();
    if (kind == "string") return value.is_string();
    if (kind == "boolean") return value.is_boolean();
    if (kind == "number") return value.is_number();
    if (kind == "integer") return value.is_number_integer();
    return kind == "null" && value.is_null();
}

// "PATH why", one per value that the schema refuses. Throws std::runtime_error for a word of the language that it does
// not know, so that no rule is passed over in silence.
inline std::vector<std::string> schema_faults(const SchemaJson& schema, const SchemaJson& value,
                                              const std::string& path = "") {
    std::vector<std::string> faults;
    const auto refuse = [&](const std::string& why) { faults.push_back(path + " " + why); };
    const auto descend = [&](const SchemaJson& inner, const SchemaJson& part, const std::string& name) {
        for (const std::string& fault : schema_faults(inner, part, path + "/" + name)) faults.push_back(fault);
    };
    for (const auto& [word, rule] : schema.items()) {
        if (word == "$schema" || word == "title") continue;
        if (word == "type") {
            if (!is_of_kind(value, rule.get<std::string>())) return {path + " is no " + rule.get<std::string>()};
        } else if (word == "const") {
            if (value != rule) refuse("is not " + rule.dump());
        } else if (word == "enum") {
            if (std::find(rule.begin(), rule.end(), value) == rule.end()) refuse("is none of " + rule.dump());
        } else if (word == "pattern") {
            if (value.is_string() && !std::regex_match(value.get<std::string>(), std::regex(rule.get<std::string>())))
                refuse("no match");
        } else if (word == "minimum") {
            if (value.is_number() && value < rule) refuse("is below " + rule.dump());
        } else if (word == "maximum") {
            if (value.is_number() && value > rule) refuse("is above " + rule.dump());
        } else if (word == "minItems") {
            if (value.is_array() && value.size() < rule.get<std::size_t>()) refuse("is too short");
        } else if (word == "maxItems") {
            if (value.is_array() && value.size() > rule.get<std::size_t>()) refuse("is too long");
        } else if (word == "items") {
            for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
                descend(rule, value[i], std::to_string(i));
            }
        } else if (word == "anyOf") {
            const bool is_any = std::any_of(rule.begin(), rule.end(),
                                            [&](const auto& one) { return schema_faults(one, value).empty(); });
            if (!is_any) refuse("is of no kind that it may be");
        } else if (word == "properties") {
            for (const auto& [key, inner] : rule.items()) {
                if (value.is_object() && value.contains(key)) descend(inner, value[key], key);
            }
        } else if (word == "required") {
            for (const auto& key : rule) {
                if (value.is_object() && !value.contains(key)) refuse(key.get<std::string>() + " is missing");
            }
        } else if (word == "additionalProperties" && rule == false) {
            for (const auto& [key, part] : value.items()) {
                if (!schema.at("properties").contains(key)) refuse(key + " is unknown");
            }
        } else {
            throw std::runtime_error("not known: " + word);
        }
    }
    return faults;
}

// The keys of all objects of a schema; of those that may be missing alone, if these are asked for.
inline std::set<std::string> keys_of_schema(const SchemaJson& schema, bool only_optional = false) {
    std::set<std::string> keys;
    const auto properties = schema.find("properties");
    for (const auto& inner : schema) {
        if (!inner.is_structured() || (properties != schema.end() && &inner == &*properties)) continue;
        keys.merge(keys_of_schema(inner, only_optional));
    }
    if (!schema.is_object() || properties == schema.end()) return keys;
    const SchemaJson& required = schema.at("required");
    for (const auto& [key, inner] : properties->items()) {
        const bool is_required = std::find(required.begin(), required.end(), key) != required.end();
        if (!(only_optional && is_required)) keys.insert(key);
        keys.merge(keys_of_schema(inner, only_optional));
    }
    return keys;
}

// The first grammar of a page of docs/developer/formats that holds `begin`, from there on, has the keys of the schemas
// and no other words in lower case but these. Comments and texts are passed over.
inline void expect_keys_of_page(const std::string& page, const std::string& begin,
                                const std::vector<std::string>& schemas, const std::set<std::string>& other_words) {
    std::ifstream stream(QCHOPPER_SOURCE_DIR "/docs/developer/formats/" + page);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::size_t from = text.find("\n" + begin);
    ASSERT_NE(from, std::string::npos) << page;
    std::istringstream lines(text.substr(from, text.find("\n```", from) - from));
    std::set<std::string> words;
    for (std::string line; std::getline(lines, line);) {
        const std::string grammar = std::regex_replace(line.substr(0, line.find(';')), std::regex("\"[^\"]*\""), "");
        const std::regex word("\\w+");
        for (std::sregex_iterator at(grammar.begin(), grammar.end(), word), end; at != end; ++at) {
            if (std::islower(static_cast<unsigned char>(at->str()[0])) != 0) words.insert(at->str());
        }
    }
    std::set<std::string> keys;
    for (const std::string& schema : schemas) keys.merge(keys_of_schema(SchemaJson::parse(schema)));
    for (const std::string& key : words) {
        EXPECT_TRUE(other_words.contains(key) || keys.contains(key)) << key << " is in no table";
    }
    for (const std::string& key : keys) EXPECT_TRUE(words.contains(key)) << key << " is not on the page";
}

}  // namespace qchopper
