// Reads values out of a JSON text from an unknown source: the kind and the range of each are checked.
//
// A reader gets the object and the key of its value. All throw std::runtime_error that names the key and the reason;
// the caller adds the file (tests/cam/job/job_file_test.cpp, tests/cam/job/ticket_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/box.h"
#include "base/hex.h"

namespace qchopper::json_values {

using Json = nlohmann::ordered_json;

// The exception for a value: "KEY why".
inline std::runtime_error wrong(const std::string& key, const std::string& why) {
    return std::runtime_error(key + " " + why);
}

// Throws if the text is not JSON, is nested deeper than 16 levels, or holds a number that no double holds.
Json parsed(std::string_view text);
// Throws unless `text` is written(json): one form, so that the same job is the same bytes. Call it last, because it
// cannot name what differs.
void check_form(const Json& json, std::string_view text);

const Json& items(const Json& object, const std::string& key);   // a list
const Json& member(const Json& object, const std::string& key);  // of any kind
std::string text(const Json& object, const std::string& key);
std::vector<std::string> texts(const Json& object, const std::string& key);  // a list of them
bool truth(const Json& object, const std::string& key);
double real(const Json& object, const std::string& key);  // finite
// least <= value <= most
double real_within(const Json& object, const std::string& key, double least, double most);
// 0 <= value <= most, written without point and exponent.
std::uint64_t whole_up_to(const Json& object, const std::string& key, std::uint64_t most);
// Three finite numbers; `key` is for the message only.
Vec3 to_vector(const Json& value, const std::string& key);
Vec3 vector(const Json& object, const std::string& key);
Box box(const Json& object, const std::string& key);  // {min, max}

// Precondition: every number is finite, because JSON has no others.
Json from_vector(Vec3 v);
Json from_box(const Box& box);

// As text for people: two spaces per level, one last newline. Bytes that are not UTF-8 are replaced.
std::string written(const Json& json);

// A whole number that the unsigned type holds.
template <class Whole>
Whole whole(const Json& object, const std::string& key) {
    return static_cast<Whole>(whole_up_to(object, key, std::numeric_limits<Whole>::max()));
}

// Exactly 2 * Size lower-case hexadecimal digits.
template <std::size_t Size>
std::array<std::uint8_t, Size> from_hex(const Json& object, const std::string& key) {
    const auto bytes = qchopper::from_hex<Size>(text(object, key));
    if (!bytes) throw wrong(key, "is not " + std::to_string(2 * Size) + " hexadecimal digits");
    return *bytes;
}

}  // namespace qchopper::json_values
