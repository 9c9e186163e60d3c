// No bytes from outside may do more than be refused: no crash, no hang, no index out of range.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "segment/intake/read_mesh.h"
#include "segment/intake/write_ply.h"
#include "segment/intake/write_stl.h"
#include "tests/segment/intake/help.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// The same as to_ply, in the other order.
Bytes big_endian_ply(const TriangleMesh& mesh) {
    const Bytes little = to_ply(mesh);
    std::string header(little.begin(), little.end());
    header.resize(header.find("end_header\n") + 11);
    std::size_t at = header.size();
    header.replace(header.find("little"), 6, "big");
    Bytes big(header.begin(), header.end());
    const auto copy_turned = [&](std::size_t size) {
        for (std::size_t i = size; i-- > 0;) big.push_back(little[at + i]);
        at += size;
    };
    for (std::size_t i = 0; i < 3 * mesh.points.size(); ++i) copy_turned(8);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        copy_turned(1);
        for (int i = 0; i < 3; ++i) copy_turned(4);
        if (!mesh.cap_of.empty()) copy_turned(4);
    }
    return big;
}

struct Encoded {
    std::string name;
    Bytes bytes;
    std::size_t may_miss = 0;  // so many bytes at the end mean nothing
};

std::vector<Encoded> encodings() {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {1, 2, 3});
    std::vector<Encoded> all{{"ply ascii", bytes_of(ascii_ply(mesh)), 1},
                             {"stl ascii", bytes_of(ascii_stl(mesh)), 6},
                             {"stl binary", to_stl(mesh)}};
    mesh.cap_of.assign(mesh.triangles.size(), 3);
    all.push_back({"ply little", to_ply(mesh)});
    all.push_back({"ply big", big_endian_ply(mesh)});
    return all;
}

// A mesh that was accepted is one that everybody can use.
void expect_sound(const RawMesh& scan) {
    ASSERT_FALSE(scan.mesh.triangles.empty());
    for (const Vec3& p : scan.mesh.points) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    for (const Triangle& t : scan.mesh.triangles) {
        for (const std::uint32_t corner : t) ASSERT_LT(corner, scan.mesh.points.size());
    }
    ASSERT_TRUE(scan.mesh.cap_of.empty() || scan.mesh.cap_of.size() == scan.mesh.triangles.size());
}

TEST(Damaged, EveryFileIsReadWhole) {
    for (const Encoded& file : encodings()) EXPECT_EQ(parse_mesh(file.bytes, file.name).mesh.triangles.size(), 12U);
}

TEST(Damaged, EveryPrefixIsRefused) {
    for (const Encoded& file : encodings()) {
        for (std::size_t size = 0; size + file.may_miss < file.bytes.size(); ++size) {
            const Bytes prefix(file.bytes.begin(), file.bytes.begin() + static_cast<std::ptrdiff_t>(size));
            SCOPED_TRACE(file.name + " cut at " + std::to_string(size));
            EXPECT_FALSE(refusal([&] { parse_mesh(prefix, "cut"); }).empty());
        }
    }
}

TEST(Damaged, RandomBytesAreRefusedOrReadSoundly) {
    std::mt19937 random(11);
    std::size_t refused = 0;
    std::size_t accepted = 0;
    const std::vector<Encoded> files = encodings();
    for (int i = 0; i < 20000; ++i) {
        const Encoded& file = files[static_cast<std::size_t>(i) % files.size()];
        Bytes bytes = file.bytes;
        for (std::uint32_t flips = 1 + random() % 4; flips > 0; --flips) {
            bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
        }
        try {
            expect_sound(parse_mesh(bytes, file.name));
            ++accepted;
        } catch (const InputError& error) {
            ASSERT_EQ(error.fault, InputFault::mesh);
            ++refused;
        }
    }
    EXPECT_GT(refused, 1000U);
    EXPECT_GT(accepted, 1000U);
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
