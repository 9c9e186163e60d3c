#include "app/display/display_format.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>

#include "base/error.h"
#include "base/files/gzip.h"
#include "tests/app/display/cut_shapes.h"

namespace qchopper {
namespace {

DisplayMesh shown(const TriangleMesh& mesh) {
    return display_mesh(mesh, display_grid(bounds(mesh)));
}

// A half of a box: skin and one cap.
Bytes small_file() {
    return encode_display_mesh(shown(halves_of(shapes::box({0, 0, 0}, {8, 8, 8}), 5, {0.2, 0.3, 0.9})[0]));
}

// Reads the grammar of docs/developer/formats/display-mesh.md without a check, as a page would.
struct PlainReader {
    Bytes bytes;
    std::size_t at = 4;
    std::uint64_t number(std::size_t size) {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size; ++i) value += std::uint64_t{bytes[at++]} << 8 * i;
        return value;
    }
    DisplayMesh read() {
        DisplayMesh mesh;
        mesh.points.resize(number(4));
        mesh.triangles.resize(number(4));
        number(4);
        mesh.groups.resize(number(4));
        Vec3& origin = mesh.grid.origin;
        for (double* x : {&origin.x, &origin.y, &origin.z, &mesh.grid.step}) *x = std::bit_cast<double>(number(8));
        const std::size_t n = mesh.points.size();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            long here = 0;
            for (std::size_t i = 0; i < n; ++i) {
                const long code = bytes[at + i] + 256L * bytes[at + n + i];
                here += code % 2 == 0 ? code / 2 : -(code + 1) / 2;
                mesh.points[i][axis] = static_cast<std::uint16_t>(here);
            }
            at += 2 * n;
        }
        std::uint32_t next = 0;
        for (Triangle& t : mesh.triangles) {
            for (std::uint32_t& corner : t) {
                std::uint32_t code = 0;
                for (std::uint32_t place = 1;; place *= 128) {
                    const std::uint8_t byte = bytes[at++];
                    code += byte % 128 * place;
                    if (byte < 128) break;
                }
                corner = code == 0 ? next++ : next - code;
            }
        }
        for (DisplayGroup& group : mesh.groups) {
            group.surface = number(1) == 0 ? DisplaySurface::skin : DisplaySurface::cap;
            group.cut = static_cast<std::int32_t>(number(4));
            group.first = static_cast<std::uint32_t>(number(4));
            group.faces = static_cast<std::uint32_t>(number(4));
        }
        return mesh;
    }
};

void expect_refused_or_valid(const Bytes& bytes) {
    try {
        const DisplayMesh mesh = decode_display_mesh(bytes);
        EXPECT_TRUE(is_valid(mesh));
        EXPECT_EQ(encode_display_mesh(mesh), bytes) << "one form per value";
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::mesh);
        EXPECT_FALSE(error.to_do.empty());
    }
}

TEST(DisplayFormat, EveryShapeAndItsPartsAreReadAsTheyWereWritten) {
    for (const shapes::Named& shape : awkward_shapes()) {
        std::vector<TriangleMesh> meshes = parts_of(shape.mesh);
        meshes.push_back(shape.mesh);
        for (const TriangleMesh& mesh : meshes) {
            const DisplayMesh written = shown(mesh);
            const Bytes bytes = encode_display_mesh(written);
            EXPECT_EQ(decode_display_mesh(bytes), written) << shape.name;
            PlainReader reader{bytes};
            EXPECT_EQ(reader.read(), written) << shape.name;
            EXPECT_EQ(reader.at, bytes.size());
        }
    }
    EXPECT_EQ(decode_display_mesh(encode_display_mesh(DisplayMesh{})), DisplayMesh{});
}

// The page reads these bytes: they change only together with it.
TEST(DisplayFormat, ABytesOfATriangleOfACapAre) {
    DisplayMesh mesh;
    mesh.grid = {{0, 0, 0}, 1};
    mesh.points = {{0, 1, 2}, {300, 1, 0}, {0, 1, 16383}};
    mesh.triangles = {{0, 1, 2}, {2, 1, 0}};
    mesh.groups = {{DisplaySurface::skin, no_cap, 0, 1}, {DisplaySurface::cap, 258, 1, 1}};
    const Bytes expected{
        'Q', 'C',  'D',  '1',  3,    0,    0, 0,    2,    0, 0, 0, 6, 0, 0, 0, 2, 0, 0, 0,  // counts
        0,   0,    0,    0,    0,    0,    0, 0,    0,    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
        0,   0,    0,    0,    0xf0, 0x3f, 0, 0x58, 0x57, 0, 2, 2,  // x: 0, +300, -300
        2,   0,    0,    0,    0,    0,                             // y: +1, 0, 0
        4,   3,    0xfe, 0,    0,    0x7f,                          // z: +2, -2, +16383
        0,   0,    0,    1,    2,    3,  // three new ones; the one before the next, and so on
        0,   0xff, 0xff, 0xff, 0xff, 0,    0, 0,    0,    1, 0, 0, 0, 1, 2, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    EXPECT_EQ(encode_display_mesh(mesh), expected);
}

TEST(DisplayFormat, EveryPrefixAndEveryFurtherByteIsRefused) {
    const Bytes whole = small_file();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_THROW(decode_display_mesh(std::span(whole).first(size)), InputError) << size;
    }
    Bytes longer = whole;
    longer.push_back(0);
    EXPECT_THROW(decode_display_mesh(longer), InputError);
}

TEST(DisplayFormat, EveryChangedByteIsRefusedOrGivesAValidMesh) {
    const Bytes whole = small_file();
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (int value = 0; value < 256; ++value) {
            Bytes changed = whole;
            changed[at] = static_cast<std::uint8_t>(value);
            expect_refused_or_valid(changed);
        }
    }
}

TEST(DisplayFormat, RandomChangesOfSeveralBytesAreRefusedOrGiveAValidMesh) {
    const Bytes whole = small_file();
    std::mt19937 random(3);
    for (int i = 0; i < 20'000; ++i) {
        Bytes changed = whole;
        for (unsigned k = 0; k < 1 + random() % 4; ++k) {
            changed[random() % changed.size()] = static_cast<std::uint8_t>(random());
        }
        expect_refused_or_valid(changed);
    }
}

// 4 GB of points in 52 bytes: refused before any memory is taken for them.
TEST(DisplayFormat, CountsThatTheBytesDoNotHoldAreRefused) {
    for (std::size_t at = 4; at < 20; at += 4) {
        Bytes bytes = small_file();
        for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = 0xff;
        EXPECT_THROW(decode_display_mesh(bytes), InputError) << at;
    }
}

TEST(DisplayFormat, AnIndexHasOneForm) {
    DisplayMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.groups = {{DisplaySurface::skin, no_cap, 0, 1}};
    Bytes bytes = encode_display_mesh(mesh);
    const std::size_t index = 52 + 18;
    ASSERT_EQ(bytes[index], 0);
    bytes[index] = 0x80;  // 0 in two bytes
    bytes.insert(bytes.begin() + index + 1, 0);
    ++bytes[12];
    EXPECT_THROW(decode_display_mesh(bytes), InputError);
    for (int i = 0; i < 4; ++i) bytes.insert(bytes.begin() + index, 0xff);  // more than 32 bits
    bytes[12] = 8;
    EXPECT_THROW(decode_display_mesh(bytes), InputError);
}

TEST(DisplayFormat, TheIdIsThatOfTheBytes) {
    EXPECT_EQ(display_id({}), "e3b0c44298fc1c149afbf4c8996fb924");  // SHA-256 of nothing (FIPS 180-4)
    EXPECT_NE(display_id(small_file()), display_id(encode_display_mesh(DisplayMesh{})));
}

TEST(DisplayFormat, StatesAreReadAsTheyWereWritten) {
    const DisplayStates states{display_id(small_file()), {0, 1, 2, 3, 4, 5, 6, 0}};
    const Bytes bytes = encode_display_states(states);
    EXPECT_EQ(decode_display_states(bytes), states);
    EXPECT_EQ(bytes.size(), 4U + 16U + 8U);
    for (std::size_t size = 0; size < 20; ++size) {
        EXPECT_THROW(decode_display_states(std::span(bytes).first(size)), InputError) << size;
    }
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        for (int value = 0; value < 256; ++value) {
            Bytes changed = bytes;
            changed[at] = static_cast<std::uint8_t>(value);
            const bool is_of_mark = at < 4 && changed != bytes;
            if (is_of_mark || (at >= 20 && value > 6)) {
                EXPECT_THROW(decode_display_states(changed), InputError) << at << " " << value;
            } else {
                EXPECT_EQ(encode_display_states(decode_display_states(changed)), changed);
            }
        }
    }
}

}  // namespace
}  // namespace qchopper
