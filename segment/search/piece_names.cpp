// Bijective base 26.

#include "segment/search/piece_names.h"

#include <algorithm>
#include <cassert>

namespace qchopper {

std::string piece_name(std::size_t index) {
    std::string name;
    for (std::size_t rest = index + 1; rest > 0; rest = (rest - 1) / 26) {
        name.insert(name.begin(), static_cast<char>('A' + (rest - 1) % 26));
    }
    return name;
}

bool is_piece_name(const std::string& name) {
    constexpr std::size_t longest = 12;  // 26^13 is more than 64 bits hold
    return !name.empty() && name.size() <= longest &&
           std::all_of(name.begin(), name.end(), [](char letter) { return letter >= 'A' && letter <= 'Z'; });
}

std::size_t piece_index(const std::string& name) {
    assert(is_piece_name(name));
    std::size_t count = 0;
    for (const char letter : name) count = 26 * count + static_cast<std::size_t>(letter - 'A') + 1;
    return count - 1;
}

}  // namespace qchopper
