// One stream of bytes to the simulated cell, cut into frames in two ways. Used by fuzz_stream.cpp and link_fuzz.cpp.

#pragma once

#include <cstdint>
#include <functional>
#include <span>

namespace qchopper {

// Passes `bytes` to a new cell as they are, and again in the pieces whose sizes `piece` gives (at least 1). Stops the
// program (demand.h) unless both give the same answers and end at the same frame, every answer is well formed, and the
// buffer never has to hold more than it may. Returns how many requests were answered.
std::size_t check_stream(std::span<const std::uint8_t> bytes, const std::function<std::size_t()>& piece);

}  // namespace qchopper
