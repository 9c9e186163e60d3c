// Passes in an order in which each begins near to where the one before ends.
//
// mm, in a plane: heights do not count. Always the nearest one that is left, of equal ones the first; or, where all are
// known and any order will do, that order improved (tests/cam/toolpath/passes_and_links_test.cpp).

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/box.h"
#include "cam/toolpath/pass.h"

namespace qchopper {

// Where a pass is begun: at its first or last point, or at any point of a closed one.
struct PassEntry {
    std::size_t pass = 0;
    std::size_t point = 0;
};

class PassOrder {
 public:
    // The passes must outlive it. O(points).
    explicit PassOrder(std::span<const Pass> passes);

    // Takes the pass with the entry nearest to a place; nothing when all are taken. Few squares are looked at while
    // passes are left nearby, at most all of them.
    std::optional<PassEntry> take_nearest(Vec3 from);

 private:
    struct Entry {
        PassEntry entry;
        Vec3 at;
    };
    void add(std::size_t pass, std::size_t point);
    std::pair<std::ptrdiff_t, std::ptrdiff_t> square_of(Vec3 at) const;
    void look_at(std::ptrdiff_t column, std::ptrdiff_t row, Vec3 from, double& least, const Entry*& nearest);

    std::span<const Pass> passes_;
    std::vector<bool> is_taken_;
    std::size_t left_ = 0;
    Box box_{};
    double side_ = 1;  // of a square
    std::ptrdiff_t columns_ = 1;
    std::ptrdiff_t rows_ = 1;
    std::vector<std::vector<Entry>> squares_;
};

// All passes from a place on: the nearest first, then stretches of this order turned about as long as that shortens the
// ways between passes (2-opt: G. A. Croes, "A method for solving traveling-salesman problems", 1958). Never longer than
// the order of the nearest. O(passes^2) a round for up to 1,000 passes, O(1,000 passes) above; at most 30 rounds.
std::vector<PassEntry> short_order(std::span<const Pass> passes, Vec3 from);

// The points of a pass from an entry on: an open one reversed if it is begun at its last point, a closed one turned so
// that it begins and ends there. Precondition: the entry is one of PassOrder.
Pass begun_at(const Pass& pass, std::size_t point);

}  // namespace qchopper
