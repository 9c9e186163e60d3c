// The values of an enumeration and their names in a file, as one table for writing and reading. O(values).

#pragma once

#include <cstddef>
#include <string>

#include "base/error.h"

namespace qchopper {

template <typename Enum>
struct EnumName {
    Enum value;
    const char* name;
};

// "?" for a value that is not in the table.
template <typename Enum, std::size_t n>
const char* name_of_value(const EnumName<Enum> (&names)[n], Enum value) {
    for (const auto& entry : names) {
        if (entry.value == value) return entry.name;
    }
    return "?";
}

// Throws InputError (config) for a name that is not in the table.
template <typename Enum, std::size_t n>
Enum value_of_name(const EnumName<Enum> (&names)[n], const std::string& name) {
    for (const auto& entry : names) {
        if (name == entry.name) return entry.value;
    }
    throw InputError(InputFault::config, "\"" + name + "\" is not known here");
}

}  // namespace qchopper
