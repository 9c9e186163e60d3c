// What all fuzzers share: an input that is not taken is refused by an InputError, and what must hold stops the program.

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "base/file.h"

namespace qchopper {

// Stopping is what a fuzzer notices.
inline void demand(bool holds) {
    if (!holds) std::abort();
}

// `work` ends, or throws InputError of this kind and in one line of text; anything else ends the fuzzer.
template <class Work>
void or_refused(InputFault fault, const Work& work) {
    try {
        work();
    } catch (const InputError& error) {
        demand(error.fault == fault);
        demand(!std::string(error.what()).empty());
    }
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

// The bytes of an input, taken from its front; behind the end everything is 0.
class Input {
 public:
    Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    bool is_empty() const { return size_ == 0; }
    std::uint8_t u8() {
        if (size_ == 0) return 0;
        --size_;
        return *data_++;
    }
    std::uint16_t u16() {
        const unsigned high = u8();
        return static_cast<std::uint16_t>(high << 8U | u8());
    }
    Bytes bytes(std::size_t count) {
        Bytes taken;
        while (taken.size() < count && size_ > 0) taken.push_back(u8());
        return taken;
    }

 private:
    const std::uint8_t* data_;
    std::size_t size_;
};

}  // namespace qchopper
