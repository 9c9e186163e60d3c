// The distance of V. I. Levenshtein ("Binary codes capable of correcting deletions, insertions, and reversals", 1966)
// by dynamic programming, one row kept. O(a.size() * b.size()) time, O(b.size()) memory.

#include "base/edit_distance.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace qchopper {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

}  // namespace qchopper
