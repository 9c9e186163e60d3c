#include "base/files/zip.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <stdexcept>

namespace qchopper {
namespace {

ZipEntry text_in_stretches(const std::string& name, int stretches, bool is_packed) {
    const auto open = [stretches]() -> NextStretch {
        return [left = stretches](std::string& stretch) mutable {
            if (left-- > 0) stretch = "line " + std::to_string(left) + "\n";
        };
    };
    return {name, open, is_packed};
}

std::string all_of(const ZipEntry& entry) {
    std::string all;
    const NextStretch next = entry.open();
    for (std::string some; next(some), !some.empty(); some.clear()) all += some;
    return all;
}

std::uint32_t number_at(const Bytes& bytes, std::size_t at) {
    return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

// What the only entry of an archive holds, by the sizes of its local header.
std::string only_entry(const Bytes& bytes) {
    const std::size_t begin = 30 + bytes[26] + bytes[28];
    const std::uint32_t packed = number_at(bytes, 18);
    const std::uint32_t size = number_at(bytes, 22);
    if (bytes[8] == 0)
        return {bytes.begin() + static_cast<long>(begin), bytes.begin() + static_cast<long>(begin + size)};
    std::string text(size, '\0');
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, -MAX_WBITS), Z_OK);
    stream.next_in = const_cast<Bytef*>(bytes.data() + begin);
    stream.avail_in = packed;
    stream.next_out = reinterpret_cast<Bytef*>(text.data());
    stream.avail_out = size;
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    inflateEnd(&stream);
    return text;
}

TEST(ZipFile, StretchesComeBackAsOneEntryStoredOrPacked) {
    for (const int stretches : {0, 1, 2, 30000}) {
        for (const bool is_packed : {false, true}) {
            const ZipEntry entry = text_in_stretches("a.txt", stretches, is_packed);
            EXPECT_EQ(only_entry(zip({entry})), all_of(entry)) << stretches << is_packed;
        }
    }
}

TEST(ZipFile, PackedTextIsSmallerAndTheSameEveryTime) {
    const ZipEntry entry = text_in_stretches("a.txt", 30000, true);
    const Bytes once = zip({entry});
    EXPECT_LT(once.size(), all_of(entry).size() / 3);
    EXPECT_EQ(zip({entry}), once);
}

TEST(ZipFile, FilesThatAreGivenAwayArePackedAlikeAndReleased) {
    std::map<std::string, Bytes> files{{"a.bin", Bytes(200'000, 7)}, {"b.bin", {}}, {"c.bin", {1, 2, 3}}};
    const Bytes kept = zip(files);
    EXPECT_EQ(zip(std::move(files)), kept);
    for (const auto& [name, bytes] : files) EXPECT_EQ(bytes.capacity(), 0U) << name;  // NOLINT(bugprone-use-after-move)
}

TEST(ZipFile, EntriesKeepTheirOrder) {
    const Bytes b{'b'};
    const Bytes a{'a'};
    const Bytes bytes = zip(std::vector<ZipEntry>{zip_entry("second.txt", b), zip_entry("first.txt", a)});
    const std::string text(bytes.begin(), bytes.end());
    EXPECT_LT(text.find("second.txt"), text.find("first.txt"));
}

TEST(ZipFile, WhatAnEntryThrowsComesOutAndNothingElse) {
    int opened = 0;
    const ZipEntry entry{"a",
                         [&opened]() -> NextStretch {
                             if (++opened > 1) throw std::runtime_error("no more");
                             return [](std::string&) {};
                         },
                         true};
    EXPECT_THROW(zip({entry}), std::runtime_error);
}

}  // namespace
}  // namespace qchopper
