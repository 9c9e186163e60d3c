// One cell has one journal, under whatever name of its address it was made.

#include "app/dispatch/state_folder.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>

#include "devices/wire/modbus_tcp.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct StateFolder : ::testing::Test {
    Folder folder;
    void SetUp() override { ::setenv("XDG_STATE_HOME", folder.path.c_str(), 1); }
    void TearDown() override { ::unsetenv("XDG_STATE_HOME"); }
    static void make(const JournalCell& cell, int age_s) {
        { Journal journal(journal_folder(cell), cell); }
        const auto at = fs::file_time_type::clock::now() - std::chrono::seconds(age_s);
        fs::last_write_time(journal_folder(cell) / "journal.sqlite", at);
    }
};

const JournalCell by_number{7, true, "127.0.0.1:15020"};
const JournalCell by_name{7, true, "localhost:15020"};

TEST_F(StateFolder, ARealCellIsNamedByItsIdAlone) {
    EXPECT_EQ(journal_cell(7, false, "127.0.0.1:15020"), (JournalCell{7, false, ""}));
}

TEST_F(StateFolder, AnAddressHasOneFormWhateverItsName) {
    EXPECT_EQ(numeric_addresses({"127.0.0.1", 15020}), std::vector<std::string>{"127.0.0.1:15020"});
    EXPECT_EQ(numeric_addresses({"0:0:0:0:0:0:0:1", 15020}), std::vector<std::string>{"[::1]:15020"});
    EXPECT_TRUE(numeric_addresses({"nothing.invalid", 15020}).empty());
}

TEST_F(StateFolder, AJournalUnderAnotherNameOfTheAddressIsFound) {
    EXPECT_EQ(journal_cell(7, true, "127.0.0.1:15020"), by_number) << "there is none yet";
    const std::vector<std::string> addresses = numeric_addresses({"localhost", 15020});
    if (std::find(addresses.begin(), addresses.end(), "127.0.0.1:15020") == addresses.end()) {
        GTEST_SKIP() << "skipped: localhost is not 127.0.0.1 here";
    }
    make(by_name, 100);
    EXPECT_EQ(journal_cell(7, true, "127.0.0.1:15020"), by_name);
    EXPECT_EQ(journal_cell(7, true, "127.0.0.1:15021").endpoint, "127.0.0.1:15021") << "of another port";
    EXPECT_EQ(journal_cell(8, true, "127.0.0.1:15020").cell_id, 8) << "of another id";
    EXPECT_EQ(journal_cell(7, true, "10.1.2.3:15020").endpoint, "10.1.2.3:15020") << "at another address";
    make(by_number, 50);
    EXPECT_EQ(journal_cell(7, true, "127.0.0.1:15020"), by_number) << "of two the one written last";
    make(by_number, 200);
    EXPECT_EQ(journal_cell(7, true, "127.0.0.1:15020"), by_name);
}

}  // namespace
}  // namespace qchopper
