// Makes the JSON schema (draft 2020-12) of a document from the tables by which it is written and read (json_fields.h).
//
// It says which keys an object has, which of them may be missing, and of which kind and in which range each value is.
// What ties values to each other (check, derived, rules but not_negative) stays with the reader. What JsonWriter writes
// is valid by it (tests/cam/job/document_schema_test.cpp). Tables are visited with default values: what they compute is
// asked for its type alone. A struct whose table stands in another source has a function put_schema(Json&, const T&)
// there, beside put() and take().

#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/json_fields.h"

namespace qchopper::json_values {

// --- single values ---------------------------------------------------------------------------------------------------

void put_schema(Json& at, bool);
void put_schema(Json& at, double);
void put_schema(Json& at, const char*);
void put_schema(Json& at, const std::string&);
void put_schema(Json& at, const std::filesystem::path&);
void put_schema(Json& at, Vec3);
void put_schema(Json& at, const Pose&);
void put_schema(Json& at, const Sha256&);
void put_schema(Json& at, const Uuid&);
void put_whole_schema(Json& at, std::int64_t least, std::uint64_t most);
void put_constant_schema(Json& at, const std::string& value);
void put_constant_schema(Json& at, std::uint64_t value);

void begin_object_schema(Json& at);
Json& added_property(Json& object, const char* key, bool is_required);
Json& list_schema(Json& at);                    // returns the schema of its elements
Json& list_schema(Json& at, std::size_t size);  // likewise, of a list of a fixed size
Json& added_choice(Json& at);                   // returns the schema of one more kind that a value may be of
void add_null(Json& at);                        // to those kinds
void add_word(Json& at, const char* word);      // to those that a text may be
void set_not_negative(Json& at);

// --- recursion -------------------------------------------------------------------------------------------------------

template <class T>
void put_schema(Json& at, const T& value);
template <class T>
void put_schema(Json& at, const std::optional<T>& value);
template <class T>
void put_schema(Json& at, const std::vector<T>& list);
template <class T, std::size_t size>
void put_schema(Json& at, const std::array<T, size>& list);

// Visits the table of one object.
class JsonSchemaWriter {
 public:
    explicit JsonSchemaWriter(Json& object) : object_(object) { begin_object_schema(object); }

    template <class T, class... Rule>
    void operator()(const char* key, const T& value, const Rule&... rules) {
        add(key, true, value, rules...);
    }
    template <class T, class... Rule>
    void maybe(const char* key, const T& value, const std::type_identity_t<T>& = {}, const Rule&... rules) {
        add(key, false, value, rules...);
    }
    template <class Table>
    void object(const char* key, const Table& table) {
        JsonSchemaWriter inner(added_property(object_, key, true));
        table(inner);
    }
    template <class Compute>
    void derived(const char* key, const Compute&, const char*) {
        add(key, true, std::remove_cvref_t<std::invoke_result_t<Compute>>{});
    }
    template <class Compute>
    void written(const char* key, const Compute&) {
        add(key, true, std::remove_cvref_t<std::invoke_result_t<Compute>>{});
    }
    template <class T, class To, class From>
    void converted(const char* key, const T&, const To&, const From&) {
        add(key, true, std::remove_cvref_t<std::invoke_result_t<To, const T&>>{});
    }
    void constant(const char* key, const std::string& value, const char*) {
        put_constant_schema(added_property(object_, key, true), value);
    }
    void version(const char* key, std::uint64_t value) {
        put_constant_schema(added_property(object_, key, true), value);
    }
    void check(bool, const char*, const char*) {}

 private:
    template <class T, class... Rule>
    void add(const char* key, bool is_required, const T& value, const Rule&...) {
        Json& at = added_property(object_, key, is_required);
        put_schema(at, value);
        if constexpr ((std::same_as<Rule, std::remove_const_t<decltype(not_negative)>> || ...)) set_not_negative(at);
    }

    Json& object_;
};

template <class T>
void put_schema(Json& at, const T& value) {
    if constexpr (std::integral<T>) {
        using Limits = std::numeric_limits<T>;
        put_whole_schema(at, std::int64_t{Limits::min()}, std::uint64_t{Limits::max()});
    } else if constexpr (std::is_enum_v<T>) {
        for (const auto& row : names_of(value).rows) add_word(at, row.name);
    } else {
        JsonSchemaWriter writer(at);
        T like = value;
        fields(writer, like);
    }
}

template <class T>
void put_schema(Json& at, const std::optional<T>&) {
    put_schema(added_choice(at), T{});
    add_null(at);
}

template <class T>
void put_schema(Json& at, const std::vector<T>&) {
    put_schema(list_schema(at), T{});
}

template <class T, std::size_t size>
void put_schema(Json& at, const std::array<T, size>&) {
    put_schema(list_schema(at, size), T{});
}

// The schema of a document of T, with a title.
template <class T>
std::string schema_of_document(const std::string& title) {
    return text_of_document(
        [&](Json& json) {
            put(added(json, "$schema"), "https://json-schema.org/draft/2020-12/schema");
            put(added(json, "title"), title);
            put_schema(json, T{});
        },
        2);
}

}  // namespace qchopper::json_values
