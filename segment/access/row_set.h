// Sets of samples of a piece, by their rows: bit r % 64 of word r / 64.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace qchopper {

using Word = std::uint64_t;
constexpr std::size_t word_bits = 64;

inline std::size_t words_for(std::size_t bits) {
    return (bits + word_bits - 1) / word_bits;
}
inline bool has_bit(std::span<const Word> bits, std::size_t i) {
    return (bits[i / word_bits] >> (i % word_bits) & 1) != 0;
}
inline void set_bit(std::span<Word> bits, std::size_t i) {
    bits[i / word_bits] |= Word{1} << (i % word_bits);
}
inline void add_bits(std::span<Word> bits, std::span<const Word> others) {
    for (std::size_t w = 0; w < bits.size(); ++w) bits[w] |= others[w];
}

}  // namespace qchopper
