// Writes and reads structs as JSON objects by one table of fields each, so that a key stands once.
//
// The table of a struct is a function template in the source of its document, or in a header where two documents have
// it. A struct has one table in the whole program: two would be two definitions of one function.
//
//     template <class V, Of<JobPart> T>
//     void fields(V& v, T& part) {
//         v("number", part.number);
//         v("count", part.count);
//         v.check(part.number <= part.count, "number", "is not one of 1 to count");
//     }
//
// JsonWriter and JsonReader visit it; structs, lists and optionals (null) follow by recursion, and values of
// enumerations by their words: names_of(T{}) is a table like EnumNames. Keys are written in the order of the table. All
// of JsonReader throws std::runtime_error "KEY why"; the caller adds the file (tests/base/json_fields_test.cpp). Only
// who builds JSON otherwise includes the library.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/box.h"
#include "base/pose.h"
#include "base/sha256.h"
#include "base/uuid.h"

namespace qchopper {

template <class T, class Struct>
concept Of = std::same_as<std::remove_const_t<T>, Struct>;

template <class V, Of<Box> T>
void fields(V& v, T& box) {
    v("min", box.min);
    v("max", box.max);
}

namespace json_values {

using Json = nlohmann::ordered_json;

// The exception for a value: "KEY why".
inline std::runtime_error wrong(const std::string& key, const std::string& why) {
    return std::runtime_error(key + " " + why);
}

// --- single values ---------------------------------------------------------------------------------------------------

// Precondition: every number is finite, because JSON has no others.
void put(Json& at, bool value);
void put(Json& at, double value);
void put(Json& at, const char* value);
void put(Json& at, const std::string& value);
void put(Json& at, const std::filesystem::path& value);
void put(Json& at, Vec3 value);           // three numbers
void put(Json& at, const Pose& value);    // {rows, shift}
void put(Json& at, const Sha256& value);  // hexadecimal digits
void put(Json& at, const Uuid& value);    // hexadecimal digits
void put_whole(Json& at, std::int64_t value);
void put_whole(Json& at, std::uint64_t value);

// `key` is for the message only.
void take(const Json& json, const std::string& key, bool& value);
void take(const Json& json, const std::string& key, double& value);  // finite
void take(const Json& json, const std::string& key, std::string& value);
void take(const Json& json, const std::string& key, std::filesystem::path& value);
void take(const Json& json, const std::string& key, Vec3& value);
void take(const Json& json, const std::string& key, Pose& value);  // a rotation, to 1e-6
void take(const Json& json, const std::string& key, Sha256& value);
void take(const Json& json, const std::string& key, Uuid& value);
void take(const Json& json, const std::string& key, std::array<double, 2>& value);
void take(const Json& json, const std::string& key, std::vector<double>& list);
void take(const Json& json, const std::string& key, std::vector<std::string>& list);
// Written without point and exponent; least <= value <= most, or 0 <= value <= most.
std::int64_t to_whole(const Json& json, const std::string& key, std::int64_t least, std::int64_t most);
std::uint64_t to_whole(const Json& json, const std::string& key, std::uint64_t most);

// Of an object, a list, or null that becomes one.
Json& added(Json& object, const char* key);
Json& added(Json& list);
const Json& member(const Json& object, const std::string& key);  // throws if it is missing
void make_list(Json& json);
void make_object(Json& json);
std::size_t size_of_list(const Json& json, const std::string& key);  // throws if it is none
const Json& element(const Json& list, std::size_t i);
bool is_there(const Json& object, const char* key);
bool is_null(const Json& json);
bool is_list(const Json& json);

// --- recursion -------------------------------------------------------------------------------------------------------

template <class T>
void put(Json& at, const T& value);
template <class T>
void put(Json& at, const std::optional<T>& value);
template <class T>
void put(Json& at, const std::vector<T>& list);
template <class T, std::size_t size>
void put(Json& at, const std::array<T, size>& list);
template <class T>
void take(const Json& json, const std::string& key, T& value);
template <class T>
void take(const Json& json, const std::string& key, std::optional<T>& value);
template <class T>
void take(const Json& json, const std::string& key, std::vector<T>& list);

// Writes one object. What only a reader needs does nothing.
class JsonWriter {
 public:
    explicit JsonWriter(Json& object) : object_(object) { make_object(object); }

    template <class T, class... Rule>
    void operator()(const char* key, const T& value, const Rule&...) {
        put(added(object_, key), value);
    }
    // A key that is left out where the value is the usual one.
    template <class T, class... Rule>
    void maybe(const char* key, const T& value, const std::type_identity_t<T>& usual = {}, const Rule&...) {
        if (!(value == usual)) put(added(object_, key), value);
    }
    // An object that is no struct of its own: table(visitor).
    template <class Table>
    void object(const char* key, const Table& table) {
        JsonWriter inner(added(object_, key));
        table(inner);
    }
    // What follows from other fields: compute().
    template <class Compute>
    void derived(const char* key, const Compute& compute, const char*) {
        put(added(object_, key), compute());
    }
    // What is for people only and not read: compute().
    template <class Compute>
    void written(const char* key, const Compute& compute) {
        put(added(object_, key), compute());
    }
    // A value that stands in another form in the document: to(value), from(what was read).
    template <class T, class To, class From>
    void converted(const char* key, const T& value, const To& to, const From&) {
        put(added(object_, key), to(value));
    }
    void constant(const char* key, const std::string& value, const char*) { put(added(object_, key), value); }
    void version(const char* key, std::uint64_t value) { put_whole(added(object_, key), value); }
    void check(bool, const char*, const char*) {}

 private:
    Json& object_;
};

class JsonReader {
 public:
    explicit JsonReader(const Json& object) : object_(object) {}

    // A rule gets the value and returns why it is refused, or nullptr.
    template <class T, class... Rule>
    void operator()(const char* key, T& value, const Rule&... rules) {
        take(member(object_, key), key, value);
        (refuse(key, rules(value)), ...);
    }
    template <class T, class... Rule>
    void maybe(const char* key, T& value, const std::type_identity_t<T>& usual = {}, const Rule&... rules) {
        value = usual;
        if (is_there(object_, key)) (*this)(key, value, rules...);
    }
    template <class Table>
    void object(const char* key, const Table& table) {
        JsonReader inner(member(object_, key));
        table(inner);
        inner.finish();
    }
    // Compared when all of the object is read, numbers to 1e-9.
    template <class Compute>
    void derived(const char* key, const Compute& compute, const char* why) {
        std::invoke_result_t<Compute> stated{};
        take(member(object_, key), key, stated);
        later_.emplace_back([stated, compute, key, why] { refuse(key, is_same(stated, compute()) ? nullptr : why); });
    }
    template <class Compute>
    void written(const char*, const Compute&) {}
    template <class T, class To, class From>
    void converted(const char* key, T& value, const To&, const From& from) {
        std::remove_cvref_t<std::invoke_result_t<To, const T&>> read{};
        take(member(object_, key), key, read);
        value = from(read);
    }
    void constant(const char* key, const std::string& value, const char* why);
    void version(const char* key, std::uint64_t value);
    void check(bool holds, const char* key, const char* why) const { refuse(key, holds ? nullptr : why); }
    void finish() const {
        for (const std::function<void()>& compare : later_) compare();
    }

 private:
    template <class T>
    static bool is_same(const T& a, const T& b) {
        if constexpr (std::floating_point<T>) return std::abs(a - b) <= 1e-9;
        return a == b;
    }

    static void refuse(const char* key, const char* why) {
        if (why != nullptr) throw wrong(key, why);
    }

    const Json& object_;
    std::vector<std::function<void()>> later_;
};

template <class T>
void put(Json& at, const T& value) {
    if constexpr (std::unsigned_integral<T>) {
        put_whole(at, std::uint64_t{value});
    } else if constexpr (std::signed_integral<T>) {
        put_whole(at, std::int64_t{value});
    } else if constexpr (std::is_enum_v<T>) {
        put(at, std::string(names_of(value)(value)));
    } else {
        JsonWriter writer(at);
        fields(writer, value);
    }
}

template <class T>
void put(Json& at, const std::optional<T>& value) {
    if (value) put(at, *value);
}

template <class T>
void put(Json& at, const std::vector<T>& list) {
    make_list(at);
    for (const T& value : list) put(added(at), value);
}

template <class T, std::size_t size>
void put(Json& at, const std::array<T, size>& list) {
    make_list(at);
    for (const T& value : list) put(added(at), value);
}

template <class T>
void take(const Json& json, const std::string& key, T& value) {
    if constexpr (std::unsigned_integral<T>) {
        value = static_cast<T>(to_whole(json, key, std::uint64_t{std::numeric_limits<T>::max()}));
    } else if constexpr (std::signed_integral<T>) {
        using Limits = std::numeric_limits<T>;
        value = static_cast<T>(to_whole(json, key, std::int64_t{Limits::min()}, std::int64_t{Limits::max()}));
    } else if constexpr (std::is_enum_v<T>) {
        std::string word;
        take(json, key, word);
        const std::optional<T> named = names_of(T{})(word);
        if (!named) throw wrong(key, names_of(T{}).refusal());
        value = *named;
    } else {
        JsonReader reader(json);
        fields(reader, value);
        reader.finish();
    }
}

template <class T>
void take(const Json& json, const std::string& key, std::optional<T>& value) {
    value.reset();
    if (is_null(json)) return;
    T read{};
    take(json, key, read);
    value = std::move(read);
}

template <class T>
void take(const Json& json, const std::string& key, std::vector<T>& list) {
    list.clear();
    const std::size_t size = size_of_list(json, key);
    for (std::size_t i = 0; i < size; ++i) take(element(json, i), key, list.emplace_back());
}

// --- whole documents -------------------------------------------------------------------------------------------------

// Of a text that is no JSON, is nested deeper than 16 levels, or holds a number that no double holds.
struct NotJson : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Text for people: `indent` spaces per level, one last newline. Bytes that are not UTF-8 are replaced.
std::string text_of_document(const std::function<void(Json&)>& write, int indent);
// Reading an exact document takes the text only in the form in which it is written with two spaces per level, so that
// the same job is the same bytes.
void read_document(std::string_view text, const std::function<void(const Json&)>& read, bool is_exact);

template <class T>
std::string to_document(const T& value, int indent = 2) {
    return text_of_document([&](Json& json) { put(json, value); }, indent);
}

template <class T>
void from_document(std::string_view text, T& value, bool is_exact = true) {
    read_document(
        text, [&](const Json& json) { take(json, "it", value); }, is_exact);
}

// --- rules -----------------------------------------------------------------------------------------------------------

inline constexpr auto not_negative = [](double value) { return value >= 0 ? nullptr : "is out of range"; };
inline constexpr auto is_direction = [](Vec3 value) {
    return std::abs(norm(value) - 1) < 1e-6 ? nullptr : "is not of length 1";
};

template <class T>
bool is_ascending(const std::vector<T>& values) {
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<T>()) == values.end();
}

}  // namespace json_values
}  // namespace qchopper
