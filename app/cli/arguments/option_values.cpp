// Numbers are read without a locale. A direction is scaled by a power of two before it is normalized.

#include "app/cli/arguments/option_values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ctime>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "base/text.h"
#include "segment/io/formats/text.h"
#include "segment/regions/methods.h"

namespace qchopper {
namespace {

constexpr double largest_weight = 1e12;

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts{""};
    for (const char c : text) {
        if (c == ',')
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

std::optional<double> number_from(const std::string& text) {
    const std::optional<double> value = number(text);  // what is too small for a double is zero
    return value && std::isfinite(*value) ? value : std::nullopt;
}

// The length of a direction of any length but zero. Scaling by a power of two keeps all bits, and squares then neither
// vanish nor overflow.
std::optional<Vec3> unit_from(Vec3 direction) {
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (largest == 0) return std::nullopt;
    const int power = -std::ilogb(largest);
    const Vec3 scaled{std::ldexp(direction.x, power), std::ldexp(direction.y, power), std::ldexp(direction.z, power)};
    return std::abs(norm(direction) - 1) > 1e-14 ? normalized(scaled) : direction;
}

// "50ml", in mm3.
std::optional<double> volume_from(const std::string& text) {
    constexpr std::pair<std::string_view, double> units[] = {{"mm3", 1}, {"cm3", 1e3}, {"ml", 1e3}, {"l", 1e6}};
    for (const auto& [unit, mm3] : units) {
        if (text.size() <= unit.size() || text.compare(text.size() - unit.size(), unit.size(), unit) != 0) continue;
        const std::optional<double> value = number_from(text.substr(0, text.size() - unit.size()));
        if (value && *value > 0) return *value * mm3;
    }
    return std::nullopt;
}

std::optional<double>* weight_named(GivenWeights& weights, const std::string& name) {
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        if (name == all_objectives[i].key) return &weights.weight[i];
    }
    return nullptr;
}

}  // namespace

std::optional<GivenWeights> weights_from(const std::string& text) {
    const std::vector<std::string> parts = split(text);
    GivenWeights weights;
    const bool is_bare = text.find('=') == std::string::npos;
    if (is_bare && parts.size() != always_named) return std::nullopt;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::size_t equals = parts[i].find('=');
        if (!is_bare && equals == std::string::npos) return std::nullopt;
        std::optional<double>* weight =
            weight_named(weights, is_bare ? all_objectives[i].key : parts[i].substr(0, equals));
        if (weight == nullptr || *weight) return std::nullopt;  // unknown, or named twice
        *weight = number_from(is_bare ? parts[i] : parts[i].substr(equals + 1));
        if (!*weight || **weight < 0 || **weight > largest_weight) return std::nullopt;
    }
    return weights;
}

std::optional<Plane> plane_from(const std::string& text) {
    const std::vector<std::string> parts = split(text);
    if (parts.size() != 4) return std::nullopt;
    std::array<double, 4> v{};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::optional<double> value = number_from(parts[i]);
        if (!value) return std::nullopt;
        v[i] = *value;
    }
    const std::optional<Vec3> unit = unit_from({v[0], v[1], v[2]});
    if (!unit) return std::nullopt;
    return canonical({*unit, v[3]});
}

std::optional<Vec3> lengths_from(const std::string& text) {
    std::istringstream in(text);
    Vec3 v;
    char comma[2] = {};
    if (!(in >> v.x >> comma[0] >> v.y >> comma[1] >> v.z) || comma[0] != ',' || comma[1] != ',') return std::nullopt;
    char rest = 0;
    if (in >> rest || !(v.x > 0 && v.y > 0 && v.z > 0)) return std::nullopt;
    return v;
}

std::optional<TaughtPose> taught_pose_from(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return std::nullopt;
    std::array<double, 2 * axes_of_arm> values{};
    for (std::size_t half = 0; half < 2; ++half) {
        const std::vector<std::string> parts = split(half == 0 ? text.substr(0, equals) : text.substr(equals + 1));
        if (parts.size() != axes_of_arm) return std::nullopt;
        for (std::size_t i = 0; i < axes_of_arm; ++i) {
            const std::optional<double> value = number_from(parts[i]);
            if (!value || std::abs(*value) > 1e6) return std::nullopt;
            values[half * axes_of_arm + i] = *value;
        }
    }
    const auto& v = values;
    return TaughtPose{{v[0], v[1], v[2], v[3], v[4], v[5]}, {v[6], v[7], v[8]}, {v[9], v[10], v[11]}};
}

std::optional<EnteredBase> base_from(const std::string& text) {
    const std::vector<std::string> parts = split(text);
    std::array<double, 6> v{};
    if (parts.size() != v.size()) return std::nullopt;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const std::optional<double> value = number_from(parts[i]);
        if (!value || std::abs(*value) > 1e6) return std::nullopt;
        v[i] = *value;
    }
    return EnteredBase{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

std::optional<EnteredLength> tool_length_from(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return std::nullopt;
    const std::optional<double> number = number_from(text.substr(0, equals));
    const std::optional<double> length = number_from(text.substr(equals + 1));
    if (!number || *number < 0 || *number > 65535 || *number != std::floor(*number)) return std::nullopt;
    if (!length || !(*length > 0)) return std::nullopt;
    return EnteredLength{static_cast<std::uint16_t>(*number), *length};
}

std::optional<Vec3> print_volume_from(const std::string& text) {
    const std::optional<Vec3> v = lengths_from(text);
    return v && std::min({v->x, v->y, v->z}) >= 1 ? v : std::nullopt;
}

namespace {

// "+x", "-z", "0:0.1:1": a direction of length 1.
std::optional<Vec3> direction_from(std::string text) {
    if (text.size() == 2 && (text[0] == '+' || text[0] == '-') && text[1] >= 'x' && text[1] <= 'z') {
        Vec3 axis;
        axis[text[1] - 'x'] = text[0] == '+' ? 1 : -1;
        return axis;
    }
    std::replace(text.begin(), text.end(), ':', ',');
    const std::vector<std::string> parts = split(text);
    if (parts.size() != 3) return std::nullopt;
    Vec3 v;
    for (int axis = 0; axis < 3; ++axis) {
        const std::optional<double> value = number_from(parts[static_cast<std::size_t>(axis)]);
        if (!value) return std::nullopt;
        v[axis] = *value;
    }
    return unit_from(v);
}

std::optional<double> number_within(const std::string& text, double low, double high) {
    const std::optional<double> value = number_from(text);
    return value && *value >= low && *value <= high ? value : std::nullopt;
}

// "weight", "200", "weight+200"
bool read_load(std::string text, StructureOptions& load) {
    const std::string weight = "weight";
    load.has_own_weight = text.starts_with(weight);
    if (text == weight) return true;
    if (load.has_own_weight) {
        if (!text.starts_with(weight + "+")) return false;
        text.erase(0, weight.size() + 1);
    }
    const std::optional<double> force = number_within(text, 1e-6, 1e9);
    load.force_n = force.value_or(0);
    return force.has_value();
}

bool read_load_value(const std::string& name, const std::string& value, StructureOptions& load) {
    if (name == "load") return read_load(value, load);
    if (name == "upright") {
        const std::optional<Vec3> up = direction_from(value);
        load.up = up.value_or(Vec3{});
        return up.has_value();
    }
    struct Quantity {
        const char* name;
        double StructureOptions::*value;
        double low;
        double high;
    };
    constexpr std::array<Quantity, 4> quantities{{{"density", &StructureOptions::density_kg_per_m3, 1e-3, 1e5},
                                                  {"strength", &StructureOptions::strength_mpa, 1e-6, 1e6},
                                                  {"voxel", &StructureOptions::voxel_mm, 1e-3, 1e6},
                                                  {"poisson", &StructureOptions::poisson_ratio, 0, 0.49}}};
    for (const Quantity& q : quantities) {
        if (name != q.name) continue;
        const std::optional<double> number = number_within(value, q.low, q.high);
        if (number) load.*q.value = *number;
        return number.has_value();
    }
    return false;
}

}  // namespace

std::optional<StructureOptions> load_from(const std::string& text) {
    StructureOptions load;
    std::set<std::string> given;
    for (const std::string& part : split(text)) {
        const std::size_t equals = part.find('=');
        if (equals == std::string::npos || !given.insert(part.substr(0, equals)).second) return std::nullopt;
        if (!read_load_value(part.substr(0, equals), part.substr(equals + 1), load)) return std::nullopt;
    }
    for (const char* name : {"upright", "density", "strength", "load"}) {
        if (!given.contains(name)) return std::nullopt;
    }
    return load;
}

std::optional<DiscardRequest> discard_from(const std::string& text) {
    constexpr std::string_view below = "below=";
    DiscardRequest request;
    for (const std::string& part : split(text)) {
        if (part.compare(0, below.size(), below) != 0) {
            if (part.empty() || part.find('=') != std::string::npos) return std::nullopt;
            request.pieces.push_back(part);
            continue;
        }
        if (request.below_mm3) return std::nullopt;  // given twice
        request.below_mm3 = volume_from(part.substr(below.size()));
        if (!request.below_mm3) return std::nullopt;
    }
    return request;
}

std::optional<Shard> shard_from(const std::string& text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos) return std::nullopt;
    const std::optional<std::size_t> count = place_from(text.substr(slash + 1));
    const std::optional<double> number = number_from(text.substr(0, slash));
    if (!count || !number || *number < 0 || *number >= static_cast<double>(*count)) return std::nullopt;
    if (*number != std::floor(*number)) return std::nullopt;
    return Shard{static_cast<std::size_t>(*number), *count};
}

std::optional<std::size_t> place_from(const std::string& text) {
    const std::optional<double> value = number_from(text);
    if (!value || *value < 1 || *value > 1e6 || *value != std::floor(*value)) return std::nullopt;
    return static_cast<std::size_t>(*value);
}

std::optional<std::vector<std::string>> proposers_from(const std::string& text) {
    std::vector<std::string> names;
    if (text == "none") return names;
    if (text == "all") {
        for (const RegionMethod& method : region_methods()) names.emplace_back(method.name);
        return names;
    }
    for (const std::string& name : split(text)) {
        if (region_method(name) == nullptr || std::ranges::find(names, name) != names.end()) return std::nullopt;
        names.push_back(name);
    }
    return names;
}

std::vector<std::string> forbiddable() {
    std::vector<std::string> keys;
    for (const ObjectiveField& field : all_objectives) {
        if (field.can_forbid) keys.emplace_back(field.key);
    }
    return keys;
}

// Messages of their own: those of the option parser have type names and bounds of 300 digits.
TcpAddress listen_address(const std::string& text) {
    if (!text.ends_with(":0")) return parse_tcp_address(text);
    TcpAddress address = parse_tcp_address(text.substr(0, text.size() - 2));
    address.port = 0;
    return address;
}

std::vector<std::uint16_t> ascending(std::vector<std::uint16_t> numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

OptionCheck number_between(double low, double high, const std::string& what) {
    return [=](const std::string& text) {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool ok = error == std::errc() && end == text.data() + text.size() && value >= low && value <= high;
        return ok ? std::string() : "\"" + text + "\" is not " + what;
    };
}

OptionCheck one_of(const std::vector<std::string>& values) {
    return [=](const std::string& text) {
        if (std::find(values.begin(), values.end(), text) != values.end()) return std::string();
        std::string list;
        for (const std::string& value : values) list += (list.empty() ? "" : ", ") + value;
        return "\"" + text + "\" is not one of " + list;
    };
}

std::optional<std::uint64_t> ms_from_utc(std::string_view text) {
    std::string whole(text);
    if (whole.size() == 10) whole += " 00:00:00";
    std::tm parts{};
    const char* const end = ::strptime(whole.c_str(), "%Y-%m-%d %H:%M:%S", &parts);
    if (end == nullptr || *end != '\0') return std::nullopt;
    const std::time_t seconds = ::timegm(&parts);
    if (seconds < 0) return std::nullopt;
    const std::uint64_t unix_ms = static_cast<std::uint64_t>(seconds) * 1000;
    if (utc_text(unix_ms) != whole) return std::nullopt;  // the 31st of February
    return unix_ms;
}

}  // namespace qchopper
