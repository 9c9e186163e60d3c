// A stream of bytes to the simulated cell, as it is and in pieces (stream_steps.h). The first byte chooses the pieces.

#include "tests/fuzz/stream_steps.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    std::uint32_t state = data[0] + 1U;
    qchopper::check_stream({data + 1, size - 1}, [&] {
        state = state * 1664525U + 1013904223U;
        return 1 + (state >> 24U) % 40;
    });
    return 0;
}
