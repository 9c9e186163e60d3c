#include "cli/segment_values.h"

#include <charconv>
#include <cmath>
#include <vector>

namespace qchopper {
namespace {

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> words{""};
    for (const char c : text) {
        if (c == ',')
            words.emplace_back();
        else
            words.back() += c;
    }
    return words;
}

std::optional<double> number_from(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_ok = error == std::errc() && end == text.data() + text.size() && std::abs(value) <= 1e12;
    return is_ok ? std::optional(value) : std::nullopt;
}

std::optional<double>* weight_named(GivenWeights& weights, const std::string& name) {
    if (name == "face_ratio") return &weights.face_ratio;
    if (name == "fragility") return &weights.fragility;
    if (name == "piece_count") return &weights.piece_count;
    if (name == "undercut") return &weights.undercut;
    return nullptr;
}

}  // namespace

Weights GivenWeights::over(Weights weights) const {
    return {face_ratio.value_or(weights.face_ratio), fragility.value_or(weights.fragility),
            piece_count.value_or(weights.piece_count), undercut.value_or(weights.undercut)};
}

std::optional<GivenWeights> weights_from(const std::string& text) {
    const std::vector<std::string> words = split(text);
    GivenWeights weights;
    const bool is_bare = text.find('=') == std::string::npos;
    if (is_bare && words.size() != 4) return std::nullopt;
    const std::array<const char*, 4> order{"face_ratio", "fragility", "piece_count", "undercut"};
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        if (!is_bare && equals == std::string::npos) return std::nullopt;
        std::optional<double>* weight = weight_named(weights, is_bare ? order[i] : words[i].substr(0, equals));
        if (weight == nullptr || *weight) return std::nullopt;  // unknown, or named twice
        *weight = number_from(is_bare ? words[i] : words[i].substr(equals + 1));
        if (!*weight || **weight < 0) return std::nullopt;
    }
    return weights;
}

std::optional<Plane> plane_from(const std::string& text) {
    const std::vector<std::string> words = split(text);
    if (words.size() != 4) return std::nullopt;
    std::array<double, 4> v{};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::optional<double> value = number_from(words[i]);
        if (!value) return std::nullopt;
        v[i] = *value;
    }
    const Vec3 direction{v[0], v[1], v[2]};
    if (!(norm(direction) > 1e-12)) return std::nullopt;
    const Vec3 unit = std::abs(norm(direction) - 1) > 1e-14 ? normalized(direction) : direction;
    return canonical({unit, v[3]});
}

std::optional<std::size_t> place_from(const std::string& text) {
    const std::optional<double> value = number_from(text);
    if (!value || *value < 1 || *value > 1e6 || *value != std::floor(*value)) return std::nullopt;
    return static_cast<std::size_t>(*value);
}

}  // namespace qchopper
