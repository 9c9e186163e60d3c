#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "segment/io/read_mesh.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/measure.h"
#include "segment/repair/weld.h"
#include "tests/segment/io/help.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(WritePly, ReadsBackBitForBit) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shapes::moved(shape.mesh, {0.1, 1e-7, -12345.678901});
        const RawMesh plain = parse_mesh(to_ply(mesh), shape.name);
        EXPECT_EQ(plain.mesh, mesh) << shape.name;
        EXPECT_EQ(plain.format, MeshFormat::ply_little_endian);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            mesh.cap_of.push_back(static_cast<std::int32_t>(t % 4) - 1);
        }
        EXPECT_EQ(parse_mesh(to_ply(mesh), shape.name).mesh, mesh) << shape.name;
    }
}

TEST(WritePly, KeepsTheSignOfZeroAndTheSmallestNumbers) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {1, 1, 1});
    mesh.points[0] = {-0.0, 5e-324, 1.7976931348623157e308};
    const TriangleMesh back = parse_mesh(to_ply(mesh), "test").mesh;
    EXPECT_EQ(std::memcmp(back.points.data(), mesh.points.data(), mesh.points.size() * sizeof(Vec3)), 0);
}

TEST(WriteStl, ReadsBackWithinAFloat) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh back = parse_mesh(to_stl(shape.mesh), shape.name).mesh;
        EXPECT_EQ(back.triangles.size(), shape.mesh.triangles.size()) << shape.name;
        EXPECT_NEAR(volume_mm3(back) / volume_mm3(shape.mesh), 1, 1e-3)
            << shape.name;  // the far away ball is a coarse one in floats
    }
}

TEST(WriteStl, HeaderIsNoText) {
    const Bytes bytes = to_stl(shapes::box({0, 0, 0}, {1, 1, 1}));
    EXPECT_EQ(bytes.size(), 84U + 50 * 12);
    EXPECT_NE(std::string(bytes.begin(), bytes.begin() + 5), "solid");
}

TEST(WriteStl, NormalsPointOutward) {
    const Bytes bytes = to_stl(shapes::box({-1, -1, -1}, {1, 1, 1}));
    for (std::size_t t = 0; t < 12; ++t) {
        float value[6] = {};
        std::memcpy(value, &bytes[84 + 50 * t], sizeof(value));
        EXPECT_GT(value[0] * value[3] + value[1] * value[4] + value[2] * value[5], 0.5F);
    }
}

}  // namespace
}  // namespace qchopper
