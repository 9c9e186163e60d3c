#include "segment/files/file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "segment/error.h"
#include "segment/files/sha256.h"

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

TEST(Sha256, KnowsTheStandardsExample) {  // FIPS 180-2, appendix B.1
    const std::string abc = "abc";
    EXPECT_EQ(to_hex(sha256({reinterpret_cast<const std::uint8_t*>(abc.data()), 3})),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace qchopper
