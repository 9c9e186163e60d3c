// Reads by nlohmann::json. O(text) time and memory for parsed() and written().

#include "base/json.h"

#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

namespace qchopper::json_values {
namespace {

double number(const Json& value, const std::string& key) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) throw wrong(key, "is not a finite number");
    return value.get<double>();
}

constexpr int max_depth = 16;  // written() recurses once per level

}  // namespace

Json parsed(std::string_view text) {
    Json json;
    try {
        json = Json::parse(text, [](int depth, Json::parse_event_t, Json&) {
            if (depth > max_depth) throw std::runtime_error("holds lists in lists without end");
            return true;
        });
    } catch (const Json::parse_error& error) {
        throw std::runtime_error("is not JSON from byte " + std::to_string(error.byte) + " on");
    } catch (const Json::exception&) {  // its text is about the library, not about the file
        throw std::runtime_error("holds a number that is out of range");
    }
    return json;
}

void check_form(const Json& json, std::string_view text) {
    if (written(json) != text) throw std::runtime_error("is not in the one form in which qchopper writes it");
}

const Json& items(const Json& object, const std::string& key) {
    const Json& value = member(object, key);
    if (!value.is_array()) throw wrong(key, "is not a list");
    return value;
}

const Json& member(const Json& object, const std::string& key) {
    if (!object.is_object() || !object.contains(key)) throw wrong(key, "is missing");
    return object.at(key);
}

std::string text(const Json& object, const std::string& key) {
    const Json& value = member(object, key);
    if (!value.is_string()) throw wrong(key, "is not a text");
    return value.get<std::string>();
}

std::vector<std::string> texts(const Json& object, const std::string& key) {
    std::vector<std::string> list;
    for (const Json& value : items(object, key)) {
        if (!value.is_string()) throw wrong(key, "is not a list of texts");
        list.push_back(value.get<std::string>());
    }
    return list;
}

bool truth(const Json& object, const std::string& key) {
    const Json& value = member(object, key);
    if (!value.is_boolean()) throw wrong(key, "is not true or false");
    return value.get<bool>();
}

double real(const Json& object, const std::string& key) {
    return number(member(object, key), key);
}

double real_within(const Json& object, const std::string& key, double least, double most) {
    const double value = real(object, key);
    if (!(least <= value && value <= most)) throw wrong(key, "is out of range");
    return value;
}

std::uint64_t whole_up_to(const Json& object, const std::string& key, std::uint64_t most) {
    const Json& value = member(object, key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) {
        throw wrong(key, "is not a whole number in bounds");
    }
    return value.get<std::uint64_t>();
}

Vec3 to_vector(const Json& value, const std::string& key) {
    if (!value.is_array() || value.size() != 3) throw wrong(key, "is not three numbers");
    return {number(value[0], key), number(value[1], key), number(value[2], key)};
}

Vec3 vector(const Json& object, const std::string& key) {
    return to_vector(member(object, key), key);
}

Box box(const Json& object, const std::string& key) {
    const Json& value = member(object, key);
    return {vector(value, "min"), vector(value, "max")};
}

Json from_vector(Vec3 v) {
    assert(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
    return Json::array({v.x, v.y, v.z});
}

Json from_box(const Box& box) {
    return {{"min", from_vector(box.min)}, {"max", from_vector(box.max)}};
}

std::string written(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace qchopper::json_values
