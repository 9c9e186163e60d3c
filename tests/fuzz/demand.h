// Shared by all fuzzers: an input is accepted or refused by an InputError, and a condition that does not hold stops the
// program.

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "base/files/file.h"

namespace qchopper {

// libFuzzer reports an abort with its input.
inline void demand(bool holds) {
    if (!holds) std::abort();
}

// `work` returns, or throws an InputError of this kind with a text; anything else stops the fuzzer.
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

// Reads an input from its first byte on; after the end every byte is 0.
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
