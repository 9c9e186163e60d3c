// Wraps the EVP functions of OpenSSL. O(bytes).

#include "devices/wire/ed25519.h"

#include <openssl/evp.h>

#include <cstddef>
#include <stdexcept>

namespace qchopper {
namespace {

using DigestContext = std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)>;

void demand(bool holds, const char* what) {
    if (!holds) throw std::runtime_error(std::string("OpenSSL cannot ") + what);
}

std::shared_ptr<EVP_PKEY> owned(EVP_PKEY* key, const char* what) {
    demand(key != nullptr, what);
    return {key, EVP_PKEY_free};
}

}  // namespace

Ed25519PrivateKey Ed25519PrivateKey::make() {
    return Ed25519PrivateKey(owned(EVP_PKEY_Q_keygen(nullptr, nullptr, "ED25519"), "make a key"));
}

Ed25519PrivateKey::Ed25519PrivateKey(std::span<const std::uint8_t, 32> secret)
    : Ed25519PrivateKey(owned(EVP_PKEY_new_raw_private_key(EVP_PKEY_ED25519, nullptr, secret.data(), secret.size()),
                              "take a private key")) {}

Ed25519PrivateKey::Ed25519PrivateKey(std::shared_ptr<evp_pkey_st> key) : key_(std::move(key)) {
    std::size_t size = public_key_.bytes.size();
    demand(EVP_PKEY_get_raw_public_key(key_.get(), public_key_.bytes.data(), &size) == 1, "give the public key");
}

Ed25519Signature Ed25519PrivateKey::sign(std::span<const std::uint8_t> bytes) const {
    const DigestContext context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    Ed25519Signature signature;
    std::size_t size = signature.bytes.size();
    demand(EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, key_.get()) == 1 &&
               EVP_DigestSign(context.get(), signature.bytes.data(), &size, bytes.data(), bytes.size()) == 1,
           "sign");
    return signature;
}

bool is_signed_by(const Ed25519PublicKey& key, std::span<const std::uint8_t> bytes, const Ed25519Signature& signature) {
    const std::shared_ptr<EVP_PKEY> given(
        EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr, key.bytes.data(), key.bytes.size()), EVP_PKEY_free);
    const DigestContext context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    demand(given && EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, given.get()) == 1, "verify");
    return EVP_DigestVerify(context.get(), signature.bytes.data(), signature.bytes.size(), bytes.data(),
                            bytes.size()) == 1;
}

}  // namespace qchopper
