#include "devices/keys/private_key_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>

#include "base/error.h"
#include "base/files/file.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
    const Bytes bytes = read_file(file);
    return {bytes.begin(), bytes.end()};
}

void put(const fs::path& file, std::string_view text, mode_t mode = 0600) {
    std::ofstream(file, std::ios::binary) << text;
    ASSERT_EQ(::chmod(file.c_str(), mode), 0);
}

// The message with which the file is refused.
std::string refusal_of(const fs::path& file, InputFault fault = InputFault::config) {
    try {
        read_private_key(file);
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, fault);
        EXPECT_FALSE(error.to_do.empty());
        return error.what();
    }
    return "it was taken";
}

struct PrivateKeyFileTest : testing::Test {
    Folder folder;
    const fs::path file = folder.path / "anna.key";
    const Ed25519PrivateKey key = Ed25519PrivateKey::make();
};

TEST_F(PrivateKeyFileTest, ComesBackWithItsPassphraseAndIsReadableByItsOwnerOnly) {
    write_private_key(file, key, "correct horse");
    struct stat info {};
    ASSERT_EQ(::stat(file.c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 07777U, 0600U);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()), 1);
    const PrivateKeyFile found = read_private_key(file);
    EXPECT_TRUE(found.is_encrypted);
    EXPECT_EQ(found.public_key, key.public_key());
    const auto opened = open_private_key(found, "correct horse");
    ASSERT_TRUE(opened);
    EXPECT_EQ(opened->sign(Bytes{1, 2, 3}), key.sign(Bytes{1, 2, 3}));
}

TEST_F(PrivateKeyFileTest, AWrongPassphraseTakesASecond) {
    write_private_key(file, key, "correct horse");
    const PrivateKeyFile found = read_private_key(file);
    const auto began = std::chrono::steady_clock::now();
    EXPECT_FALSE(open_private_key(found, "incorrect horse"));
    EXPECT_GE(std::chrono::steady_clock::now() - began, std::chrono::seconds(1));
}

TEST_F(PrivateKeyFileTest, IsNeverReplaced) {
    write_private_key(file, key, "");
    const std::string before = text_of(file);
    EXPECT_THROW(write_private_key(file, Ed25519PrivateKey::make(), ""), InputError);
    EXPECT_EQ(text_of(file), before);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()), 1);
    const PrivateKeyFile found = read_private_key(file);
    EXPECT_FALSE(found.is_encrypted);
    EXPECT_TRUE(open_private_key(found, ""));
}

TEST_F(PrivateKeyFileTest, CutShortAnywhereItIsRefused) {
    for (const char* const passphrase : {"", "correct horse"}) {
        const fs::path whole = folder.path / (std::string("whole") + passphrase);
        write_private_key(whole, key, passphrase);
        const std::string text = text_of(whole);
        for (std::size_t size = 0; size + 1 < text.size(); ++size) {
            put(file, std::string_view(text).substr(0, size));
            const std::string why = refusal_of(file);
            EXPECT_NE(why.find(size == 0 ? "it is empty" : "cut short"), std::string::npos) << size << ": " << why;
        }
    }
}

TEST_F(PrivateKeyFileTest, ReadableByOthersItIsRefused) {
    write_private_key(file, key, "");
    const std::string text = text_of(file);
    for (const mode_t mode : {0640U, 0604U, 0620U, 0610U, 0601U}) {
        put(file, text, mode);
        EXPECT_NE(refusal_of(file).find("other users may have read it"), std::string::npos) << std::oct << mode;
    }
    put(file, text, 0400);
    EXPECT_EQ(refusal_of(file), "it was taken");
}

TEST_F(PrivateKeyFileTest, ALinkAFolderAndNothingAreRefused) {
    write_private_key(folder.path / "real", key, "");
    fs::create_symlink(folder.path / "real", file);
    EXPECT_NE(refusal_of(file).find("symbolic link"), std::string::npos);
    fs::create_directory(folder.path / "folder");
    EXPECT_NE(refusal_of(folder.path / "folder").find("no regular file"), std::string::npos);
    EXPECT_NE(refusal_of(folder.path / "nothing", InputFault::missing).find("cannot be opened"), std::string::npos);
}

TEST_F(PrivateKeyFileTest, AnotherKindOfFileIsRefused) {
    put(file, to_pem(key.public_key()));
    EXPECT_NE(refusal_of(file).find("another kind"), std::string::npos);
    put(file, "{\"format\": \"qchopper signature\"}");
    EXPECT_NE(refusal_of(file).find("cut short or damaged"), std::string::npos);
    put(file, std::string(20000, '-'));
    EXPECT_NE(refusal_of(file).find("larger than any key"), std::string::npos);
}

TEST_F(PrivateKeyFileTest, APrivateKeyBesideAnotherPublicKeyIsRefused) {
    put(file, to_pem(key, "") + to_pem(Ed25519PrivateKey::make().public_key()));
    const PrivateKeyFile found = read_private_key(file);
    EXPECT_THROW(open_private_key(found, ""), InputError);
}

}  // namespace
}  // namespace qchopper
