#include "base/sha256.h"

#include <openssl/sha.h>

namespace qchopper {

Sha256 sha256(std::span<const std::uint8_t> bytes) {
    Sha256 digest{};
    SHA256(bytes.data(), bytes.size(), digest.data());
    return digest;
}

}  // namespace qchopper
