#include "segment/io/formats/read_off.h"

#include <gtest/gtest.h>

#include "segment/io/read_mesh.h"
#include "segment/mesh/measure.h"
#include "tests/segment/io/help.h"

namespace qchopper {
namespace {

RawMesh read(const std::string& text) {
    return parse_mesh(bytes_of(text), "bone.off");
}
std::string refused(const std::string& text) {
    return refusal([&] { read(text); });
}

const std::string body = "0 0 0\n4 0 0\n4 4 0\n0 4 0\n4 0 1 2 3\n";

TEST(ReadOff, CountsMayStandAnywhereAndEdgesMayBeMissing) {
    for (const char* head :
         {"OFF\n4 1 0\n", "OFF 4 1 5\n", "OFF\n4 1\n", "# a scan\nOFF # yes\n\n# counts\n4 1 0 # all\n\n"}) {
        const RawMesh scan = read(head + body);
        EXPECT_EQ(scan.format, MeshFormat::off) << head;
        EXPECT_FALSE(scan.mm_per_unit.has_value());
        EXPECT_EQ(scan.faces_in_file, 1U);
        EXPECT_DOUBLE_EQ(area_mm2(scan.mesh), 16) << head;
    }
}

TEST(ReadOff, WhatFollowsPointsAndFacesIsPassedOver) {
    for (const char* word : {"COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"}) {
        const RawMesh scan =
            read(std::string(word) + "\n3 1 0\n0 0 0 9 9 9 9\n1 0 0 9 9 9 9\n0 2 0 9 9 9 9\n3 0 1 2 255 0 0\n");
        EXPECT_DOUBLE_EQ(area_mm2(scan.mesh), 1) << word;
    }
}

TEST(ReadOff, SaysWhatIsWrongAndWhere) {
    const auto expect_words = [](const std::string& text, const std::string& words) {
        const std::string what = refused(text);
        EXPECT_NE(what.find(words), std::string::npos) << what;
    };
    expect_words("OFF BINARY\n" + body, "binary OFF");
    expect_words("4OFF\n4 1 0\n" + body, "more than three coordinates");
    expect_words("OFF\nfour 1 0\n" + body, "line 2 of the OFF: the counts");
    expect_words("OFF\n4 -1 0\n" + body, "the counts");
    expect_words("OFF\n4 1000000000000 0\n" + body, "more than the file has room for");
    expect_words("OFF\n18446744073709551615 1 0\n" + body, "the counts");
    expect_words("OFF\n9223372036854775807 9223372036854775807 0\n" + body, "more than 4 billion points");
    expect_words("OFF\n4 2 0\n" + body, "the file ends before face 1");
    expect_words("OFF\n4 1 0\n" + body + "3 0 1 2\n", "line 8 of the OFF: more data follow than line 2 announces");
    expect_words("OFF\n4 1 0\n0 0 0\n4 0 x\n4 4 0\n0 4 0\n4 0 1 2 3\n",
                 "line 4 of the OFF: point 1 should have a coordinate");
    expect_words("OFF\n4 1 0\n0 0 0\n4 0 inf\n4 4 0\n0 4 0\n4 0 1 2 3\n", "not a finite number");
    expect_words("OFF\n4 1 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n4 0 1 2\n", "fewer corners than it announces");
    expect_words("OFF\n4 1 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n4 0 1 2 4\n", "names point 4, but there are 4");
    expect_words("OFF\n4 1 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n9999999999 0 1 2 3\n", "1000 is the most");
    expect_words("OFF\n0 0 0\n", "holds no faces");
}

}  // namespace
}  // namespace qchopper
