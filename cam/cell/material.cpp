// A table of five names.

#include "cam/cell/material.h"

#include <array>
#include <utility>

namespace qchopper {
namespace {

constexpr std::array<std::pair<Material, std::string_view>, 5> names{{{Material::unspecified, "unspecified"},
                                                                      {Material::pu_foam, "pu_foam"},
                                                                      {Material::eps, "eps"},
                                                                      {Material::xps, "xps"},
                                                                      {Material::other, "other"}}};

}  // namespace

std::string to_word(Material material) {
    for (const auto& [value, name] : names) {
        if (value == material) return std::string(name);
    }
    return "other";
}

double assumed_bending_strength(Material material) {
    return material == Material::pu_foam ? 0.6 : material == Material::xps ? 0.2 : 0.15;
}

std::optional<Material> material_of(std::string_view word) {
    for (const auto& [value, name] : names) {
        if (name == word) return value;
    }
    return std::nullopt;
}

}  // namespace qchopper
