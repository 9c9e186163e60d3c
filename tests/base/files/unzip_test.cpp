#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "base/error.h"
#include "base/files/zip.h"

namespace qchopper {
namespace {

std::map<std::string, Bytes> some_files() {
    std::mt19937 random(1);
    Bytes noise(5000);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    return {{"b.txt", {'h', 'i'}}, {"a.bin", noise}, {"empty", {}}, {"zeros", Bytes(100000, 0)}};
}

std::string refusal(const Bytes& bytes) {
    try {
        unzip(bytes, "X.qjob");
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::mesh);
        return error.what();
    }
    return "taken";
}

// Every place where `what` stands in the bytes, written over by `with`.
Bytes replaced(Bytes bytes, const std::string& what, const std::string& with) {
    int places = 0;
    for (std::size_t i = 0; i + what.size() <= bytes.size(); ++i) {
        if (std::memcmp(&bytes[i], what.data(), what.size()) != 0) continue;
        std::memcpy(&bytes[i], with.data(), with.size());
        ++places;
    }
    EXPECT_GT(places, 0);
    return bytes;
}

TEST(Zip, ForthAndBackIsIdentity) {
    EXPECT_EQ(unzip(zip(some_files()), "X.qjob"), some_files());
}

TEST(Zip, EntriesAreSortedStoredAndUndated) {
    const Bytes bytes = zip(some_files());
    const std::string text(bytes.begin(), bytes.end());
    std::size_t last = 0;
    for (const auto& [name, content] : some_files()) {
        const std::size_t at = text.find(name);
        ASSERT_NE(at, std::string::npos);
        EXPECT_GT(at, last);
        last = at;
        const std::size_t header = at - 30;  // local file header: method at 8, time at 10, date at 12
        EXPECT_EQ(text.substr(header, 4), std::string("PK\x03\x04"));
        EXPECT_EQ(text.substr(header + 8, 6), std::string("\0\0\0\0\x21\0", 6)) << name;
    }
}

TEST(Zip, NamesThatLeadElsewhereAreRefused) {
    for (const char* name : {"../up", "/root", "a/b", ".hidden", "C:\\x", "with space", ""}) {
        auto files = some_files();
        files[name] = {1};
        EXPECT_NE(refusal(zip(files)), "taken") << name;
    }
}

TEST(Zip, ANameThatIsThereTwiceIsRefused) {
    const Bytes twice = replaced(zip({{"aaaa", {1}}, {"bbbb", {1}}}), "bbbb", "aaaa");
    EXPECT_NE(refusal(twice).find("not a whole job file"), std::string::npos);
}

TEST(Zip, CompressedEntriesAreRefusedUnread) {
    // Method 8 in the local header (at 8) and in the central one (at 10).
    const Bytes bytes = zip({{"a.txt", Bytes(100, 'x')}});
    Bytes deflated = bytes;
    const std::string text(bytes.begin(), bytes.end());
    deflated[text.find("PK\x03\x04") + 8] = 8;
    deflated[text.find("PK\x01\x02") + 10] = 8;
    EXPECT_NE(refusal(deflated).find("compressed"), std::string::npos);
}

TEST(Zip, ASizeThatIsALieIsRefused) {
    const Bytes bytes = zip({{"a.txt", Bytes(100, 'x')}});
    const std::string text(bytes.begin(), bytes.end());
    Bytes lying = bytes;
    for (const std::size_t at : {text.find("PK\x03\x04") + 18, text.find("PK\x03\x04") + 22,
                                 text.find("PK\x01\x02") + 20, text.find("PK\x01\x02") + 24}) {
        lying[at + 3] = 0x7f;  // 2 GB, compressed and not
    }
    EXPECT_NE(refusal(lying), "taken");
}

TEST(Zip, OnlyTheFormThatIsWrittenIsTaken) {
    const Bytes bytes = zip(some_files());
    const auto refused = [](const Bytes& other) {
        const std::string why = refusal(other);
        EXPECT_EQ(why.find("not a whole job file") == std::string::npos, why == "taken") << why;
        return why != "taken";
    };
    Bytes longer = bytes;
    longer.push_back(0);
    EXPECT_TRUE(refused(longer)) << "a byte after the end";
    Bytes before = bytes;
    before.insert(before.begin(), 0);
    EXPECT_TRUE(refused(before)) << "a byte before the beginning";
    Bytes commented = bytes;
    commented.at(commented.size() - 2) = 2;  // length of the comment, the last field
    commented.insert(commented.end(), {'h', 'i'});
    EXPECT_TRUE(refused(commented)) << "a comment";
    std::vector<ZipEntry> entries;
    const std::map<std::string, Bytes> files = some_files();
    for (const auto& [name, content] : files) entries.insert(entries.begin(), zip_entry(name, content));
    EXPECT_TRUE(refused(zip(entries))) << "not sorted";
    EXPECT_TRUE(refused(replaced(bytes, std::string("\0\0\x21\0", 4), std::string("\0\0\x22\0", 4)))) << "a date";
    EXPECT_FALSE(refused(bytes));
}

TEST(Zip, OtherBytesAreRefused) {
    EXPECT_NE(refusal({}), "taken");
    EXPECT_NE(refusal({'P', 'K'}), "taken");
    EXPECT_NE(refusal(Bytes(100000, 'P')), "taken");
    EXPECT_EQ(refusal(zip(std::map<std::string, Bytes>{{"a", {}}})), "taken");
}

TEST(Zip, DamagedBytesNeverEscape) {
    const Bytes bytes = zip({{"a.txt", Bytes(60, 'x')}, {"b.txt", Bytes(30, 'y')}, {"c", {}}});
    std::mt19937 random(9);
    for (int round = 0; round < 4000; ++round) {
        Bytes damaged = bytes;
        for (int k = 0; k <= round % 3; ++k) damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
        if (round % 5 == 0) damaged.resize(random() % damaged.size());
        try {
            std::size_t total = 0;
            for (const auto& [name, content] : unzip(damaged, "X.qjob")) total += content.size();
            EXPECT_LE(total, damaged.size());
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::mesh);
        }
    }
}

}  // namespace
}  // namespace qchopper
