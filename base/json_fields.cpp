// By nlohmann::json. O(text) time and memory.

#include "base/json_fields.h"

#include <cassert>
#include <nlohmann/json.hpp>

namespace qchopper::json_values {
namespace {

constexpr const char* rows_key = "rows";  // of a pose
constexpr const char* shift_key = "shift";

constexpr int max_depth = 16;  // written() recurses once per level

Json parsed(std::string_view text) {
    try {
        return Json::parse(text, [](int depth, Json::parse_event_t, Json&) {
            if (depth > max_depth) throw NotJson("holds lists in lists without end");
            return true;
        });
    } catch (const Json::parse_error& error) {
        throw NotJson("is not JSON from byte " + std::to_string(error.byte) + " on");
    } catch (const Json::exception&) {  // its text is about the library, not about the file
        throw NotJson("holds a number that is out of range");
    }
}

std::string written(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

template <std::size_t size>
std::array<std::uint8_t, size> hex(const Json& json, const std::string& key) {
    std::string digits;
    take(json, key, digits);
    const auto bytes = qchopper::from_hex<size>(digits);
    if (!bytes) throw wrong(key, "is not " + std::to_string(2 * size) + " hexadecimal digits");
    return *bytes;
}

}  // namespace

void put(Json& at, bool value) {
    at = value;
}

void put(Json& at, double value) {
    assert(std::isfinite(value));
    at = value;
}

void put(Json& at, const char* value) {
    at = value;
}

void put(Json& at, const std::string& value) {
    at = value;
}

void put(Json& at, const std::filesystem::path& value) {
    at = value.string();
}

void put(Json& at, Vec3 value) {
    put(at, std::array{value.x, value.y, value.z});
}

void put(Json& at, const Pose& value) {
    put(at[rows_key], value.row);
    put(at[shift_key], value.shift);
}

void put(Json& at, const Sha256& value) {
    at = to_hex(value.bytes);
}

void put(Json& at, const Uuid& value) {
    at = to_hex(value);
}

void put_whole(Json& at, std::int64_t value) {
    at = value;
}

void put_whole(Json& at, std::uint64_t value) {
    at = value;
}

void take(const Json& json, const std::string& key, bool& value) {
    if (!json.is_boolean()) throw wrong(key, "is not true or false");
    value = json.get<bool>();
}

void take(const Json& json, const std::string& key, double& value) {
    if (!json.is_number() || !std::isfinite(json.get<double>())) throw wrong(key, "is not a finite number");
    value = json.get<double>();
}

void take(const Json& json, const std::string& key, std::string& value) {
    if (!json.is_string()) throw wrong(key, "is not a text");
    value = json.get<std::string>();
}

void take(const Json& json, const std::string& key, std::filesystem::path& value) {
    std::string text;
    take(json, key, text);
    value = text;
}

void take(const Json& json, const std::string& key, Vec3& value) {
    if (!json.is_array() || json.size() != 3) throw wrong(key, "is not three numbers");
    take(json[0], key, value.x);
    take(json[1], key, value.y);
    take(json[2], key, value.z);
}

void take(const Json& json, const std::string& key, Pose& value) {
    const Json& rows = member(json, rows_key);
    if (!rows.is_array() || rows.size() != 3) throw wrong("rows", "is not three rows");
    for (std::size_t i = 0; i < 3; ++i) take(rows[i], rows_key, value.row[i]);
    take(member(json, shift_key), shift_key, value.shift);
    // A mirror image would pass all other checks and be milled.
    const double turn = dot(value.row[0], cross(value.row[1], value.row[2]));
    if (!(std::abs(turn - 1) < 1e-6)) throw wrong(key, "is not a rotation");
}

void take(const Json& json, const std::string& key, Sha256& value) {
    value.bytes = hex<32>(json, key);
}

void take(const Json& json, const std::string& key, Uuid& value) {
    value = hex<16>(json, key);
}

void take(const Json& json, const std::string& key, std::array<double, 2>& value) {
    if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number()) {
        throw wrong(key, "is not two numbers");
    }
    value = {json[0].get<double>(), json[1].get<double>()};
}

void take(const Json& json, const std::string& key, std::vector<double>& list) {
    list.clear();
    for (std::size_t i = 0; i < size_of_list(json, key); ++i) {
        if (!json[i].is_number()) throw wrong(key, "is not a list of numbers");
        list.push_back(json[i].get<double>());
    }
}

void take(const Json& json, const std::string& key, std::vector<std::string>& list) {
    list.clear();
    for (std::size_t i = 0; i < size_of_list(json, key); ++i) {
        if (!json[i].is_string()) throw wrong(key, "is not a list of texts");
        list.push_back(json[i].get<std::string>());
    }
}

std::int64_t to_whole(const Json& json, const std::string& key, std::int64_t least, std::int64_t most) {
    const bool is_large = json.is_number_unsigned() && json.get<std::uint64_t>() > static_cast<std::uint64_t>(most);
    if (!json.is_number_integer() || is_large || json.get<std::int64_t>() < least) {
        throw wrong(key, "is not a whole number in bounds");
    }
    return json.get<std::int64_t>();
}

std::uint64_t to_whole(const Json& json, const std::string& key, std::uint64_t most) {
    if (!json.is_number_unsigned() || json.get<std::uint64_t>() > most) {
        throw wrong(key, "is not a whole number in bounds");
    }
    return json.get<std::uint64_t>();
}

Json& added(Json& object, const char* key) {
    return object[key];
}

Json& added(Json& list) {
    return list.emplace_back();
}

const Json& member(const Json& object, const std::string& key) {
    if (!is_there(object, key.c_str())) throw wrong(key, "is missing");
    return object.at(key);
}

void make_list(Json& json) {
    json = Json::array();
}

void make_object(Json& json) {
    if (json.is_null()) json = Json::object();
}

std::size_t size_of_list(const Json& json, const std::string& key) {
    if (!json.is_array()) throw wrong(key, "is not a list");
    return json.size();
}

const Json& element(const Json& list, std::size_t i) {
    return list[i];
}

bool is_there(const Json& object, const char* key) {
    return object.contains(key);
}

bool is_null(const Json& json) {
    return json.is_null();
}

bool is_list(const Json& json) {
    return json.is_array();
}

void JsonReader::constant(const char* key, const std::string& value, const char* why) {
    std::string stated;
    (*this)(key, stated);
    check(stated == value, key, why);
}

void JsonReader::version(const char* key, std::uint64_t value) {
    std::uint64_t stated = 0;
    (*this)(key, stated);
    if (stated == value) return;
    throw wrong(key, std::to_string(stated) + " is not " + std::to_string(value) + ", the one that this program reads");
}

std::string text_of_document(const std::function<void(Json&)>& write, int indent) {
    Json json;
    write(json);
    return written(json, indent);
}

void read_document(std::string_view text, const std::function<void(const Json&)>& read, bool is_exact) {
    const Json json = parsed(text);
    read(json);
    // Last, because it cannot name what differs.
    if (is_exact && written(json, 2) != text) {
        throw std::runtime_error("is not in the one form in which qchopper writes it");
    }
}

}  // namespace qchopper::json_values
