// The values of an enumeration and their names in a file, as one table for writing and reading. O(values).

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace qchopper {

template <typename Enum>
struct EnumName {
    Enum value;
    const char* name;
};

template <typename Enum, std::size_t n>
struct EnumNames {
    EnumName<Enum> rows[n];

    // "?" for a value that is not in the table.
    constexpr const char* operator()(Enum value) const {
        for (const auto& row : rows) {
            if (row.value == value) return row.name;
        }
        return "?";
    }
    // Nothing for a name that is not in the table.
    std::optional<Enum> operator()(std::string_view name) const {
        for (const auto& row : rows) {
            if (name == row.name) return row.value;
        }
        return std::nullopt;
    }
    // "is neither red nor blue", "is none of red, green, blue".
    std::string refusal() const {
        std::string why = n == 2 ? "is neither " : "is none of ";
        for (std::size_t i = 0; i < n; ++i) why += (i == 0 ? "" : n == 2 ? " nor " : ", ") + std::string(rows[i].name);
        return why;
    }
};

}  // namespace qchopper
