// PEM by OpenSSL, in memory. The cost of an encrypted key is that of scrypt: 16 MB, and about a tenth of a second.

#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs12.h>
#include <openssl/x509.h>

#include <stdexcept>

#include "devices/wire/ed25519.h"

namespace qchopper {
namespace {

template <class T, auto free_it>
struct FreedBy {
    void operator()(T* it) const { free_it(it); }
};
using Bio = std::unique_ptr<BIO, FreedBy<BIO, BIO_free_all>>;
using Pkcs8 = std::unique_ptr<PKCS8_PRIV_KEY_INFO, FreedBy<PKCS8_PRIV_KEY_INFO, PKCS8_PRIV_KEY_INFO_free>>;
using EncryptedPkcs8 = std::unique_ptr<X509_SIG, FreedBy<X509_SIG, X509_SIG_free>>;

constexpr std::string_view encrypted_head = "-----BEGIN ENCRYPTED PRIVATE KEY-----";
constexpr std::string_view plain_head = "-----BEGIN PRIVATE KEY-----";
constexpr std::string_view public_head = "-----BEGIN PUBLIC KEY-----";

void demand(bool holds) {
    if (!holds) throw std::runtime_error("OpenSSL cannot write a key as PEM");
}

std::string text_of(const Bio& bio) {
    char* text = nullptr;
    const long size = BIO_get_mem_data(bio.get(), &text);
    return {text, static_cast<std::size_t>(size)};
}

// From the line `head` on; empty without it.
Bio at(std::string_view pem, std::string_view head) {
    const std::size_t place = pem.find(head);
    if (place == std::string_view::npos) return {};
    const std::string_view rest = pem.substr(place);
    return Bio(BIO_new_mem_buf(rest.data(), static_cast<int>(rest.size())));
}

// OpenSSL keeps a list of what failed; it is of no use here.
struct ErrorsDropped {
    ErrorsDropped() = default;
    ErrorsDropped(const ErrorsDropped&) = delete;
    ErrorsDropped& operator=(const ErrorsDropped&) = delete;
    ~ErrorsDropped() { ERR_clear_error(); }
};

// Of a text without the head that is wanted: whether it has another one that is whole.
PemFault fault_without(std::string_view pem) {
    const std::size_t head = pem.find("-----BEGIN ");
    const bool is_whole = head != std::string_view::npos && pem.find("-----\n", head + 1) != std::string_view::npos;
    return is_whole ? PemFault::other_kind : PemFault::no_pem;
}

PemResult<Ed25519PrivateKey> taken(const Pkcs8& info, PemFault if_none) {
    if (!info) return {if_none, {}};
    const std::shared_ptr<EVP_PKEY> key(EVP_PKCS82PKEY(info.get()), EVP_PKEY_free);
    if (!key) return {if_none, {}};
    if (EVP_PKEY_get_id(key.get()) != EVP_PKEY_ED25519) return {PemFault::other_kind, {}};
    return {PemFault::none, Ed25519PrivateKey(key)};
}

}  // namespace

std::string to_pem(const Ed25519PrivateKey& key, std::string_view passphrase) {
    const Bio bio(BIO_new(BIO_s_secmem()));
    const Pkcs8 info(EVP_PKEY2PKCS8(key.get()));
    demand(bio && info);
    if (passphrase.empty()) {
        demand(PEM_write_bio_PKCS8_PRIV_KEY_INFO(bio.get(), info.get()) == 1);
        return text_of(bio);
    }
    constexpr std::uint64_t n = 16384;
    constexpr std::uint64_t r = 8;
    constexpr std::uint64_t p = 5;
    X509_ALGOR* const method = PKCS5_pbe2_set_scrypt(EVP_aes_256_cbc(), nullptr, 0, nullptr, n, r, p);
    demand(method != nullptr);
    const EncryptedPkcs8 encrypted(
        PKCS8_set0_pbe(passphrase.data(), static_cast<int>(passphrase.size()), info.get(), method));
    demand(encrypted && PEM_write_bio_PKCS8(bio.get(), encrypted.get()) == 1);
    return text_of(bio);
}

std::string to_pem(const Ed25519PublicKey& key) {
    const Bio bio(BIO_new(BIO_s_mem()));
    const std::shared_ptr<EVP_PKEY> given(
        EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr, key.bytes.data(), key.bytes.size()), EVP_PKEY_free);
    demand(bio && given && PEM_write_bio_PUBKEY(bio.get(), given.get()) == 1);
    return text_of(bio);
}

bool is_encrypted_pem(std::string_view pem) {
    return pem.find(encrypted_head) != std::string_view::npos;
}

PemResult<Ed25519PrivateKey> private_key_from_pem(std::string_view pem, std::string_view passphrase) {
    const ErrorsDropped dropped;
    if (const Bio plain = at(pem, plain_head)) {
        return taken(Pkcs8(PEM_read_bio_PKCS8_PRIV_KEY_INFO(plain.get(), nullptr, nullptr, nullptr)), PemFault::no_pem);
    }
    const Bio hidden = at(pem, encrypted_head);
    if (!hidden) return {fault_without(pem), {}};
    const EncryptedPkcs8 encrypted(PEM_read_bio_PKCS8(hidden.get(), nullptr, nullptr, nullptr));
    if (!encrypted) return {PemFault::no_pem, {}};
    return taken(Pkcs8(PKCS8_decrypt(encrypted.get(), passphrase.data(), static_cast<int>(passphrase.size()))),
                 PemFault::wrong_passphrase);
}

PemResult<Ed25519PublicKey> public_key_from_pem(std::string_view pem) {
    const ErrorsDropped dropped;
    const Bio bio = at(pem, public_head);
    if (!bio) return {fault_without(pem), {}};
    const std::shared_ptr<EVP_PKEY> key(PEM_read_bio_PUBKEY(bio.get(), nullptr, nullptr, nullptr), EVP_PKEY_free);
    if (!key) return {PemFault::no_pem, {}};
    if (EVP_PKEY_get_id(key.get()) != EVP_PKEY_ED25519) return {PemFault::other_kind, {}};
    Ed25519PublicKey found;
    std::size_t size = found.bytes.size();
    demand(EVP_PKEY_get_raw_public_key(key.get(), found.bytes.data(), &size) == 1);
    return {PemFault::none, found};
}

}  // namespace qchopper
