// The values of an enumeration and their words in a file, as a table that is read in both directions.

#pragma once

#include <cstddef>
#include <string>

#include "base/error.h"

namespace qchopper {

template <typename Enum>
struct EnumWord {
    Enum value;
    const char* word;
};

template <typename Enum, std::size_t n>
const char* word_of(const EnumWord<Enum> (&words)[n], Enum value) {
    for (const auto& w : words) {
        if (w.value == value) return w.word;
    }
    return "?";
}

// Throws InputError (config) for any other word.
template <typename Enum, std::size_t n>
Enum value_of(const EnumWord<Enum> (&words)[n], const std::string& word) {
    for (const auto& w : words) {
        if (word == w.word) return w.value;
    }
    throw InputError(InputFault::config, "\"" + word + "\" is not known here");
}

}  // namespace qchopper
