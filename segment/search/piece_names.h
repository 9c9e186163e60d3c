// The names of pieces: A, B, ..., Z, AA, AB, ..., in the order in which pieces come to be.

#pragma once

#include <cstddef>
#include <string>

namespace qchopper {

// Bijective base 26, from 0.
std::string piece_name(std::size_t index);
bool is_piece_name(const std::string& name);
// The inverse of piece_name(). Precondition: is_piece_name(name).
std::size_t piece_index(const std::string& name);

}  // namespace qchopper
