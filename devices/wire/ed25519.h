// Signatures by Ed25519 (RFC 8032), by OpenSSL, and keys as PEM text.
//
// A signature of one key over one text is always the same 64 bytes. Every changed bit of text, signature or key makes
// it wrong (tests/devices/wire/ed25519_test.cpp). Functions throw std::runtime_error if OpenSSL fails in itself.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

struct evp_pkey_st;  // of OpenSSL

namespace qchopper {

struct Ed25519PublicKey {
    std::array<std::uint8_t, 32> bytes{};
    bool operator==(const Ed25519PublicKey&) const = default;
};

struct Ed25519Signature {
    std::array<std::uint8_t, 64> bytes{};
    bool operator==(const Ed25519Signature&) const = default;
};

// Copies share one key, whose memory is wiped with the last of them.
class Ed25519PrivateKey {
 public:
    static Ed25519PrivateKey make();  // random, from the operating system
    explicit Ed25519PrivateKey(std::span<const std::uint8_t, 32> secret);
    // Precondition: the key of OpenSSL is an Ed25519 key with its private half.
    explicit Ed25519PrivateKey(std::shared_ptr<evp_pkey_st> key);

    const Ed25519PublicKey& public_key() const { return public_key_; }
    Ed25519Signature sign(std::span<const std::uint8_t> bytes) const;
    evp_pkey_st* get() const { return key_.get(); }

 private:
    std::shared_ptr<evp_pkey_st> key_;
    Ed25519PublicKey public_key_;
};

bool is_signed_by(const Ed25519PublicKey& key, std::span<const std::uint8_t> bytes, const Ed25519Signature& signature);

// --- PEM (RFC 7468) --------------------------------------------------------------------------------------------------

// PKCS#8; encrypted by AES-256-CBC under scrypt (RFC 7914: N 16384, r 8, p 5) unless the passphrase is empty.
std::string to_pem(const Ed25519PrivateKey& key, std::string_view passphrase);
std::string to_pem(const Ed25519PublicKey& key);

enum class PemFault {
    none,
    no_pem,           // no PEM text, or one that is cut off or damaged
    other_kind,       // a key of another kind, a certificate
    wrong_passphrase  // or a damaged encrypted part: the two cannot be told apart
};

template <class Key>
struct PemResult {
    PemFault fault = PemFault::none;
    std::optional<Key> key;  // with fault `none`
};

bool is_encrypted_pem(std::string_view pem);
// The first private key, or the first public key, of the text.
PemResult<Ed25519PrivateKey> private_key_from_pem(std::string_view pem, std::string_view passphrase);
PemResult<Ed25519PublicKey> public_key_from_pem(std::string_view pem);

}  // namespace qchopper
