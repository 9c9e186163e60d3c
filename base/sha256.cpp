// Wraps OpenSSL. O(bytes).

#include "base/sha256.h"

#include <openssl/sha.h>

namespace qchopper {

Sha256 sha256(std::span<const std::uint8_t> bytes) {
    Sha256 digest;
    SHA256(bytes.data(), bytes.size(), digest.bytes.data());
    return digest;
}

std::string to_hex(const Sha256& digest) {
    return to_hex(digest.bytes);
}

std::optional<Sha256> sha256_from_hex(std::string_view digits) {
    Sha256 digest;
    if (!read_hex(digits, digest.bytes)) return std::nullopt;
    return digest;
}

}  // namespace qchopper
