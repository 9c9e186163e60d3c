// Test vectors of RFC 8032, section 7.1, and what a changed bit does.

#include "devices/wire/ed25519.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/hex.h"

namespace qchopper {
namespace {

struct Vector {
    const char* secret;
    const char* public_key;
    const char* text;
    const char* signature;
};
constexpr Vector vectors[] = {
    {"9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60",
     "d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a", "",
     "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e39701cf9b46bd25bf5f0595bbe246"
     "55141438e7a100b"},
    {"4ccd089b28ff96da9db6c346ec114e0f5b8a319f35aba624da8cf6ed4fb8a6fb",
     "3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c", "72",
     "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996e458f3613d0f11d8c387b2eaeb4302aeeb"
     "00d291612bb0c00"}};

std::vector<std::uint8_t> bytes_of(std::string_view digits) {
    std::vector<std::uint8_t> bytes(digits.size() / 2);
    EXPECT_TRUE(read_hex(digits, bytes));
    return bytes;
}

TEST(Ed25519, SignsTheVectorsOfTheStandard) {
    for (const Vector& vector : vectors) {
        const Ed25519PrivateKey key(*from_hex<32>(vector.secret));
        EXPECT_EQ(to_hex(key.public_key().bytes), vector.public_key);
        const Ed25519Signature signature = key.sign(bytes_of(vector.text));
        EXPECT_EQ(to_hex(signature.bytes), vector.signature);
        EXPECT_TRUE(is_signed_by(key.public_key(), bytes_of(vector.text), signature));
    }
}

TEST(Ed25519, EveryChangedBitOfTextOrSignatureIsFound) {
    const Ed25519PrivateKey key = Ed25519PrivateKey::make();
    std::vector<std::uint8_t> text{1, 2, 3, 4, 5, 6, 7, 8};
    const Ed25519Signature signature = key.sign(text);
    for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
        text[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
        EXPECT_FALSE(is_signed_by(key.public_key(), text, signature)) << bit;
        text[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    }
    for (std::size_t bit = 0; bit < 512; ++bit) {
        Ed25519Signature other = signature;
        other.bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
        EXPECT_FALSE(is_signed_by(key.public_key(), text, other)) << bit;
    }
    EXPECT_FALSE(is_signed_by(Ed25519PrivateKey::make().public_key(), text, signature));
    EXPECT_TRUE(is_signed_by(key.public_key(), text, signature));
}

TEST(Ed25519, AKeyComesBackFromPemWithItsPassphraseOnly) {
    const Ed25519PrivateKey key = Ed25519PrivateKey::make();
    const std::string pem = to_pem(key, "correct horse");
    EXPECT_TRUE(is_encrypted_pem(pem));
    const auto opened = private_key_from_pem(pem, "correct horse");
    ASSERT_TRUE(opened.key);
    EXPECT_EQ(opened.key->public_key(), key.public_key());
    EXPECT_EQ(private_key_from_pem(pem, "correct Horse").fault, PemFault::wrong_passphrase);
    EXPECT_EQ(private_key_from_pem(pem, "").fault, PemFault::wrong_passphrase);
}

TEST(Ed25519, PemThatIsCutOrOfAnotherKindIsRefused) {
    const Ed25519PrivateKey key = Ed25519PrivateKey::make();
    const std::string plain = to_pem(key, "");
    EXPECT_FALSE(is_encrypted_pem(plain));
    ASSERT_TRUE(private_key_from_pem(plain, "").key);
    for (std::size_t size = 0; size + 1 < plain.size(); ++size) {
        EXPECT_NE(private_key_from_pem(plain.substr(0, size), "").fault, PemFault::none) << size;
    }
    const std::string shown = to_pem(key.public_key());
    ASSERT_TRUE(public_key_from_pem(shown).key);
    EXPECT_EQ(*public_key_from_pem(shown).key, key.public_key());
    EXPECT_EQ(private_key_from_pem(shown, "").fault, PemFault::other_kind);
    EXPECT_EQ(public_key_from_pem(plain).fault, PemFault::other_kind);
    EXPECT_EQ(public_key_from_pem("no key at all").fault, PemFault::no_pem);
    // An X25519 key, made by: openssl genpkey -algorithm x25519
    EXPECT_EQ(private_key_from_pem("-----BEGIN PRIVATE KEY-----\n"
                                   "MC4CAQAwBQYDK2VuBCIEIHcHbQpzGKV9PBbBclGyZkXfTC+H68CZKrF3+6UduSwq\n"
                                   "-----END PRIVATE KEY-----\n",
                                   "")
                  .fault,
              PemFault::other_kind);
}

}  // namespace
}  // namespace qchopper
