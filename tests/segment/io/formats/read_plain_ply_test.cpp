#include "segment/io/formats/read_plain_ply.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "segment/io/read_mesh.h"
#include "segment/io/write_mesh.h"
#include "tests/segment/io/help.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

template <class Value>
void put(Bytes& bytes, Value value) {
    const auto* const at = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), at, at + sizeof value);
}

// A box as most scanners write it: single precision, further properties, triangles.
Bytes plain(const TriangleMesh& mesh, const std::string& before_x, const std::string& behind_z, std::size_t pad_before,
            std::size_t pad_behind) {
    Bytes bytes =
        bytes_of("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.points.size()) + "\n" +
                 before_x + "property float x\nproperty float y\nproperty float z\n" + behind_z + "element face " +
                 std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n");
    for (const Vec3& p : mesh.points) {
        bytes.insert(bytes.end(), pad_before, 7);
        for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<float>(p[axis]));
        bytes.insert(bytes.end(), pad_behind, 9);
    }
    for (const Triangle& t : mesh.triangles) {
        bytes.push_back(3);
        for (const std::uint32_t corner : t) put(bytes, corner);
    }
    return bytes;
}

std::optional<RawMesh> quickly(const Bytes& bytes) {
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return read_plain_ply(read_ply_header(file, "test"), file);
}

TEST(PlainPly, IsReadAsTheCarefulReaderReadsIt) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        const Bytes bytes =
            plain(shape.mesh, "property uchar flag\n", "property double quality\nproperty short s\n", 1, 10);
        const std::optional<RawMesh> quick = quickly(bytes);
        ASSERT_TRUE(quick) << shape.name;
        Bytes longer = bytes;  // a line end at the end is left to the careful reader
        longer.push_back('\n');
        EXPECT_FALSE(quickly(longer));
        const RawMesh careful = parse_mesh(longer, shape.name);
        EXPECT_EQ(quick->mesh, careful.mesh) << shape.name;
        EXPECT_EQ(quick->faces_in_file, careful.faces_in_file);
        EXPECT_EQ(quick->format, careful.format);
        EXPECT_EQ(quickly(to_ply(shape.mesh))->mesh, shape.mesh);  // double precision
    }
}

TEST(PlainPly, LeavesEverythingElseToTheCarefulReader) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1});
    const Bytes good = plain(box, "", "", 0, 0);
    const std::size_t points_at = good.size() - 13 * box.triangles.size() - 12 * box.points.size();
    const std::size_t faces_at = good.size() - 13 * box.triangles.size();
    ASSERT_TRUE(quickly(good));
    Bytes cut = good;
    cut.pop_back();
    EXPECT_FALSE(quickly(cut));
    EXPECT_NE(refusal([&] { parse_mesh(cut, "cut.ply"); }), "");
    Bytes quad = good;
    quad[faces_at] = 4;
    EXPECT_FALSE(quickly(quad));
    Bytes astray = good;
    astray[faces_at + 4] = 0x7f;
    EXPECT_FALSE(quickly(astray));
    EXPECT_NE(refusal([&] { parse_mesh(astray, "astray.ply"); }).find("names vertex"), std::string::npos);
    for (const float value : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        Bytes wild = good;
        std::memcpy(&wild[points_at + 16], &value, 4);
        EXPECT_FALSE(quickly(wild));
        EXPECT_NE(refusal([&] { parse_mesh(wild, "wild.ply"); }).find("not a finite number"), std::string::npos);
    }
}

TEST(PlainPly, BelievesNoCount) {
    for (const char* count : {"4294967296", "1431655765", "99999999999", "1152921504606846977"}) {
        const Bytes lie = bytes_of(std::string("ply\nformat binary_little_endian 1.0\nelement vertex ") + count +
                                   "\nproperty float x\nproperty float y\nproperty float z\nelement face " + count +
                                   "\nproperty list uchar int vertex_indices\nend_header\nabcdefg");
        EXPECT_FALSE(quickly(lie)) << count;
        EXPECT_NE(refusal([&] { parse_mesh(lie, "lie.ply"); }), "");
    }
}

}  // namespace
}  // namespace qchopper
