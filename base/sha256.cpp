#include "base/sha256.h"

#include <openssl/sha.h>

namespace qchopper {

Sha256 sha256(std::span<const std::uint8_t> bytes) {
    Sha256 digest{};
    SHA256(bytes.data(), bytes.size(), digest.data());
    return digest;
}

std::string to_hex(const Sha256& digest) {
    constexpr const char* digits = "0123456789abcdef";
    std::string text;
    text.reserve(2 * digest.size());
    for (const std::uint8_t byte : digest) {
        text += digits[byte >> 4];
        text += digits[byte & 15];
    }
    return text;
}

}  // namespace qchopper
