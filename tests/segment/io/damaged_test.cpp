// No bytes from outside may do more than be refused: no crash, no hang, no index out of range.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "segment/io/read_mesh.h"
#include "segment/mesh/measure.h"
#include "tests/segment/io/encodings.h"
#include "tests/segment/io/help.h"

namespace qchopper {
namespace {

// A mesh that was accepted is one that everybody can use.
void expect_sound(const RawMesh& scan) {
    ASSERT_FALSE(scan.mesh.triangles.empty());
    for (const Vec3& p : scan.mesh.points) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    for (const Triangle& t : scan.mesh.triangles) {
        for (const std::uint32_t corner : t) ASSERT_LT(corner, scan.mesh.points.size());
    }
    ASSERT_TRUE(scan.mesh.cap_of.empty() || scan.mesh.cap_of.size() == scan.mesh.triangles.size());
}

// Whether it was read.
bool expect_sound_or_refused(const Bytes& bytes) {
    try {
        expect_sound(parse_mesh(bytes, "damaged"));
        return true;
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::mesh) << error.what();
        return false;
    }
}

TEST(Damaged, EveryFileIsReadWhole) {
    for (const Encoded& file : encodings()) {
        const RawMesh scan = parse_mesh(file.bytes, file.reader + " " + file.name);
        EXPECT_EQ(scan.mesh.triangles.size(), 12U) << file.name;
        const double expected = file.name == "turned" ? 12 : file.name == "binary" && file.reader == "gltf" ? 6e-9 : 6;
        EXPECT_NEAR(volume_mm3(scan.mesh), expected, 1e-6 * expected) << file.reader << " " << file.name;
    }
}

TEST(Damaged, EveryPrefixIsRefused) {
    for (const Encoded& file : encodings()) {
        for (std::size_t size = 0; size < file.bytes.size(); ++size) {
            const Bytes prefix(file.bytes.begin(), file.bytes.begin() + static_cast<std::ptrdiff_t>(size));
            SCOPED_TRACE(file.reader + " " + file.name + " cut at " + std::to_string(size));
            if (file.bytes.size() - size > file.may_miss) {
                EXPECT_FALSE(refusal([&] { parse_mesh(prefix, "cut"); }).empty());
            } else {
                expect_sound_or_refused(prefix);
            }
        }
    }
}

TEST(Damaged, RandomBytesAreRefusedOrReadSoundly) {
    std::mt19937 random(11);
    const std::vector<Encoded> files = encodings();
    std::vector<std::size_t> accepted(files.size());
    constexpr std::size_t rounds = 3000;
    for (std::size_t i = 0; i < rounds * files.size(); ++i) {
        Bytes bytes = files[i % files.size()].bytes;
        for (std::uint32_t flips = 1 + random() % 4; flips > 0; --flips) {
            bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
        }
        accepted[i % files.size()] += expect_sound_or_refused(bytes);
    }
    for (std::size_t f = 0; f < files.size(); ++f) {
        EXPECT_LT(accepted[f], rounds) << files[f].reader << " " << files[f].name;
    }
    EXPECT_GT(std::accumulate(accepted.begin(), accepted.end(), std::size_t{0}), 5000U);
}

// Lines and tags left out, repeated and put elsewhere: damage that keeps its form.
TEST(Damaged, ShuffledStretchesAreRefusedOrReadSoundly) {
    std::mt19937 random(13);
    for (const Encoded& file : encodings()) {
        for (int i = 0; i < 1000; ++i) {
            Bytes bytes = file.bytes;
            const auto from = static_cast<std::ptrdiff_t>(random() % bytes.size());
            const auto size = std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(random() % 60),
                                                       static_cast<std::ptrdiff_t>(bytes.size()) - from);
            const Bytes stretch(bytes.begin() + from, bytes.begin() + from + size);
            if (random() % 2 == 0) bytes.erase(bytes.begin() + from, bytes.begin() + from + size);
            const auto to = static_cast<std::ptrdiff_t>(random() % (bytes.size() + 1));
            if (random() % 2 == 0) bytes.insert(bytes.begin() + to, stretch.begin(), stretch.end());
            SCOPED_TRACE(file.reader + " " + file.name + " " + std::to_string(i));
            expect_sound_or_refused(bytes);
        }
    }
}

// What fuzzers have found (docs/developer/fuzzing.md), each cut down to the kind of it.
struct Found {
    const char* kind;
    std::string bytes;
};

TEST(Damaged, WhatFuzzersFoundStaysMended) {
    const std::string ply = "ply\nformat ascii 1.0\n";
    const Found all[] = {
        {"points without any property are no points, yet faces named them",
         ply + "element face 1\nproperty list uchar int vertex_indices\nelement vertex 8\nend_header\n3 0 1 7\n"},
        {"the same with the points before the faces, and a face that has to be split where they lie",
         ply + "element vertex 8\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n4 0 1 2 7\n"},
    };
    for (const Found& found : all) {
        SCOPED_TRACE(found.kind);
        EXPECT_FALSE(expect_sound_or_refused(bytes_of(found.bytes)));
    }
}

TEST(Damaged, NoiseIsRefused) {
    std::mt19937 random(12);
    for (int i = 0; i < 2000; ++i) {
        Bytes bytes(random() % 400);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
        EXPECT_FALSE(refusal([&] { parse_mesh(bytes, "noise"); }).empty());
    }
}

}  // namespace
}  // namespace qchopper
