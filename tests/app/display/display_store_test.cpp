#include "app/display/display_store.h"

#include <gtest/gtest.h>

#include "app/display/display_format.h"
#include "base/context.h"
#include "base/files/gzip.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct DisplayFiles : ::testing::Test {
    Folder folder;
    fs::path cache = folder.path / "cache";
    int made = 0;

    DisplayFile file_of(const std::string& content) {
        ++made;
        const Bytes bytes(content.begin(), content.end());
        return {display_id(bytes), 0.25, gzip(bytes)};
    }
    DisplayFile asked(const std::string& input, const std::string& content, DisplayKind kind = DisplayKind::mesh) {
        CacheWriter key;
        key.put(input);
        return kept_or_made(cache, kind, key, [&] { return file_of(content); });
    }
    std::vector<fs::path> files(const std::string& ending) const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(cache)) {
            if (entry.path().extension() == ending) found.push_back(entry.path());
        }
        return found;
    }
};

TEST_F(DisplayFiles, AreMadeOnceAndFoundByTheirId) {
    const DisplayFile first = asked("input", "content");
    EXPECT_EQ(asked("input", "content"), first);
    EXPECT_EQ(made, 1);
    EXPECT_EQ(kept_display(cache, DisplayKind::mesh, first.id), first.packed);
    EXPECT_FALSE(kept_display(cache, DisplayKind::states, first.id)) << "of another kind";
    EXPECT_EQ(asked("other input", "content"), first) << "two inputs may look the same";
    EXPECT_EQ(made, 2);
    EXPECT_EQ(files(".mesh").size(), 1U);
}

TEST_F(DisplayFiles, DamagedOrRemovedTheyAreMadeAgain) {
    const DisplayFile first = asked("input", "content");
    for (const char* ending : {".mesh", ".display"}) {
        const fs::path file = files(ending).at(0);
        const Bytes whole = read_file(file);
        for (std::size_t at = 0; at < whole.size(); ++at) {
            Bytes damaged = whole;
            damaged[at] ^= 0x10;
            write_file(file, damaged);
            const int before = made;
            EXPECT_EQ(asked("input", "content"), first);
            EXPECT_EQ(made, before + 1) << ending << " " << at;
            EXPECT_EQ(read_file(file), whole);
        }
        fs::remove(file);
        EXPECT_EQ(asked("input", "content"), first);
    }
}

TEST_F(DisplayFiles, WhatIsNoIdFindsNothing) {
    const DisplayFile first = asked("input", "content");
    write_file(folder.path / "secret.mesh", read_file(files(".mesh").at(0)));
    const std::vector<std::string> others{"",
                                          "../secret",
                                          "secret",
                                          "/etc/passwd",
                                          "0",
                                          "zz",
                                          first.id + "0",
                                          "./" + first.id,
                                          std::string(32, '0'),
                                          std::string(32, '/'),
                                          std::string(64, 'a')};
    for (const std::string& id : others) {
        EXPECT_FALSE(kept_display(cache, DisplayKind::mesh, id)) << id;
    }
}

TEST_F(DisplayFiles, WithoutAFolderNothingIsKept) {
    cache.clear();
    asked("input", "content");
    asked("input", "content");
    EXPECT_EQ(made, 2);
    remove_oldest_display(cache, 0);
}

TEST_F(DisplayFiles, OnlySoManyAreKept) {
    for (int i = 0; i < 9; ++i) asked("input " + std::to_string(i), "content " + std::to_string(i));
    for (int i = 0; i < 9; ++i) asked("s" + std::to_string(i), std::to_string(i), DisplayKind::states);
    write_file(cache / "a.seams", Bytes{1});
    remove_oldest_display(cache, 4);
    EXPECT_EQ(files(".mesh").size(), 4U);
    EXPECT_EQ(files(".states").size(), 4U);
    EXPECT_EQ(files(".display").size(), 4U);
    EXPECT_EQ(files(".seams").size(), 1U);
    EXPECT_EQ(asked("input 0", "content 0").id.size(), 32U);
}

TEST_F(DisplayFiles, WhatCannotBeMadeIsNotKept) {
    CacheWriter key;
    EXPECT_THROW(kept_or_made(cache, DisplayKind::mesh, key, []() -> DisplayFile { throw Cancelled(); }), Cancelled);
    EXPECT_FALSE(fs::exists(cache));
}

}  // namespace
}  // namespace qchopper
