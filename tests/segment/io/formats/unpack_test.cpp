// What a scan may be wrapped in: gzip, UTF-16, a byte order mark.

#include <gtest/gtest.h>

#include "segment/io/formats/unpack.h"
#include "segment/io/read_mesh.h"
#include "segment/io/write_mesh.h"
#include "tests/segment/io/help.h"
#include "tests/segment/io/wrappings.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Gunzip, GivesBackWhatWasPacked) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {20, 20, 20}, 40);
    for (const Bytes& bytes : {to_ply(box), to_stl(box), Bytes{}, Bytes{7}}) {
        EXPECT_EQ(gunzip(gzipped(bytes), "test"), bytes);
    }
    EXPECT_EQ(parse_mesh(gzipped(to_ply(box)), "test").mesh, box);
}

TEST(Gunzip, ReadsSeveralMembersAndPassesWhatFollowsThem) {
    Bytes two = gzipped(bytes_of("one "));
    const Bytes second = gzipped(bytes_of("two"));
    two.insert(two.end(), second.begin(), second.end());
    EXPECT_EQ(gunzip(two, "test"), bytes_of("one two"));
    two.insert(two.end(), 512, 0);
    EXPECT_EQ(gunzip(two, "test"), bytes_of("one two"));
}

TEST(Gunzip, RefusesEveryPrefixAndNeverGivesOtherBytes) {
    const Bytes packed = gzipped(to_stl(shapes::box({0, 0, 0}, {1, 2, 3})));
    for (std::size_t size = 3; size < packed.size(); ++size) {
        const Bytes prefix(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_NE(refusal([&] { gunzip(prefix, "cut"); }).find("gzip"), std::string::npos) << size;
    }
    const Bytes whole = gunzip(packed, "whole");
    std::size_t refused = 0;
    for (std::size_t at = 10; at < packed.size(); ++at) {  // before that, names and dates
        Bytes changed = packed;
        changed[at] ^= 0x10;
        try {
            EXPECT_EQ(gunzip(changed, "changed"), whole) << at;  // a code of the packing may be another for the same
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::mesh);
            ++refused;
        }
    }
    EXPECT_GT(refused, packed.size() * 9 / 10 - 10);
}

// 100 MiB of zeros take 100 kB; their own packing would take a few hundred bytes and unpack to all of them.
TEST(Gunzip, RefusesABombBeforeItGoesOff) {
    EXPECT_EQ(max_unpacked(1000), std::uint64_t{64} << 20);
    EXPECT_EQ(max_unpacked(std::uint64_t{1} << 20), std::uint64_t{200} << 20);
    EXPECT_EQ(max_unpacked(std::uint64_t{1} << 40), std::uint64_t{8192} << 20);
    const Bytes bomb = gzipped(Bytes(100 << 20));
    ASSERT_LT(bomb.size(), 200'000U);
    const std::string what = refusal([&] { gunzip(bomb, "bomb"); });
    EXPECT_NE(what.find("would become more than 64 MiB"), std::string::npos) << what;
    EXPECT_EQ(gunzip(gzipped(Bytes(60 << 20)), "large").size(), std::size_t{60} << 20);
}

TEST(Gunzip, SaysWhatItHoldsIfThatIsNoScan) {
    EXPECT_NE(refusal([&] { parse_mesh(gzipped(bytes_of("hello")), "a.gz"); }).find("does not begin like a PLY"),
              std::string::npos);
    EXPECT_NE(refusal([&] { parse_mesh(gzipped({}), "a.gz"); }).find("empty"), std::string::npos);
    // a packed file in a packed file is unpacked once
    const Bytes twice = gzipped(gzipped(to_stl(shapes::box({0, 0, 0}, {1, 2, 3}))));
    EXPECT_FALSE(refusal([&] { parse_mesh(twice, "a.gz.gz"); }).empty());
}

TEST(ToUtf8, EveryTextFormatMayComeAsUtf16) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 2, 3});
    const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (const std::string& text : {ascii_ply(box), ascii_stl(box), off, obj, gltf_of(box)}) {
        const TriangleMesh plain = parse_mesh(bytes_of(text), "plain").mesh;
        EXPECT_EQ(parse_mesh(utf16(text, true), "big").mesh, plain);
        EXPECT_EQ(parse_mesh(utf16(text, false), "little").mesh, plain);
        EXPECT_EQ(parse_mesh(bytes_of("\xef\xbb\xbf" + text), "marked").mesh, plain);
    }
}

TEST(ToUtf8, LeavesWhatHasNoMark) {
    EXPECT_FALSE(to_utf8(bytes_of("v 0 0 0")).has_value());
    EXPECT_FALSE(to_utf8({}).has_value());
    EXPECT_FALSE(to_utf8({0xff}).has_value());
    EXPECT_EQ(to_utf8({0xff, 0xfe}), Bytes{});
    EXPECT_EQ(to_utf8({0xfe, 0xff, 0, 'v', 1, 'v', 0}), bytes_of("v??"));
}

}  // namespace
}  // namespace qchopper
