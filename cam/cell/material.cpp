#include "cam/cell/material.h"

#include <array>
#include <utility>

namespace qchopper {
namespace {

constexpr std::array<std::pair<Material, std::string_view>, 5> words{{{Material::unspecified, "unspecified"},
                                                                      {Material::pu_foam, "pu_foam"},
                                                                      {Material::eps, "eps"},
                                                                      {Material::xps, "xps"},
                                                                      {Material::other, "other"}}};

}  // namespace

std::string to_word(Material material) {
    for (const auto& [value, word] : words) {
        if (value == material) return std::string(word);
    }
    return "other";
}

std::optional<Material> material_of(std::string_view word) {
    for (const auto& [value, known] : words) {
        if (known == word) return value;
    }
    return std::nullopt;
}

}  // namespace qchopper
