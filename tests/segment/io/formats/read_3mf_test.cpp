#include "segment/io/formats/read_3mf.h"

#include <gtest/gtest.h>

#include "base/files/zip.h"
#include "segment/io/read_mesh.h"
#include "segment/io/write_3mf.h"
#include "segment/mesh/measure.h"
#include "tests/segment/io/help.h"
#include "tests/segment/io/wrappings.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

const TriangleMesh box = shapes::box({0, 0, 0}, {1, 2, 3});

RawMesh read(const std::string& model) {
    return parse_mesh(package_3mf({{"3D/3dmodel.model", model}}), "bone.3mf");
}
std::string refused(const std::string& model) {
    return refusal([&] { read(model); });
}

std::string item(int object, const std::string& transform = {}) {
    return "<item objectid=\"" + std::to_string(object) + "\"" +
           (transform.empty() ? "" : " transform=\"" + transform + "\"") + "/>";
}
std::string component(int object, const std::string& transform = {}) {
    return "<component objectid=\"" + std::to_string(object) + "\"" +
           (transform.empty() ? "" : " transform=\"" + transform + "\"") + "/>";
}
std::string object_of(int id, const std::string& components) {
    return "<object id=\"" + std::to_string(id) + "\"><components>" + components + "</components></object>";
}

TEST(Read3mf, GivesBackWhatWasWrittenBitForBit) {
    const TriangleMesh far = shapes::moved(box, {5e6 + 0.1, -5e6 + 0.3, 1.0 / 3});
    const Solid3mf solid{"A", &far, {}};
    const RawMesh scan = parse_mesh(to_3mf(std::span(&solid, 1), {}), "bone.3mf");
    EXPECT_EQ(scan.mesh, far);
    EXPECT_EQ(scan.format, MeshFormat::three_mf);
    EXPECT_EQ(scan.mm_per_unit, 1.0);
}

TEST(Read3mf, ReadsTheNamespaceOf2013) {
    const std::string now = model_3mf(object_3mf(box, 1), item(1, "1 0 0 0 1 0 0 0 1 5 6 7"), "unit=\"inch\"");
    const std::string today = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
    std::string before = now;
    before.replace(before.find(today), today.size(), "http://schemas.microsoft.com/3dmanufacturing/2013/01");
    EXPECT_EQ(read(before).mesh, read(now).mesh);
    EXPECT_EQ(read(before).mm_per_unit, 25.4);
    std::string other = now;
    other.replace(other.find(today), today.size(), "http://schemas.microsoft.com/3dmanufacturing/2012/01");
    EXPECT_NE(refused(other).find("it is not a 3MF model"), std::string::npos) << refused(other);
}

TEST(Read3mf, TakesTheUnitThatTheModelDeclares) {
    const std::pair<const char*, double> units[] = {{"", 1},
                                                    {"unit=\"micron\"", 0.001},
                                                    {"unit=\"millimeter\"", 1},
                                                    {"unit=\"centimeter\"", 10},
                                                    {"unit=\"inch\"", 25.4},
                                                    {"unit=\"foot\"", 304.8},
                                                    {"unit=\"meter\"", 1000}};
    for (const auto& [attribute, mm] : units) {
        EXPECT_EQ(read(model_3mf(object_3mf(box, 1), item(1), attribute)).mm_per_unit, mm) << attribute;
    }
    EXPECT_NE(refused(model_3mf(object_3mf(box, 1), item(1), "unit=\"ell\"")).find("unknown unit \"ell\""),
              std::string::npos);
}

TEST(Read3mf, PutsEveryItemInItsPlace) {
    // rows of the matrix are where x, y and z go: x to y, y to -x, and 10 up
    const RawMesh scan = read(model_3mf(object_3mf(box, 1), item(1) + item(1, "0 1 0 -1 0 0 0 0 1 0 0 10")));
    EXPECT_EQ(scan.faces_in_file, 24U);
    EXPECT_DOUBLE_EQ(volume_mm3(scan.mesh), 12);
    const Box all = bounds(scan.mesh);
    EXPECT_EQ(all.min, (Vec3{-2, 0, 0}));
    EXPECT_EQ(all.max, (Vec3{1, 2, 13}));
}

TEST(Read3mf, ComponentsAreTurnedOneInTheOther) {
    const std::string twice = "2 0 0 0 2 0 0 0 2 0 0 0";
    const std::string aside = "1 0 0 0 1 0 0 0 1 1 0 0";
    const RawMesh scan = read(model_3mf(
        object_3mf(box, 1) + object_of(2, component(1, aside)) + object_of(3, component(2, twice)), item(3, aside)));
    const Box all = bounds(scan.mesh);  // ((x + 1) * 2) + 1
    EXPECT_EQ(all.min, (Vec3{3, 0, 0}));
    EXPECT_EQ(all.max, (Vec3{5, 4, 6}));
    EXPECT_DOUBLE_EQ(volume_mm3(scan.mesh), 48);
}

TEST(Read3mf, AMirroredItemStillFacesOutward) {
    EXPECT_DOUBLE_EQ(volume_mm3(read(model_3mf(object_3mf(box, 1), item(1, "-1 0 0 0 1 0 0 0 1 0 0 0"))).mesh), 6);
}

TEST(Read3mf, LeavesOutWhatIsNotToBeMadeAndSaysSo) {
    const RawMesh scan = read(
        model_3mf(object_3mf(box, 1) + object_3mf(box, 2, "type=\"support\"") + object_3mf(box, 3), item(1) + item(2)));
    EXPECT_EQ(scan.mesh.triangles.size(), 12U);
    ASSERT_EQ(scan.warnings.size(), 1U);
    EXPECT_NE(scan.warnings[0].find("1 supports"), std::string::npos) << scan.warnings[0];
    EXPECT_NE(refused(model_3mf(object_3mf(box, 1), "")).find("its build is empty"), std::string::npos);
}

const std::string production =
    "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" requiredextensions=\"p\"";

TEST(Read3mf, FollowsTheProductionExtensionIntoOtherModelFiles) {
    const std::string root = model_3mf(
        "<object id=\"1\"><components><component objectid=\"7\" p:path=\"/3D/part.model\"/></components></object>",
        item(1) + "<item objectid=\"7\" p:path=\"/3D/part.model\"/>", production);
    const std::string part = model_3mf(object_of(7, component(8)) + object_3mf(box, 8), "");
    EXPECT_EQ(parse_mesh(package_3mf({{"3D/a.model", root}, {"3D/part.model", part}}), "a.3mf").mesh.triangles.size(),
              24U);
    const auto refuse = [&](const std::string& other, const std::string& path) {
        return refusal([&] { parse_mesh(package_3mf({{"3D/a.model", root}, {path, other}}), "a.3mf"); });
    };
    EXPECT_NE(refuse(part, "3D/other.model").find("names 3D/part.model, which is not in it"), std::string::npos);
    EXPECT_NE(refuse(model_3mf(object_3mf(box, 7), "", "unit=\"inch\""), "3D/part.model").find("another unit"),
              std::string::npos);
    EXPECT_NE(refuse(model_3mf(object_3mf(box, 8), ""), "3D/part.model").find("names object 7"), std::string::npos);
}

TEST(Read3mf, RefusesExtensionsThatItWouldHaveToKnow) {
    const std::string what =
        refused(model_3mf(object_3mf(box, 1), item(1),
                          "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" "
                          "requiredextensions=\"b\""));
    EXPECT_NE(what.find("beamlattice"), std::string::npos) << what;
    EXPECT_NE(refused(model_3mf(object_3mf(box, 1), item(1), "requiredextensions=\"zz\"")).find("needs zz"),
              std::string::npos);
}

// Ten objects that each hold the one before ten times are ten thousand million boxes in a few kilobytes.
TEST(Read3mf, RefusesToGrowWithoutBounds) {
    std::string objects = object_3mf(box, 1);
    std::string empty = object_of(1, "");
    for (int id = 2; id <= 11; ++id) {
        std::string ten;
        for (int i = 0; i < 10; ++i) ten += component(id - 1);
        objects += object_of(id, ten);
        empty += object_of(id, ten);
    }
    EXPECT_NE(refused(model_3mf(objects, item(11))).find("without end"), std::string::npos);
    EXPECT_NE(refused(model_3mf(empty, item(11))).find("without end"), std::string::npos);
    EXPECT_NE(refused(model_3mf(object_of(1, component(2)) + object_of(2, component(1)), item(1))).find("without end"),
              std::string::npos);
    const TriangleMesh large = shapes::box({0, 0, 0}, {1, 1, 1}, 30);
    std::string thousand;
    for (int i = 0; i < 1000; ++i) thousand += component(1);
    std::string ten_thousand;
    for (int i = 0; i < 10; ++i) ten_thousand += component(2);
    const std::string what =
        refused(model_3mf(object_3mf(large, 1) + object_of(2, thousand) + object_of(3, ten_thousand), item(3)));
    EXPECT_NE(what.find("more than 50 million"), std::string::npos) << what;
}

TEST(Read3mf, SaysWhatIsWrongAndWhere) {
    const auto expect_words = [](const std::string& model, const std::string& words) {
        SCOPED_TRACE(words);
        const std::string what = refused(model);
        EXPECT_NE(what.find(words), std::string::npos) << what;
        EXPECT_NE(what.find("bone.3mf"), std::string::npos) << what;
    };
    const std::string object = object_3mf(box, 1);
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = object;
        const std::size_t at = text.find(from);
        if (at == std::string::npos) throw std::runtime_error(from);
        return model_3mf(text.replace(at, from.size(), to), item(1));
    };
    expect_words(with("v1=\"", "v1=\"99"), "names vertex");
    expect_words(with("v1=\"", "v1=\"-1"), "v1 should be a number");
    expect_words(with("x=\"", "x=\"z"), "line 2 of the 3MF model: x should be a number");
    expect_words(with("x=\"", "x=\"1e999"), "x should be a number");
    expect_words(with("x=\"", "w=\""), "x should be a number, but is \"\"");
    expect_words(with("</mesh>", ""), "mismatched tag");
    expect_words(with("<vertices>", "<object id=\"9\">"), "an object in an object");
    expect_words(model_3mf(object + object, item(1)), "two objects 1");
    expect_words(model_3mf(object, item(2)), "names object 2, which is not in it");
    expect_words(model_3mf(object, item(1, "1 2 3")), "a transform needs twelve numbers");
    expect_words(model_3mf(object, item(1, "1e300 0 0 0 1 0 0 0 1 1e308 0 0") +
                                       item(1, "1e308 0 0 0 1e308 0 0 0 1e308 1e308 1e308 1e308")),
                 "not a finite number");
    expect_words("<!DOCTYPE model [<!ENTITY a \"b\">]>" + model_3mf(object, item(1)).substr(38), "a document type");
    expect_words("<svg/>", "it is not a 3MF model");
    expect_words("", "no element found");
}

TEST(Read3mf, FindsTheModelWithoutItsRelations) {
    const std::string model = model_3mf(object_3mf(box, 1), item(1));
    const Bytes bytes(model.begin(), model.end());
    EXPECT_EQ(parse_mesh(zip({zip_entry("3D/3dmodel.model", bytes)}), "a.3mf").mesh.triangles.size(), 12U);
    const std::string what = refusal([&] { parse_mesh(zip({zip_entry("scan.ply", bytes)}), "a.zip"); });
    EXPECT_NE(what.find("is a ZIP, but no 3MF"), std::string::npos) << what;
}

TEST(Read3mf, RefusesABombBeforeItGoesOff) {
    const std::string what = refused(model_3mf(std::string(100 << 20, ' '), ""));
    EXPECT_NE(what.find("unpacks to more than 64 MiB"), std::string::npos) << what;
}

}  // namespace
}  // namespace qchopper
