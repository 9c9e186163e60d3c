#include "base/files/file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>

#include "base/error.h"
#include "base/sha256.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct Files : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("files" + std::to_string(::getpid()));
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
    InputFault fault_of(auto&& action) {
        try {
            action();
        } catch (const InputError& e) {
            return e.fault;
        }
        ADD_FAILURE() << "no error";
        return InputFault::use;
    }
};

TEST_F(Files, WhatIsWrittenIsRead) {
    const Bytes bytes{0, 1, 2, 255, 0, 7};
    write_file(folder / "a", bytes);
    EXPECT_EQ(read_file(folder / "a"), bytes);
    write_file(folder / "a", std::string_view("x"));
    EXPECT_EQ(read_file(folder / "a"), Bytes{'x'});
}

TEST_F(Files, NothingIsLeftAside) {
    write_file(folder / "a", std::string_view("x"));
    fs::create_directory(folder / "b");
    EXPECT_EQ(fault_of([&] { write_file(folder / "b", std::string_view("x")); }), InputFault::create);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 2);
}

TEST_F(Files, AMissingFileAndAFolderAreNamed) {
    EXPECT_EQ(fault_of([&] { read_file(folder / "nothing"); }), InputFault::missing);
    EXPECT_EQ(fault_of([&] { read_file(folder); }), InputFault::missing);
    EXPECT_EQ(fault_of([&] { write_file(folder / "no" / "a", std::string_view("x")); }), InputFault::create);
}

// A pipe without a writer would block for ever, and so would this test.
TEST_F(Files, OnlyRegularFilesAreRead) {
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(fault_of([&] { read_file(folder / "pipe"); }), InputFault::missing);
    EXPECT_EQ(fault_of([&] { check_regular_file(folder / "pipe"); }), InputFault::missing);
    EXPECT_EQ(fault_of([&] { check_regular_file(folder); }), InputFault::missing);
    EXPECT_NO_THROW(check_regular_file(folder / "nothing"));
    fs::create_symlink("/dev/zero", folder / "zero");  // has no end
    EXPECT_EQ(fault_of([&] { read_file(folder / "zero"); }), InputFault::missing);
    fs::create_symlink("loop", folder / "loop");
    EXPECT_EQ(fault_of([&] { read_file(folder / "loop"); }), InputFault::missing);
    const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const fs::path old_place = fs::current_path();
    fs::current_path(folder);  // the name of a socket is short
    std::strcpy(address.sun_path, "socket");
    EXPECT_EQ(::bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    fs::current_path(old_place);
    EXPECT_EQ(fault_of([&] { read_file(folder / "socket"); }), InputFault::missing);
    ::close(fd);
    write_file(folder / "a", std::string_view("x"));
    fs::create_symlink("a", folder / "link");
    EXPECT_EQ(read_file(folder / "link"), Bytes{'x'}) << "a link to a regular file is one";
}

TEST_F(Files, TooLargeAFileIsRefusedUnread) {
    write_file(folder / "a", Bytes(100, 'x'));
    EXPECT_EQ(read_file(folder / "a", {100, InputFault::config}).size(), 100U);
    EXPECT_EQ(fault_of([&] { read_file(folder / "a", {99, InputFault::config}); }), InputFault::config);
    // A terabyte of nothing: reading it would need as much memory.
    ASSERT_EQ(::truncate((folder / "a").c_str(), off_t{1} << 40), 0);
    EXPECT_EQ(fault_of([&] { read_file(folder / "a"); }), InputFault::mesh);
    EXPECT_EQ(fault_of([&] {
                  read_file("/proc/self/maps", {10, InputFault::mesh});
              }),
              InputFault::mesh)
        << "has no size beforehand";
}

const std::string digest_of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

TEST(Sha256, GivesTheDigestOfTheStandardsExample) {  // FIPS 180-2, appendix B.1
    const std::string abc = "abc";
    EXPECT_EQ(to_hex(sha256({reinterpret_cast<const std::uint8_t*>(abc.data()), 3})), digest_of_abc);
}

TEST(Sha256, IsReadFromItsOwnDigitsOnly) {
    const std::optional<Sha256> digest = sha256_from_hex(digest_of_abc);
    ASSERT_TRUE(digest);
    EXPECT_EQ(to_hex(*digest), digest_of_abc);
    EXPECT_NE(*digest, Sha256{});
    EXPECT_EQ(sha256_from_hex(std::string(64, '0')), Sha256{});
    for (const std::string& bad :
         {std::string(), digest_of_abc.substr(1), digest_of_abc + "0", "g" + digest_of_abc.substr(1)}) {
        EXPECT_FALSE(sha256_from_hex(bad)) << bad;
    }
}

}  // namespace
}  // namespace qchopper
