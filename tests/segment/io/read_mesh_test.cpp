#include "segment/io/read_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "segment/io/write_mesh.h"
#include "segment/mesh/measure.h"
#include "segment/repair/weld.h"
#include "tests/segment/io/help.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
        text.replace(at, from.size(), to);
    }
    return text;
}

// Every property type and both orders, with elements and properties that nobody asked for.
template <std::endian order>
class BinaryPly {
 public:
    void text(const std::string& line) { bytes_.insert(bytes_.end(), line.begin(), line.end()); }
    template <class Number>
    void number(Number value) {
        std::array<std::uint8_t, sizeof(Number)> raw = std::bit_cast<std::array<std::uint8_t, sizeof(Number)>>(value);
        if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
        bytes_.insert(bytes_.end(), raw.begin(), raw.end());
    }
    const Bytes& bytes() const { return bytes_; }

 private:
    Bytes bytes_;
};

template <std::endian order>
Bytes rich_ply() {
    BinaryPly<order> ply;
    ply.text(
        std::string("ply\nformat ") + (order == std::endian::little ? "binary_little_endian" : "binary_big_endian") +
        " 1.0\ncomment two triangles and a square\nobj_info nothing\nelement camera 2\nproperty short a\n"
        "property list ushort double b\nelement vertex 5\nproperty uchar red\nproperty float x\nproperty double y\n"
        "property float32 z\nproperty list int8 uint16 extra\nelement face 3\nproperty float quality\n"
        "property list uint32 int16 vertex_index\nproperty int cap\nelement edge 1\nproperty int v\nend_header\n");
    for (int camera = 0; camera < 2; ++camera) {
        ply.number(std::int16_t{-7});
        ply.number(std::uint16_t{2});
        ply.number(1.5);
        ply.number(2.5);
    }
    const float xs[] = {0, 1, 1, 0, 0.5F};
    const double ys[] = {0, 0, 1, 1, 0.1};
    for (int v = 0; v < 5; ++v) {
        ply.number(std::uint8_t{200});
        ply.number(xs[v]);
        ply.number(ys[v]);
        ply.number(v == 4 ? 2.0F : 0.0F);
        ply.number(std::int8_t{1});
        ply.number(std::uint16_t{65535});
    }
    const std::vector<std::vector<std::int16_t>> faces{{0, 1, 4}, {3, 2, 1, 0}, {1, 2, 4}};
    for (const std::vector<std::int16_t>& face : faces) {
        ply.number(0.25F);
        ply.number(static_cast<std::uint32_t>(face.size()));
        for (const std::int16_t corner : face) ply.number(corner);
        ply.number(static_cast<std::int32_t>(face.size() == 4 ? 7 : -1));
    }
    ply.number(std::int32_t{3});
    return ply.bytes();
}

std::string exact(Vec3 p) {
    char text[100];
    std::snprintf(text, sizeof text, "%.17g %.17g %.17g\n", p.x, p.y, p.z);
    return text;
}

Bytes exact_obj(const TriangleMesh& mesh) {
    std::string text;
    for (const Vec3& p : mesh.points) text += "v " + exact(p);
    for (const Triangle& t : mesh.triangles) {
        text +=
            "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
    }
    return bytes_of(text);
}

Bytes exact_off(const TriangleMesh& mesh) {
    std::string text =
        "OFF\n" + std::to_string(mesh.points.size()) + " " + std::to_string(mesh.triangles.size()) + "\n";
    for (const Vec3& p : mesh.points) text += exact(p);
    for (const Triangle& t : mesh.triangles) {
        text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    }
    return bytes_of(text);
}

std::string as_string(const Bytes& bytes) {
    return {bytes.begin(), bytes.end()};
}

TEST(ReadMesh, ReadsPlyOfBothOrdersWithForeignElementsAndProperties) {
    for (const Bytes& bytes : {rich_ply<std::endian::little>(), rich_ply<std::endian::big>()}) {
        const RawMesh scan = parse_mesh(bytes, "test");
        EXPECT_EQ(scan.mesh.points.size(), 5U);
        EXPECT_EQ(scan.mesh.points[4], (Vec3{0.5, 0.1, 2}));
        EXPECT_EQ(scan.faces_in_file, 3U);
        ASSERT_EQ(scan.mesh.triangles.size(), 4U);
        EXPECT_EQ(scan.mesh.triangles[0], (Triangle{0, 1, 4}));
        EXPECT_EQ(scan.mesh.triangles[3], (Triangle{1, 2, 4}));
        EXPECT_EQ(scan.mesh.cap_of, (std::vector<std::int32_t>{-1, 7, 7, -1}));
    }
}

TEST(ReadMesh, ReadsEveryEncodingAlike) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {20, 20, 20}, 2);
    const TriangleMesh from_ply = parse_mesh(bytes_of(ascii_ply(box)), "ply").mesh;
    EXPECT_EQ(from_ply, box);
    for (const Bytes& bytes : {bytes_of(ascii_stl(box)), to_stl(box)}) {
        TriangleMesh mesh = parse_mesh(bytes, "stl").mesh;
        EXPECT_EQ(mesh.points.size(), 3 * box.triangles.size());
        weld(mesh);
        EXPECT_EQ(mesh.points.size(), box.points.size());
        EXPECT_EQ(mesh.triangles.size(), box.triangles.size());
        EXPECT_DOUBLE_EQ(volume_mm3(mesh), 8000);
    }
}

TEST(ReadMesh, LineEndsDoNotMatter) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 2, 3});
    for (const std::string& text : {ascii_ply(box), ascii_stl(box)}) {
        const TriangleMesh with_lf = parse_mesh(bytes_of(text), "lf").mesh;
        EXPECT_EQ(parse_mesh(bytes_of(replaced(text, "\n", "\r")), "cr").mesh, with_lf);
        EXPECT_EQ(parse_mesh(bytes_of(replaced(text, "\n", "\r\n")), "crlf").mesh, with_lf);
    }
}

TEST(ReadMesh, NeverTrustsTheWordSolid) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 2, 3});
    Bytes binary = to_stl(box);
    const std::string_view word = "solid looks like text";
    std::copy(word.begin(), word.end(), binary.begin());
    const RawMesh scan = parse_mesh(binary, "test");
    EXPECT_EQ(scan.format, MeshFormat::stl_binary);
    EXPECT_EQ(scan.mesh.triangles.size(), 12U);
    binary.pop_back();
    EXPECT_NE(refusal([&] { parse_mesh(binary, "test"); }).find("12 triangles"), std::string::npos);
}

// What programs and people write above or before a mesh where the format lets them.
std::vector<std::string> heads() {
    std::vector<std::string> all{"$WaveFront *.obj file (generated by a modeller)",
                                 "$",
                                 "% from the CT of 3 May",
                                 "// bone 7",
                                 "; v 1 2 3",
                                 "\xc2\xa9 Museum",
                                 "<scan>",
                                 "ISO-10303-21;",
                                 "Wavefront OBJ, 8 points",
                                 "{ not JSON"};
    std::mt19937 random(17);
    for (int i = 0; i < 300; ++i) {
        std::string line(1, "$%&!/;:=@~|<>*^_?"[random() % 17]);
        for (std::uint32_t size = random() % 120; size > 0; --size) line += static_cast<char>(' ' + random() % 95);
        std::replace(line.begin(), line.end(), '#', '$');  // begins a comment
        if (line.back() == '\\') line += '.';              // joins the next line
        all.push_back(line);
    }
    return all;
}

TEST(ReadMesh, TextAboveAnObjIsSkippedWithAWarning) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 2, 3});
    const std::string obj = as_string(exact_obj(box));
    for (const std::string& head : heads()) {
        SCOPED_TRACE(head);
        if (head[0] == '{') continue;  // a brace is the mark of glTF
        for (const std::string& above : {head + "\n", "# a comment\n\n" + head + "\n" + head + "\n"}) {
            const RawMesh scan = parse_mesh(bytes_of(above + obj), "scan");
            EXPECT_EQ(scan.format, MeshFormat::obj);
            EXPECT_EQ(scan.mesh, box);
            EXPECT_EQ(scan.warnings.size(), 1U);
        }
    }
    // Marks of other formats, so that the ending counts.
    for (const std::string head : {"solid bone", "ply of a bone", "OFF", "{ not JSON"}) {
        EXPECT_EQ(parse_mesh(bytes_of(head + "\n" + obj), "bone.obj").mesh, box) << head;
        EXPECT_EQ(parse_mesh(bytes_of(head + "\n" + obj), "bone.OBJ.gz").mesh, box) << head;
        refusal([&] { parse_mesh(bytes_of(head + "\n" + obj), "bone"); });
    }
    const std::string what = refusal([&] { parse_mesh(bytes_of("$ no mesh\nat all, but text\n"), "bone.obj"); });
    EXPECT_EQ(what.find("binary STL"), std::string::npos) << what;
    refusal([&] { parse_mesh(bytes_of("7 is the first word\n" + obj), "bone.obj"); });
}

TEST(ReadMesh, NoHeadHidesAFormatThatHasRoomForOne) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 2, 3});
    std::vector<std::string> all = heads();
    all.insert(all.end(), {"solid", "ply\nformat ascii 1.0", "OFF", "v 1 2 3", "glTF", "PK\x03\x04", "\x1f\x8b\x08",
                           "\xef\xbb\xbf", "\xff\xfe", "\xfe\xff"});
    const TriangleMesh of_stl = parse_mesh(to_stl(box), "stl").mesh;
    for (const std::string& head : all) {
        Bytes binary = to_stl(box);
        std::copy_n(head.begin(), std::min<std::size_t>(80, head.size()), binary.begin());
        for (const char* name : {"bone", "bone.obj", "bone.stl"}) {
            const RawMesh scan = parse_mesh(binary, name);
            EXPECT_EQ(scan.format, MeshFormat::stl_binary) << head;
            EXPECT_EQ(scan.mesh, of_stl) << head;
        }
    }
    for (const std::string& head : heads()) {
        const auto expect_format = [&](const std::string& text, MeshFormat format) {
            for (const char* name : {"bone", "bone.obj"}) {
                const RawMesh scan = parse_mesh(bytes_of(text), name);
                EXPECT_EQ(scan.format, format) << head << " in " << name;
                EXPECT_EQ(scan.mesh.triangles.size(), 12U) << head;
            }
        };
        expect_format(replaced(ascii_ply(box), "made by a test", head), MeshFormat::ply_ascii);
        expect_format(replaced(ascii_stl(box), "test", head), MeshFormat::stl_ascii);
        expect_format(replaced(as_string(exact_off(box)), "OFF", "OFF # " + head), MeshFormat::off);
    }
}

TEST(ReadMesh, ReadsSeveralSolidsAndShoutedWords) {
    const TriangleMesh a = shapes::box({0, 0, 0}, {1, 1, 1});
    const TriangleMesh b = shapes::box({5, 0, 0}, {6, 1, 1});
    std::string text = ascii_stl(a) + "\n" + ascii_stl(b);
    EXPECT_EQ(parse_mesh(bytes_of(text), "two").mesh.triangles.size(), 24U);
    for (char& c : text) c = static_cast<char>(std::toupper(c));
    EXPECT_EQ(parse_mesh(bytes_of(text), "loud").mesh.triangles.size(), 24U);
}

TEST(ReadMesh, CutsConcavePolygonsIntoTheirOwnArea) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement face "
        "1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n4 0 0\n4 4 0\n2 1 0\n0 4 0\n5 0 1 2 3 4\n";
    const RawMesh scan = parse_mesh(bytes_of(text), "dart");
    EXPECT_EQ(scan.mesh.triangles.size(), 3U);
    EXPECT_DOUBLE_EQ(area_mm2(scan.mesh), 10);
    for (std::size_t t = 0; t < 3; ++t) EXPECT_GT(area_vector(scan.mesh, t).z, 0);
}

// Two strips in one list, as scanning software of the nineties wrote them; the second leads back over a repeated
// corner.
TEST(ReadMesh, ReadsTriangleStrips) {
    const std::string start =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n";
    const RawMesh scan = parse_mesh(bytes_of(start + "10 0 1 2 3 -1 2 3 4 3 5\n"), "strips");
    const std::vector<Triangle> expected{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}};
    EXPECT_EQ(scan.mesh.triangles, expected);
    for (std::size_t t = 0; t < expected.size(); ++t) EXPECT_GT(area_vector(scan.mesh, t).z, 0);
    const auto refused = [&](const std::string& strip) {
        return refusal([&] { parse_mesh(bytes_of(start + strip), "strips"); });
    };
    EXPECT_NE(refused("3 0 1 6\n").find("strip 0 (line 16) names vertex 6"), std::string::npos) << refused("3 0 1 6\n");
    EXPECT_NE(refused("3 0 1 -2\n").find("names vertex -2"), std::string::npos);
    EXPECT_NE(refused("-1\n").find("number of corners"), std::string::npos);
    EXPECT_NE(refused("4 0 1 2\n").find("ends or is damaged"), std::string::npos);
}

TEST(ReadMesh, FacesMayComeBeforeTheirPoints) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\nproperty int cap\n"
        "element vertex 5\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
        "3 0 1 2 7\n4 0 2 3 4 -1\n0 0 0\n4 0 0\n4 4 0\n3 3.5 0\n0 4 0\n";
    const RawMesh scan = parse_mesh(bytes_of(text), "faces first");
    ASSERT_EQ(scan.mesh.triangles.size(), 3U);
    EXPECT_EQ(scan.mesh.cap_of, (std::vector<std::int32_t>{7, -1, -1}));
    EXPECT_DOUBLE_EQ(area_mm2(scan.mesh), 8 + 7);
}

// 5 km away, in steps of 2^-20 mm: every digit counts, and differences come out as if the scan stood at the origin.
TEST(ReadMesh, FarFromTheOriginNothingIsLost) {
    TriangleMesh near = shapes::ball({0, 0, 0}, 50, 12);
    for (Vec3& p : near.points) {
        for (int axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] * 1048576) / 1048576;
    }
    const Vec3 there{5e6, -5e6, 2.5e6};
    const TriangleMesh far = shapes::moved(near, there);
    for (const Bytes& bytes : {to_ply(far), exact_obj(far), exact_off(far)}) {
        TriangleMesh back = parse_mesh(bytes, "far").mesh;
        EXPECT_EQ(back, far);
        for (Vec3& p : back.points) p = p - there;
        EXPECT_EQ(back, near);
    }
}

TEST(ReadMesh, LeavesOutFacesWithoutArea) {
    const std::string text =
        replaced(ascii_ply(shapes::box({0, 0, 0}, {1, 1, 1})), "element face 12", "element face 13");
    const RawMesh scan = parse_mesh(bytes_of(text + "2 0 1\n"), "test");
    EXPECT_EQ(scan.faces_in_file, 13U);
    EXPECT_EQ(scan.faces_without_area, 1U);
    EXPECT_EQ(scan.mesh.triangles.size(), 12U);
}

TEST(ReadMesh, SaysWhatIsWrongAndWhere) {
    const std::string good = ascii_ply(shapes::box({0, 0, 0}, {1, 1, 1}));
    const auto refused = [](const std::string& text) {
        return refusal([&] { parse_mesh(bytes_of(text), "bone.ply"); });
    };
    const auto expect_words = [&](const std::string& text, const std::string& words) {
        const std::string what = refused(text);
        EXPECT_NE(what.find(words), std::string::npos) << what;
        EXPECT_NE(what.find("bone.ply"), std::string::npos) << what;
    };
    expect_words("", "is empty");
    expect_words("a scan, honestly\n", "does not begin like a PLY");
    expect_words("OFF\n3 1 0\n", "line 2 of the OFF: announces 3 points and 1 faces, more than");
    expect_words(replaced(good, "\n3 ", "\n3 99 "), "names vertex 99, but there are 8");
    expect_words(replaced(good, "\n3 ", "\n3 -1 "), "names vertex -1");
    expect_words(replaced(good, "1.000000", "nan"), "not a finite number");
    expect_words(replaced(good, "1.000000", "1e999"), "vertex 0 (line 11)");
    expect_words(replaced(good, "1.000000", "1.0.0"), "line 11");
    expect_words(replaced(good, "element face 12", "element face 0"), "holds no faces");
    expect_words(replaced(good, "element face 12", "element face 4000000000000"), "more than the file has room for");
    expect_words(replaced(good, "element vertex 8", "element vertex 18446744073709551615"), "line 4");
    expect_words(replaced(good, "element vertex 8", "element vertex -8"), "line 4");
    expect_words(replaced(good, "property double y", "property double w"), "x, y and z");
    expect_words(replaced(good, "double y", "quad y"), "unknown type \"quad\"");
    expect_words(replaced(good, "ascii", "text"), "unknown format \"text\"");
    expect_words(replaced(good, "list uchar", "list float"), "must be an integer");
    expect_words(good + "3 0 1 2\n", "more data follow");
    expect_words("solid x\nfacet normal 0 0 0\nouter loop\nvertex 1 2 x\n", "line 4");
    expect_words("solid x\nendsolid x\n", "holds no faces");
}

TEST(ReadMesh, RefusesAFileThatIsNotThere) {
    try {
        read_mesh("/no/such/scan.ply");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::missing);
    }
}

struct RealFile {
    std::string name;
    std::size_t triangles;  // 0: must be refused
};

TEST(ReadMesh, ReadsTheRealFilesAndRefusesTheBrokenOnes) {
    NEEDS_MESH("nasty");
    const RealFile files[] = {{"bunny_bun_zipper.ply", 69451},
                              {"igea_268k.ply", 268686},
                              {"femur_3548.stl", 3548},
                              {"skull_scan_25k.stl", 25098},
                              {"nasty/made_header_solid_binary.stl", 20000},
                              {"nasty/made_inside_out.stl", 69451},
                              {"nasty/slic3r-prusa_tests_data_test_stl_ASCII_20mmbox-CR.stl", 12},
                              {"nasty/trimesh_multibody.stl", 32},
                              {"nasty/trimesh_fuze_ascii.ply", 1000},
                              {"nasty/assimp_STL_triangle_with_two_solids.stl", 2},
                              {"nasty/trimesh_origin_inside.STL", 28},
                              {"nasty/made_count_lies.stl", 0},
                              {"nasty/made_nan_inf.stl", 0},
                              {"nasty/made_truncated.stl", 0},
                              {"nasty/assimp_invalid_empty.ply", 0},
                              {"nasty/assimp_PLY_issue623.ply", 0},
                              {"nasty/common_data_igea.ply", 268686},
                              {"nasty/cgal_cow.off", 5804},
                              {"nasty/cgal_cube_quad.off", 12},
                              {"nasty/pmp_data_off_hole_capsule.off", 152},
                              {"nasty/assimp_OBJ_box_UTF16BE.obj", 12},
                              {"nasty/assimp_OBJ_concave_polygon.obj", 64},
                              {"nasty/assimp_OBJ_regr01.obj", 2710},
                              {"nasty/assimp_invalid_malformed.obj", 0},
                              {"nasty/trimesh_negative_indices.obj", 12},
                              {"nasty/trimesh_nested.glb", 36},
                              {"nasty/trimesh_simple_pole.glb", 580},
                              {"nasty/trimesh_cube_and_sphere_same_name.3mf", 5132},
                              {"nasty/lib3mf_TestFiles_CPP_UnitTests_3mfbase11_AdjMount.3mf", 1704}};
    for (const RealFile& file : files) {
        SCOPED_TRACE(file.name);
        if (file.triangles == 0) {
            EXPECT_FALSE(refusal([&] { read_mesh(real_mesh(file.name)); }).empty());
        } else {
            EXPECT_EQ(read_mesh(real_mesh(file.name)).mesh.triangles.size(), file.triangles);
        }
    }
}

}  // namespace
}  // namespace qchopper
