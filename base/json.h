// Values out of a JSON text that somebody else may have written: each is checked before it is believed.
//
// The readers throw std::runtime_error that names the key; the caller knows the file.

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/box.h"
#include "base/hex.h"

namespace qchopper::json_values {

using Json = nlohmann::ordered_json;

inline std::runtime_error wrong(const std::string& key, const std::string& why) {
    return std::runtime_error(key + " " + why);
}

Json parsed(std::string_view text);
// Throws unless the text is what written() makes of its value: one form, so that the same job is the same bytes. To be
// asked last, because it cannot say what is wrong.
void check_form(const Json& json, std::string_view text);

const Json& items(const Json& object, const std::string& key);
const Json& member(const Json& object, const std::string& key);
std::string text(const Json& object, const std::string& key);
bool truth(const Json& object, const std::string& key);
double real(const Json& object, const std::string& key);  // finite
double real_within(const Json& object, const std::string& key, double least, double most);
std::uint64_t whole_up_to(const Json& object, const std::string& key, std::uint64_t most);
Vec3 to_vector(const Json& value, const std::string& key);
Vec3 vector(const Json& object, const std::string& key);
Box box(const Json& object, const std::string& key);

Json from_vector(Vec3 v);
Json from_box(const Box& box);

// Two spaces a level and a last newline: a person may want to read it.
std::string written(const Json& json);

template <class Whole>
Whole whole(const Json& object, const std::string& key) {
    return static_cast<Whole>(whole_up_to(object, key, std::numeric_limits<Whole>::max()));
}

template <std::size_t Size>
std::array<std::uint8_t, Size> from_hex(const Json& object, const std::string& key) {
    const auto bytes = qchopper::from_hex<Size>(text(object, key));
    if (!bytes) throw wrong(key, "is not " + std::to_string(2 * Size) + " hexadecimal digits");
    return *bytes;
}

}  // namespace qchopper::json_values
