// Marks of a painted PLY, in all forms of the format, by property and by colour.

#include "segment/io/read_painted.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "tests/segment/io/help.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// A square of two triangles and a flap at one of its edges. Two corners of the first triangle are marked, one of the
// second, and one of the flap.
const TriangleMesh flaps{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 1}}, {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}}, {}};
constexpr std::array<bool, 5> is_marked{true, true, false, false, false};
const std::vector<std::uint8_t> expected{1, 0, 0};

struct Column {
    std::string type;
    std::string name;
    double marked;
    double plain;
};

std::string header_of(const std::string& format, const std::vector<Column>& columns) {
    std::string text = "ply\nformat " + format + " 1.0\nelement note 1\nproperty list uchar short words\n" +
                       "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n";
    for (const Column& c : columns) text += "property " + c.type + " " + c.name + "\n";
    return text + "element face 3\nproperty list uchar int vertex_indices\nend_header\n";
}

Bytes ascii_file(const std::vector<Column>& columns) {
    std::string text = header_of("ascii", columns) + "2 7 8\n";
    for (std::size_t v = 0; v < flaps.points.size(); ++v) {
        const Vec3 p = flaps.points[v];
        text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
        for (const Column& c : columns) text += " " + std::to_string(is_marked[v] ? c.marked : c.plain);
        text += "\n";
    }
    for (const Triangle& t : flaps.triangles) {
        text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    }
    return bytes_of(text);
}

// Columns of type uchar or float.
Bytes binary_file(const std::vector<Column>& columns, bool is_big) {
    Bytes bytes = bytes_of(header_of(is_big ? "binary_big_endian" : "binary_little_endian", columns));
    const auto put = [&](std::uint64_t value, int size) {
        for (int i = 0; i < size; ++i) {
            bytes.push_back(static_cast<std::uint8_t>(value >> (8 * (is_big ? size - 1 - i : i))));
        }
    };
    const auto put_float = [&](double value) { put(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4); };
    put(1, 1);
    put(7, 2);
    for (std::size_t v = 0; v < flaps.points.size(); ++v) {
        for (int axis = 0; axis < 3; ++axis) put_float(flaps.points[v][axis]);
        for (const Column& c : columns) {
            const double value = is_marked[v] ? c.marked : c.plain;
            if (c.type == "float") put_float(value);
            if (c.type == "uchar") put(static_cast<std::uint64_t>(value), 1);
        }
    }
    for (const Triangle& t : flaps.triangles) {
        put(3, 1);
        for (const std::uint32_t corner : t) put(corner, 4);
    }
    return bytes;
}

void expect_marks(const std::vector<Column>& columns) {
    for (const Bytes& file : {ascii_file(columns), binary_file(columns, false), binary_file(columns, true)}) {
        const TriangleMesh mesh = parse_painted_ply(file, "painted.ply");
        EXPECT_EQ(mesh.points, flaps.points);
        EXPECT_EQ(mesh.triangles, flaps.triangles);
        EXPECT_EQ(mesh.ignored, expected) << columns.back().name;
    }
}

TEST(ReadPainted, APropertyMarksWhereItIsNotZero) {
    for (const char* name : {"ignore", "mask", "scalar_ignore", "scalar_mask"}) {
        expect_marks({{"uchar", name, 1, 0}});
        expect_marks({{"float", name, -0.5, 0}});
    }
}

TEST(ReadPainted, RedMarks) {
    expect_marks({{"uchar", "red", 255, 255}, {"uchar", "green", 0, 255}, {"uchar", "blue", 0, 255}});
    expect_marks({{"uchar", "red", 200, 199}, {"uchar", "green", 60, 60}, {"uchar", "blue", 60, 60}});
    expect_marks({{"uchar", "red", 255, 255}, {"uchar", "green", 60, 60}, {"uchar", "blue", 60, 61}});
    expect_marks({{"float", "diffuse_red", 1, 0.5}, {"float", "diffuse_green", 0, 0}, {"float", "diffuse_blue", 0, 0}});
}

TEST(ReadPainted, APropertyCountsBeforeColours) {
    expect_marks(
        {{"uchar", "red", 0, 255}, {"uchar", "green", 0, 0}, {"uchar", "blue", 0, 0}, {"uchar", "ignore", 1, 0}});
}

TEST(ReadPainted, MarksOfSurfaceThatMustNotBeCutAreThoseOfTheVertices) {
    for (const char* name : {"no_cut", "mask", "scalar_no_cut", "scalar_mask"}) {
        for (const Bytes& file : {ascii_file({{"uchar", name, 1, 0}}), binary_file({{"float", name, 0.5, 0}}, true)}) {
            const MarkedPoints marked = parse_no_cut_ply(file, "painted.ply");
            EXPECT_EQ(marked.mesh.triangles, flaps.triangles);
            EXPECT_EQ(marked.is_marked, std::vector<std::uint8_t>(is_marked.begin(), is_marked.end()));
        }
    }
    EXPECT_NE(refusal([] {
                  static_cast<void>(parse_no_cut_ply(ascii_file({{"uchar", "ignore", 1, 0}}), "painted.ply"));
              }).find("no_cut"),
              std::string::npos);
}

TEST(ReadPainted, RefusesWhatMarksNothing) {
    const auto refused = [](const Bytes& file) {
        return refusal([&] { static_cast<void>(parse_painted_ply(file, "painted.ply")); });
    };
    EXPECT_NE(refused(ascii_file({{"uchar", "red", 255, 0}, {"uchar", "green", 0, 0}})).find("marks nothing"),
              std::string::npos);
    EXPECT_NE(refused(bytes_of(ascii_ply(flaps))).find("neither a property"), std::string::npos);
    EXPECT_NE(refused(bytes_of(ascii_stl(flaps))).find("not a PLY"), std::string::npos);
    EXPECT_NE(refused({}).find("not a PLY"), std::string::npos);
    const Bytes whole = binary_file({{"uchar", "ignore", 1, 0}}, false);
    for (std::size_t size = 4; size < whole.size(); ++size) {
        refused({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    }
}

}  // namespace
}  // namespace qchopper
