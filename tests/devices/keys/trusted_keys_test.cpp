#include "devices/keys/trusted_keys.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "base/files/file.h"
#include "devices/wire/ticket_signature.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

Ed25519PublicKey new_key() {
    return Ed25519PrivateKey::make().public_key();
}

TEST(TrustedKeys, ComeBackFromTheirFile) {
    const Folder folder;
    const auto file = folder.path / "trusted.json";
    EXPECT_TRUE(read_trusted_keys(file).keys.empty());
    TrustedKeys list;
    trust(list, "anna", new_key(), 1000);
    trust(list, "otto", new_key(), 2000);
    revoke(list, "anna", 3000);
    write_trusted_keys(file, list);
    EXPECT_EQ(read_trusted_keys(file), list);
}

TEST(TrustedKeys, AreRevokedByNameOrId) {
    TrustedKeys list;
    const Ed25519PublicKey anna = new_key();
    const Ed25519PublicKey otto = new_key();
    trust(list, "anna", anna, 1000);
    trust(list, "otto", otto, 1000);
    EXPECT_EQ(revoke(list, "anna", 2000).revoked_ms, 2000U);
    EXPECT_EQ(revoke(list, key_id_text(key_id_of(otto)), 3000).name, "otto");
    EXPECT_EQ(revoke(list, "anna", 9000).revoked_ms, 2000U);
    EXPECT_THROW(revoke(list, "nobody", 1), InputError);
    ASSERT_NE(find_key(list, key_id_of(anna)), nullptr);
    EXPECT_EQ(find_key(list, key_id_of(anna))->name, "anna");
    EXPECT_EQ(find_key(list, key_id_of(new_key())), nullptr);
}

TEST(TrustedKeys, ARevokedKeyIsNeverTrustedAgain) {
    TrustedKeys list;
    const Ed25519PublicKey key = new_key();
    trust(list, "anna", key, 1000);
    trust(list, "again", key, 2000);  // trusted already
    ASSERT_EQ(list.keys.size(), 1U);
    revoke(list, "anna", 3000);
    EXPECT_THROW(trust(list, "anna", key, 4000), InputError);
    EXPECT_THROW(trust(list, "anna", new_key(), 4000), InputError);
}

TEST(TrustedKeys, AListThatIsCutOrChangedIsRefusedAndNotEmpty) {
    const Folder folder;
    const auto file = folder.path / "trusted.json";
    TrustedKeys list;
    trust(list, "anna", new_key(), 1000);
    const std::string text = to_json(list);
    for (std::size_t size = 0; size < text.size(); ++size) {
        std::ofstream(file, std::ios::binary) << text.substr(0, size);
        EXPECT_THROW(read_trusted_keys(file), InputError) << size;
    }
    const std::size_t digits = text.find("public_key\": \"") + 14;
    std::string changed = text;
    changed[digits] = changed[digits] == '0' ? '1' : '0';
    EXPECT_THROW(trusted_keys_from_json(changed, "it"), InputError);  // the id is another
}

}  // namespace
}  // namespace qchopper
