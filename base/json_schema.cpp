#include "base/json_schema.h"

#include <nlohmann/json.hpp>

namespace qchopper::json_values {
namespace {

// Words of the schema language that stand in several of its rules.
constexpr const char* type_word = "type";
constexpr const char* minimum_word = "minimum";
constexpr const char* constant_word = "const";
constexpr const char* items_word = "items";
constexpr const char* required_word = "required";
constexpr const char* properties_word = "properties";

constexpr const char* text_kind = "string";
constexpr const char* number_kind = "number";
constexpr const char* list_kind = "array";

void put_kind(Json& at, const char* kind) {
    at[type_word] = kind;
}

void put_digits(Json& at, std::size_t bytes) {
    put_kind(at, text_kind);
    at["pattern"] = "^[0-9a-f]{" + std::to_string(2 * bytes) + "}$";
}

}  // namespace

void put_schema(Json& at, bool /*like*/) {
    put_kind(at, "boolean");
}

void put_schema(Json& at, double /*like*/) {
    put_kind(at, number_kind);
}

void put_schema(Json& at, const char* /*like*/) {
    put_kind(at, text_kind);
}

void put_schema(Json& at, const std::string& /*like*/) {
    put_kind(at, text_kind);
}

void put_schema(Json& at, const std::filesystem::path& /*like*/) {
    put_kind(at, text_kind);
}

void put_schema(Json& at, Vec3 /*like*/) {
    put_schema(list_schema(at, 3), 0.0);
}

void put_schema(Json& at, const Pose& like) {
    begin_object_schema(at);
    put_schema(added_property(at, "rows", true), like.row);
    put_schema(added_property(at, "shift", true), like.shift);
}

void put_schema(Json& at, const Sha256& like) {
    put_digits(at, like.bytes.size());
}

void put_schema(Json& at, const Uuid& like) {
    put_digits(at, like.size());
}

void put_whole_schema(Json& at, std::int64_t least, std::uint64_t most) {
    put_kind(at, "integer");
    at[minimum_word] = least;
    at["maximum"] = most;
}

void put_constant_schema(Json& at, const std::string& value) {
    at[constant_word] = value;
}

void put_constant_schema(Json& at, std::uint64_t value) {
    at[constant_word] = value;
}

void begin_object_schema(Json& at) {
    put_kind(at, "object");
    at[properties_word] = Json::object();
    at[required_word] = Json::array();
    at["additionalProperties"] = false;
}

Json& added_property(Json& object, const char* key, bool is_required) {
    if (is_required) object[required_word].push_back(key);
    return object[properties_word][key];
}

Json& list_schema(Json& at) {
    put_kind(at, list_kind);
    return at[items_word];
}

Json& list_schema(Json& at, std::size_t size) {
    put_kind(at, list_kind);
    at["minItems"] = size;
    at["maxItems"] = size;
    return at[items_word];
}

Json& added_choice(Json& at) {
    return at["anyOf"].emplace_back();
}

void add_null(Json& at) {
    put_kind(added_choice(at), "null");
}

void add_word(Json& at, const char* word) {
    at["enum"].push_back(word);
}

void set_not_negative(Json& at) {
    at[minimum_word] = 0;
}

}  // namespace qchopper::json_values
