// One set of bits per direction: the rows that are open along it, then the caps that it faces. Greedy choice and
// exchanges count bits: O(chosen^2 x possible x samples / 64). Rays only for samples that no chosen direction reaches,
// in parallel, per row along all dense directions; sums are counts, whatever the number of threads.

#include "segment/access/chosen_directions.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "segment/access/row_set.h"
#include "segment/access/up_column.h"

namespace qchopper {
namespace {

constexpr std::size_t words_at_once = 4;
constexpr std::size_t rows_at_once = 16;
constexpr float open = std::numeric_limits<float>::infinity();

bool is_steep(Vec3 normal, std::span<const Vec3> directions) {
    return std::any_of(directions.begin(), directions.end(),
                       [&](Vec3 d) { return std::abs(dot(normal, d)) < min_facing; });
}

// What directions reach: the rows of the piece as bits, and from the next whole word on its caps. Caps that do not
// count are never reached.
class ReachedSets {
 public:
    ReachedSets(const JudgedPiece& piece, const TiltBase& base, std::span<const std::uint32_t> possible)
        : piece_(piece),
          base_(base),
          rows_(piece.accessibility.sample.size()),
          row_words_(words_for(rows_)),
          words_(row_words_ + words_for(piece.caps.size())) {
        std::vector<std::size_t> columns;  // of the table
        directions_.push_back(base.up);
        const std::size_t up = index_of(piece.scan.directions, base.up);
        for (const std::uint32_t k : possible) {
            assert(k < piece.scan.directions.size());
            if (k == up) continue;
            columns.push_back(k);
            directions_.push_back(piece.scan.directions[k]);
        }
        bits_.resize(words_ * directions_.size());
        find_open_rows(columns);
        for (std::size_t d = 0; d < directions_.size(); ++d) add_caps(directions_[d], mutable_set(d));
    }

    // The base's up first, then the possible ones but up, in their order.
    const std::vector<Vec3>& directions() const { return directions_; }
    std::size_t rows() const { return rows_; }
    std::size_t words() const { return words_; }
    std::span<const Word> set(std::size_t direction) const {
        return std::span(bits_).subspan(direction * words_, words_);
    }
    std::vector<Word> united(std::span<const std::size_t> directions) const {
        std::vector<Word> all(words_);
        for (const std::size_t d : directions) add_bits(all, set(d));
        return all;
    }

    // mm2 of a set without what is covered already.
    double gain(std::span<const Word> set, std::span<const Word> covered) const {
        std::size_t count = 0;
        for (std::size_t w = 0; w < row_words_; ++w) {
            count += static_cast<std::size_t>(std::popcount(set[w] & ~covered[w]));
        }
        const double on_caps =
            caps_area([&](std::size_t c) { return has_bit(set, cap_bit(c)) && !has_bit(covered, cap_bit(c)); });
        return piece_.scan.samples.area_each_mm2 * static_cast<double>(count) + on_caps;
    }
    // The caps that count and are not in the set: steep to one of the directions, or turned away from all.
    UnreachableArea caps_left(std::span<const Word> covered, std::span<const Vec3> directions) const {
        const auto is_left = [&](std::size_t c) {
            return counts_as_surface(piece_.caps[c], base_) && !has_bit(covered, cap_bit(c));
        };
        UnreachableArea left;
        left.caps_mm2 = caps_area(is_left);
        left.steep_mm2 =
            caps_area([&](std::size_t c) { return is_left(c) && is_steep(piece_.caps[c].outward, directions); });
        left.caps_mm2 -= left.steep_mm2;
        return left;
    }
    // Like a sample, a cap is not reached by a direction that it is steep to.
    void add_caps(Vec3 direction, std::span<Word> set) const {
        for (std::size_t c = 0; c < piece_.caps.size(); ++c) {
            const bool faces = dot(piece_.caps[c].outward, direction) >= min_facing;
            if (faces && counts_as_surface(piece_.caps[c], base_)) set_bit(set, cap_bit(c));
        }
    }

 private:
    std::span<Word> mutable_set(std::size_t direction) { return std::span(bits_).subspan(direction * words_, words_); }
    std::size_t cap_bit(std::size_t cap) const { return row_words_ * word_bits + cap; }

    template <class Counts>
    double caps_area(const Counts& counts) const {
        double area = 0;
        for (std::size_t c = 0; c < piece_.caps.size(); ++c) area += counts(c) ? piece_.caps[c].area_mm2 : 0;
        return area;
    }

    // The table is read row by row; 64 rows give one word of every direction.
    void find_open_rows(std::span<const std::size_t> columns) {
        const UpColumn up(piece_.scan, piece_.accessibility, base_.up);
        parallel_ranges(0, row_words_, words_at_once, [&](std::size_t first, std::size_t end) {
            std::vector<Word> word(directions_.size());
            for (std::size_t w = first; w < end; ++w) {
                std::fill(word.begin(), word.end(), Word{0});
                for (std::size_t row = w * word_bits; row < std::min(rows_, (w + 1) * word_bits); ++row) {
                    const std::size_t bit = row % word_bits;
                    const std::span<const float> distance = piece_.accessibility.distances(row);
                    word[0] |= Word{up.is_open(row)} << bit;
                    for (std::size_t i = 0; i < columns.size(); ++i) {
                        word[i + 1] |= Word{distance[columns[i]] == open} << bit;
                    }
                }
                for (std::size_t d = 0; d < word.size(); ++d) bits_[d * words_ + w] = word[d];
            }
        });
    }

    const JudgedPiece& piece_;
    const TiltBase& base_;
    std::size_t rows_;
    std::size_t row_words_;
    std::size_t words_;
    std::vector<Vec3> directions_;
    std::vector<Word> bits_;
};

struct Gain {
    std::size_t direction = 0;
    double mm2 = 0;
};

// The direction with the largest gain, the first of several; without candidates the first one, and no gain.
Gain largest_gain(const ReachedSets& sets, std::span<const std::size_t> candidates, std::span<const Word> covered) {
    Gain best;
    for (const std::size_t d : candidates) {
        const double gain = sets.gain(sets.set(d), covered);
        if (gain > best.mm2) best = {d, gain};
    }
    return best;
}

// Each but the first in turn gives way to the one with which all reach most, if that is more.
void exchange(const ReachedSets& sets, std::span<const std::size_t> candidates, std::vector<std::size_t>& chosen) {
    for (std::size_t i = 1; i < chosen.size(); ++i) {
        std::vector<std::size_t> others = chosen;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        const std::vector<Word> covered = sets.united(others);
        const Gain best = largest_gain(sets, candidates, covered);
        if (best.mm2 > sets.gain(sets.set(chosen[i]), covered)) chosen[i] = best.direction;
    }
}

// Up, then the others ascending. An exchange pass follows every addition, not only the last one: so what fewer
// directions reach, more reach too.
std::vector<std::size_t> choose(const ReachedSets& sets, double min_mm2, std::size_t most) {
    std::vector<std::size_t> candidates;
    for (std::size_t d = 1; d < sets.directions().size(); ++d) candidates.push_back(d);
    std::vector<std::size_t> chosen{0};
    while (chosen.size() < most) {
        const Gain next = largest_gain(sets, candidates, sets.united(chosen));
        if (next.mm2 <= 0 || next.mm2 < min_mm2) break;
        chosen.push_back(next.direction);
        exchange(sets, candidates, chosen);
    }
    std::sort(chosen.begin() + 1, chosen.end());
    return chosen;
}

// The first, then always that of the others which adds most; without those that add nothing.
std::vector<Gain> by_gain(const ReachedSets& sets, std::span<const std::size_t> chosen) {
    std::vector<Word> covered(sets.words());
    Gain next{chosen.front(), sets.gain(sets.set(chosen.front()), covered)};
    std::vector<Gain> ordered;
    do {
        ordered.push_back(next);
        add_bits(covered, sets.set(next.direction));
        next = largest_gain(sets, chosen, covered);
    } while (next.mm2 > 0);
    return ordered;
}

// Samples that are not reached, and the dense directions along which each is open.
struct UnreachedRows {
    std::vector<std::size_t> row;  // ascending
    std::size_t words = 0;         // per row
    std::vector<Word> is_open;     // row by row, a bit per dense direction
    std::span<const Word> of(std::size_t i) const { return std::span(is_open).subspan(i * words, words); }
    bool opens_along_some(std::size_t i) const {
        const std::span<const Word> bits = of(i);
        return std::any_of(bits.begin(), bits.end(), [](Word w) { return w != 0; });
    }
};

UnreachedRows unreached_rows(const JudgedPiece& piece, std::span<const Word> covered, std::span<const Vec3> dense) {
    UnreachedRows result;
    for (std::size_t row = 0; row < piece.accessibility.sample.size(); ++row) {
        if (!has_bit(covered, row)) result.row.push_back(row);
    }
    result.words = words_for(dense.size());
    result.is_open.resize(result.words * result.row.size());
    if (result.is_open.empty()) return result;
    const PieceRays rays(piece.scan, piece.accessibility);
    parallel_ranges(0, result.row.size(), rows_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            const std::span<Word> bits = std::span(result.is_open).subspan(i * result.words, result.words);
            for (std::size_t d = 0; d < dense.size(); ++d) {
                if (rays.distance(result.row[i], dense[d]) == open) set_bit(bits, d);
            }
        }
    });
    return result;
}

// Samples that are not reached, counted.
struct Unreached {
    std::size_t hidden = 0;
    std::size_t steep = 0;
    void add(bool is_steep) { ++(is_steep ? steep : hidden); }
    UnreachableArea area(double each_mm2, const UnreachableArea& caps) const {
        return {each_mm2 * static_cast<double>(hidden), each_mm2 * static_cast<double>(steep) + caps.steep_mm2,
                caps.caps_mm2};
    }
};

// The dense direction that reaches most of what is unreached; the first of several. No gain if none reaches anything.
ChosenDirection best_further(const JudgedPiece& piece, const ReachedSets& sets, std::span<const Word> covered,
                             const UnreachedRows& unreached, std::span<const Vec3> dense) {
    std::vector<std::size_t> count(dense.size());
    for (std::size_t i = 0; i < unreached.row.size(); ++i) {
        const std::span<const Word> bits = unreached.of(i);
        for (std::size_t w = 0; w < bits.size(); ++w) {
            for (Word left = bits[w]; left != 0; left &= left - 1) {
                ++count[w * word_bits + static_cast<std::size_t>(std::countr_zero(left))];
            }
        }
    }
    ChosenDirection best;
    std::vector<Word> caps(sets.words());
    for (std::size_t d = 0; d < dense.size(); ++d) {
        std::fill(caps.begin(), caps.end(), Word{0});
        sets.add_caps(dense[d], caps);
        const double gain = piece.scan.samples.area_each_mm2 * static_cast<double>(count[d]) + sets.gain(caps, covered);
        if (gain > best.gained_mm2) best = {dense[d], gain};
    }
    return best;
}

}  // namespace

ChosenDirections choose_directions(const JudgedPiece& piece, const TiltBase& base,
                                   std::span<const std::uint32_t> possible, std::span<const Vec3> dense,
                                   const DirectionOptions& options) {
    assert(options.max_directions >= 1);
    const ReachedSets sets(piece, base, possible);
    const double min_mm2 = options.min_gain * piece.surface_mm2(base);

    ChosenDirections result;
    std::vector<Vec3> chosen;
    std::vector<Word> by_chosen(sets.words());
    for (const Gain& g : by_gain(sets, choose(sets, min_mm2, options.max_directions))) {
        chosen.push_back(sets.directions()[g.direction]);
        result.chosen.push_back({chosen.back(), g.mm2});
        add_bits(by_chosen, sets.set(g.direction));
    }
    std::vector<Word> by_all(sets.words());
    for (std::size_t d = 0; d < sets.directions().size(); ++d) add_bits(by_all, sets.set(d));

    const UnreachedRows unreached = unreached_rows(piece, by_chosen, dense);
    result.samples.assign(sets.rows(), SampleAccess::reached);
    Unreached of_chosen;
    Unreached of_all;
    for (std::size_t i = 0; i < unreached.row.size(); ++i) {
        const std::size_t row = unreached.row[i];
        const Vec3 normal = piece.sample(row).normal;
        const bool is_steep_to_chosen = is_steep(normal, chosen);
        result.samples[row] = is_steep_to_chosen ? SampleAccess::steep : SampleAccess::hidden;
        of_chosen.add(is_steep_to_chosen);
        if (!has_bit(by_all, row) && !unreached.opens_along_some(i)) of_all.add(is_steep(normal, sets.directions()));
    }
    const double each = piece.scan.samples.area_each_mm2;
    result.by_chosen = of_chosen.area(each, sets.caps_left(by_chosen, chosen));
    for (const Vec3& d : dense) sets.add_caps(d, by_all);
    result.by_all = of_all.area(each, sets.caps_left(by_all, sets.directions()));
    const ChosenDirection further = best_further(piece, sets, by_chosen, unreached, dense);
    if (further.gained_mm2 > 0 && further.gained_mm2 >= min_mm2) result.further = further;
    return result;
}

}  // namespace qchopper
