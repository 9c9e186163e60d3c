#include "segment/io/formats/read_obj.h"

#include <gtest/gtest.h>

#include "segment/io/read_mesh.h"
#include "segment/mesh/measure.h"
#include "tests/segment/io/help.h"
#include "tests/segment/io/wrappings.h"

namespace qchopper {
namespace {

RawMesh read(const std::string& text) {
    return parse_mesh(bytes_of(text), "bone.obj");
}
std::string refused(const std::string& text) {
    return refusal([&] { read(text); });
}

const std::string square = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n";

TEST(ReadObj, HasNoUnit) {
    const RawMesh scan = read(square + "f 1 2 3\n");
    EXPECT_EQ(scan.format, MeshFormat::obj);
    EXPECT_FALSE(scan.mm_per_unit.has_value());
}

TEST(ReadObj, CornersMayCountFromEitherEndAndNameTextureAndNormal) {
    const std::vector<Triangle> expected{{0, 1, 2}};
    for (const char* face : {"f 1 2 3", "f -4 -3 -2", "f 1/7 2/8 3/9", "f 1//7 2//8 3//9", "f 1/7/8 2/7/8 3/7/8",
                             "f 1/-1/-1 2/-1/-1 3/-1/-1", "  f\t1 2 3 # a face", "f 1 \\\n2 \\\n3", "fo 1 2 3"}) {
        EXPECT_EQ(read(square + face + "\n").mesh.triangles, expected) << face;
        EXPECT_EQ(read(square + face).mesh.triangles, expected) << face << " without a line end";
    }
}

TEST(ReadObj, NegativeNumbersCountFromThePointsSoFar) {
    const RawMesh scan = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n");
    EXPECT_EQ(scan.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
}

TEST(ReadObj, FacesMayNameLaterPoints) {
    const RawMesh scan = read("f 1 2 3\n" + square + "f 1 3 4\n");
    EXPECT_EQ(scan.faces_in_file, 2U);
    EXPECT_DOUBLE_EQ(area_mm2(scan.mesh), 16);
    const std::string what = refused("f 1 2 3\nf 1 2 5\n" + square);
    EXPECT_NE(what.find("line 2 of the OBJ: a face names point 5, but there are 4"), std::string::npos) << what;
}

TEST(ReadObj, PolygonsAreSplitIntoTheirOwnArea) {
    const RawMesh scan = read("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\nf 1 2\n");
    EXPECT_EQ(scan.mesh.triangles.size(), 3U);
    EXPECT_DOUBLE_EQ(area_mm2(scan.mesh), 10);
    EXPECT_EQ(scan.faces_without_area, 1U);
}

TEST(ReadObj, WhatMakesNoFaceIsPassedOver) {
    const RawMesh scan =
        read("# a scan\nmtllib a b.mtl\nusemtl x\no bone\ng a b\ns off\nvt 0 0\nvn 0 0 1\nl 1 2\np 1\n" + square +
             "f 1 2 3\n");
    EXPECT_EQ(scan.mesh.triangles.size(), 1U);
    EXPECT_TRUE(scan.warnings.empty());
}

TEST(ReadObj, CurvedSurfacesAreLeftOutWithAWarning) {
    const RawMesh scan = read(square + "f 1 2 3\ncstype bspline\ndeg 3 3\nsurf 0 1 0 1 1 2 3 4\nend\n");
    ASSERT_EQ(scan.warnings.size(), 1U);
    EXPECT_NE(scan.warnings[0].find("line 8"), std::string::npos) << scan.warnings[0];
}

TEST(ReadObj, LinesOfUnknownKindAreSkippedWithAWarningThatCountsThem) {
    const RawMesh plain = read(square + "f 1 2 3\n");
    const RawMesh scan = read(square + "w 0 0 0\nf 1 2 3\nattr a \\\n b\n$colour 1\nw\n");
    EXPECT_EQ(scan.mesh, plain.mesh);
    ASSERT_EQ(scan.warnings.size(), 1U);
    EXPECT_NE(scan.warnings[0].find("4 lines of unknown kind were skipped"), std::string::npos) << scan.warnings[0];
    EXPECT_NE(scan.warnings[0].find("line 5, which begins with \"w\""), std::string::npos) << scan.warnings[0];
    const RawMesh one = read(square + "f 1 2 3\nx y\n");
    ASSERT_EQ(one.warnings.size(), 1U);
    EXPECT_NE(one.warnings[0].find("1 line of unknown kind was skipped"), std::string::npos) << one.warnings[0];
}

TEST(ReadObj, NumbersComeOutAsTheyStand) {
    const RawMesh scan = read("v 5000000.1234567891 -0.1 1e-300 0.5 0.5 0.5\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(scan.mesh.points[0], (Vec3{5000000.1234567891, -0.1, 1e-300}));
}

TEST(ReadObj, SaysWhatIsWrongAndWhere) {
    const auto expect_words = [](const std::string& text, const std::string& words) {
        const std::string what = refused(text);
        EXPECT_NE(what.find(words), std::string::npos) << what;
    };
    expect_words(square + "f 1 2 5\n", "line 5 of the OBJ: a face names point 5, but there are 4");
    expect_words(square + "f 1 2 0\n", "line 5 of the OBJ: a face names point 0");
    expect_words(square + "f -5 2 3\n", "names point -5");
    expect_words(square + "f 1 2 99999999999\n", "names point 99999999999");
    expect_words(square + "f 1 2 3x\n", "a corner cannot be \"3x\"");
    expect_words(square + "f 1 2/x 3\n", "a corner cannot be \"2/x\"");
    expect_words(square + "f 1 2 3/1/1/1\n", "a corner cannot be");
    expect_words("v 1 2\n", "three coordinates");
    expect_words("v 1,5 2 3\n", "a coordinate cannot be \"1,5\"");
    expect_words("v 1 nan 3\n", "not a finite number");
    expect_words(square + "7 0 0\nf 1 2 3\n", "line 5 of the OBJ: begins with \"7\"");
    expect_words(square + "-.5 0 0\nf 1 2 3\n", "line 5 of the OBJ: begins with \"-.5\"");
    expect_words(square + "f 1 2 3\nw\x01 0 0\n", "line 6 of the OBJ: begins with");
    expect_words(square, "holds no faces");
}

}  // namespace
}  // namespace qchopper
