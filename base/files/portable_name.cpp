// Compares characters by their codes, independent of the locale.

#include "base/files/portable_name.h"

#include <algorithm>

namespace qchopper {

bool is_portable_name(std::string_view name) {
    const auto allowed = [](char c) {
        return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
               c == '-';
    };
    return !name.empty() && name.size() <= 32 && name.front() != '.' && std::all_of(name.begin(), name.end(), allowed);
}

}  // namespace qchopper
