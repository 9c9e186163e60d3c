#include "base/files/gzip.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

namespace qchopper {
namespace {

// zlib's own reader.
Bytes unpacked(const Bytes& packed, std::size_t size) {
    Bytes bytes(size + 1);
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
    stream.next_in = const_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = bytes.data();
    stream.avail_out = static_cast<uInt>(bytes.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    EXPECT_EQ(stream.avail_in, 0);
    bytes.resize(stream.total_out);
    inflateEnd(&stream);
    return bytes;
}

TEST(Gzip, WhatIsPackedUnpacksToTheSame) {
    std::mt19937 random(7);
    for (const std::size_t size : {0, 1, 2, 1000, 70'000, 3'000'000}) {
        for (const unsigned kinds : {1U, 4U, 256U}) {
            Bytes bytes(size);
            for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % kinds);
            const Bytes packed = gzip(bytes);
            EXPECT_EQ(unpacked(packed, size), bytes) << size << " " << kinds;
            EXPECT_EQ(gzip(bytes), packed);
        }
    }
}

// RFC 1952, 2.3: mark, deflate, no flags, no time, no extra flags of a level, unknown system.
TEST(Gzip, TheHeadSaysNothingOfTimeAndSystem) {
    const Bytes packed = gzip(Bytes{1, 2, 3});
    EXPECT_EQ(Bytes(packed.begin(), packed.begin() + 10), (Bytes{0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 255}));
}

}  // namespace
}  // namespace qchopper
