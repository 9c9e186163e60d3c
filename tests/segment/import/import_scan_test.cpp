#include "segment/import/import_scan.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "segment/io/write_mesh.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/shells.h"
#include "segment/mesh/measure.h"
#include "tests/segment/io/help.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// A file that lives as long as the test.
struct TemporaryFile {
    std::filesystem::path path;
    explicit TemporaryFile(const Bytes& bytes) {
        const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
        path = std::filesystem::temp_directory_path() /
               (std::string("qchopper_") + test->name() + "_" + std::to_string(::getpid()));
        write_file(path, bytes);
    }
    ~TemporaryFile() { std::filesystem::remove(path); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
};

ImportedScan imported_from(const TriangleMesh& mesh, const ImportOptions& options = {1, 1}) {
    return import_scan(TemporaryFile(to_ply(mesh)).path, options);
}

std::string refused(const TriangleMesh& mesh) {
    return refusal([&] { imported_from(mesh); });
}

bool has_warning(const ImportReport& report, const std::string& words) {
    return std::any_of(report.warnings.begin(), report.warnings.end(),
                       [&](const std::string& w) { return w.find(words) != std::string::npos; });
}

TEST(ImportedScan, EveryClosedShapeComesOutAsItWentIn) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        const TriangleMesh mesh = shapes::moved(shape.mesh, {1000, -2000, 500});
        const ImportedScan imported = imported_from(mesh);
        EXPECT_EQ(imported.mesh.triangles, mesh.triangles) << shape.name;
        EXPECT_TRUE(edges(imported.mesh).faults.is_closed()) << shape.name;
        EXPECT_NEAR(norm(bounds(imported.mesh).centre()), 0, 1e-9) << shape.name;
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            EXPECT_NEAR(norm(imported.mesh.points[v] + imported.centre - mesh.points[v]), 0, 1e-9) << shape.name;
        }
        EXPECT_EQ(imported.sha256, sha256(to_ply(mesh)));
        EXPECT_EQ(imported.report.repair.faces_in, mesh.triangles.size());
        EXPECT_EQ(imported.report.repair.shells, shells(mesh).count());
        EXPECT_EQ(imported.report.repair.shells_reoriented, 0U) << shape.name;
    }
}

TEST(ImportedScan, FormatDoesNotMatter) {
    const TriangleMesh ball = shapes::ball({5, 5, 5}, 50, 20);
    const ImportedScan from_ply = imported_from(ball);
    const ImportedScan from_stl = import_scan(TemporaryFile(to_stl(ball)).path, {1, 1});
    EXPECT_EQ(from_stl.mesh.triangles.size(), from_ply.mesh.triangles.size());
    EXPECT_EQ(from_stl.mesh.points.size(), from_ply.mesh.points.size());
    EXPECT_NEAR(volume_mm3(from_stl.mesh) / volume_mm3(from_ply.mesh), 1, 1e-6);
}

// As far as 100,000 km from the origin of the file, whatever its unit.
TEST(ImportedScan, TooFarFromItsOriginIsSoInTrueSize) {
    const double metre = 1000;
    const auto refusal_at = [&](double x, double mm_per_unit, double scale) {
        const TriangleMesh box = shapes::moved(shapes::box({0, 0, 0}, {1024, 1024, 1024}), {x, 0, 0});
        return refusal([&] { imported_from(box, {mm_per_unit, scale}); });
    };
    EXPECT_NE(refusal_at(2e8, metre, 1).find("100 000 km"), std::string::npos) << "200,000 km in metres";
    EXPECT_NE(refusal_at(-2e8, metre, 1).find("100 000 km"), std::string::npos);
    const TriangleMesh in_mm = shapes::moved(shapes::box({0, 0, 0}, {1024, 1024, 1024}), {2e8, 0, 0});
    EXPECT_NO_THROW(imported_from(in_mm, {1, 1})) << "200 km";
    EXPECT_NE(refusal_at(2e8, 1, metre).find("100 000 km"), std::string::npos) << "the scale counts";
}

TEST(ImportedScan, UnitsAndScaleEnlarge) {
    const TriangleMesh box = shapes::box({1, 1, 1}, {2, 3, 4});
    const ImportedScan inches = imported_from(box, {mm_per(unit_named("in")), 1});
    EXPECT_NEAR(volume_mm3(inches.mesh), 6 * 25.4 * 25.4 * 25.4, 1e-6);
    EXPECT_FALSE(has_warning(inches.report, "is scaled by"));
    const ImportedScan twice = imported_from(box, {mm_per(unit_named("cm")), 2});
    EXPECT_NEAR(volume_mm3(twice.mesh), 6 * 8000, 1e-6);
    EXPECT_TRUE(has_warning(twice.report, "is scaled by"));
    EXPECT_EQ(twice.centre, (Vec3{30, 40, 50}));
}

TEST(ImportedScan, WarnsOfAnUnlikelySize) {
    EXPECT_TRUE(has_warning(imported_from(shapes::box({0, 0, 0}, {1, 1, 1})).report, "is its unit right"));
    EXPECT_TRUE(has_warning(imported_from(shapes::box({0, 0, 0}, {1, 1, 1}), {1e5, 1}).report, "is its unit right"));
    EXPECT_FALSE(has_warning(imported_from(shapes::box({0, 0, 0}, {1, 1, 1}), {1000, 1}).report, "is its unit right"));
}

TEST(ImportedScan, UnitsHaveNames) {
    EXPECT_EQ(mm_per(unit_named("mm")), 1);
    EXPECT_EQ(mm_per(unit_named("cm")), 10);
    EXPECT_EQ(mm_per(unit_named("m")), 1000);
    EXPECT_EQ(mm_per(unit_named("in")), 25.4);
    EXPECT_EQ(name_of(Unit::in), "in");
    for (const char* wrong : {"", "furlong", "MM", "meter"}) {
        try {
            unit_named(wrong);
            ADD_FAILURE() << wrong;
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::use);
        }
    }
}

TEST(ImportedScan, RefusesImpossibleScales) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1});
    for (const ImportOptions& options :
         {ImportOptions{0, 1}, ImportOptions{1, -1}, ImportOptions{1, std::nan("")}, ImportOptions{1e300, 1e300}}) {
        try {
            imported_from(box, options);
            ADD_FAILURE();
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::use);
        }
    }
}

TEST(ImportedScan, TurnsWhatIsInsideOutAndKeepsCavities) {
    const TriangleMesh hollow =
        shapes::joined({shapes::box({0, 0, 0}, {9, 9, 9}), shapes::turned_inside_out(shapes::ball({4, 4, 4}, 2)),
                        shapes::ball({20, 4, 4}, 3)});
    const double volume = volume_mm3(hollow);
    const ImportedScan kept = imported_from(hollow);
    EXPECT_EQ(kept.report.repair.shells_reoriented, 0U);
    EXPECT_EQ(kept.report.repair.cavities, 1U);
    EXPECT_NEAR(volume_mm3(kept.mesh), volume, 1e-9 * volume);

    const ImportedScan turned = imported_from(shapes::turned_inside_out(hollow));
    EXPECT_EQ(turned.report.repair.shells_reoriented, 3U);
    EXPECT_EQ(turned.report.repair.cavities, 1U);
    EXPECT_NEAR(volume_mm3(turned.mesh), volume, 1e-9 * volume);
    EXPECT_TRUE(has_warning(turned.report, "inside out"));
}

TEST(ImportedScan, WarnsOfSolidsInSolids) {
    const ImportedScan imported =
        imported_from(shapes::joined({shapes::box({0, 0, 0}, {90, 90, 90}), shapes::ball({40, 40, 40}, 20)}));
    EXPECT_EQ(imported.report.repair.shells_reoriented, 0U);
    EXPECT_TRUE(has_warning(imported.report, "overlaps itself"));
}

TEST(ImportedScan, SplitsSurfacesThatOnlyTouch) {
    const ImportedScan imported =
        imported_from(shapes::joined({shapes::box({0, 0, 0}, {10, 10, 10}), shapes::box({10, 10, 10}, {20, 20, 20})}));
    EXPECT_EQ(imported.report.repair.welded, 1U);
    EXPECT_EQ(imported.report.repair.points_copied, 1U);
    EXPECT_EQ(imported.report.repair.shells, 2U);
}

TEST(ImportedScan, ClosesHolesThatTouch) {
    TriangleMesh box = shapes::box({0, 0, 0}, {40, 40, 40}, 4);
    std::erase_if(box.triangles, [&](const Triangle& t) {
        const Vec3 middle = (1.0 / 3) * (box.points[t[0]] + box.points[t[1]] + box.points[t[2]]);
        const bool first = middle.x > 10 && middle.x < 20 && middle.y > 10 && middle.y < 20;
        const bool second = middle.x > 20 && middle.x < 30 && middle.y > 20 && middle.y < 30;
        return middle.z == 40 && (first || second);
    });
    const ImportedScan imported = imported_from(box);
    EXPECT_EQ(imported.report.repair.points_copied, 1U);
    EXPECT_EQ(imported.report.repair.holes_filled, 1U);  // the two have become one
    EXPECT_EQ(imported.report.repair.faces_added, 4U);
    EXPECT_NEAR(volume_mm3(imported.mesh), 64000, 1e-9);
    EXPECT_TRUE(has_warning(imported.report, "1 hole closed"));
}

TEST(ImportedScan, RefusesWhatIsNoSolidWithThePlace) {
    const TriangleMesh box = shapes::moved(shapes::box({0, 0, 0}, {10, 10, 10}, 2), {100, 0, 0});
    TriangleMesh fin = box;
    const Triangle side = box.triangles[0];
    fin.points.push_back({130, 0, 20});
    fin.triangles.push_back({side[0], side[1], static_cast<std::uint32_t>(fin.points.size() - 1)});
    const std::string large_fin = refused(fin);
    EXPECT_NE(large_fin.find("1 open component encloses nothing"), std::string::npos) << large_fin;
    EXPECT_NE(large_fin.find("the first around (1"), std::string::npos) << large_fin;  // the file's coordinates

    TriangleMesh open_component = box;
    open_component.triangles.resize(1);
    EXPECT_NE(refused(open_component).find("open"), std::string::npos);

    TriangleMesh line = box;
    line.triangles = {{0, 1, 0}, {1, 1, 1}};
    EXPECT_NE(refused(line).find("no face has an area"), std::string::npos);

    EXPECT_NE(refused(shapes::moved(box, {1e300, 0, 0})).find("100 000 km"), std::string::npos);
}

TEST(ImportedScan, RepairsEdgesThatAreNotManifold) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10}, 2);
    TriangleMesh turned = box;
    std::swap(turned.triangles[3][0], turned.triangles[3][1]);
    const ImportedScan agreeing = imported_from(turned);
    EXPECT_EQ(agreeing.report.repair.faces_reoriented, 1U);
    EXPECT_NEAR(volume_mm3(agreeing.mesh), 1000, 1e-9);
    EXPECT_TRUE(has_warning(agreeing.report, "1 face was turned"));

    TriangleMesh fin = box;
    const Triangle side = box.triangles[0];
    fin.points.push_back(fin.points[side[0]] + Vec3{0.01, 0.01, 0.01});
    fin.triangles.push_back({side[0], side[1], static_cast<std::uint32_t>(fin.points.size() - 1)});
    const ImportedScan split = imported_from(fin);
    EXPECT_EQ(split.mesh.triangles.size(), box.triangles.size());
    EXPECT_TRUE(has_warning(split.report, "1 edge belonged to three faces"));
    EXPECT_TRUE(has_warning(split.report, "1 small open component"));
}

TEST(ImportedScan, PlacesInErrorsAreInTheUnitsOfTheFile) {
    TriangleMesh open_component = shapes::moved(shapes::box({0, 0, 0}, {1, 1, 1}), {7, 7, 7});
    open_component.triangles.resize(2);
    const std::string what = refusal([&] { imported_from(open_component, {25.4, 3}); });
    EXPECT_TRUE(what.find("(7.5, ") != std::string::npos || what.find("(8, ") != std::string::npos) << what;
}

TEST(ImportedScan, AsksForAMissingUnit) {
    try {
        imported_from(shapes::box({0, 0, 0}, {1, 1, 1}), {});
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::use);
        EXPECT_EQ(error.to_do.key, "give_unit");
    }
}

TEST(ImportedScan, UnitsHaveLengths) {
    for (const Unit unit : {Unit::mm, Unit::cm, Unit::m, Unit::in, Unit::ft, Unit::um}) {
        EXPECT_EQ(unit_of(mm_per(unit)), unit);
        EXPECT_EQ(unit_named(name_of(unit)), unit);
    }
    EXPECT_THROW(unit_of(17), InputError);
}

TEST(ImportedScan, RepairsInTheUnitAndPlaceOfTheFile) {
    TriangleMesh open = shapes::moved(shapes::ball({0, 0, 0}, 3, 12), {1.0 / 3, 1e5, -7.1});
    open.triangles.pop_back();
    ImportOptions options;
    options.may_lack_unit = true;
    const TemporaryFile file(to_ply(open));
    const RepairedScan scan = repair_scan(file.path, options);
    EXPECT_FALSE(scan.mm_per_unit.has_value());
    EXPECT_EQ(scan.mesh.points, open.points);
    EXPECT_EQ(scan.mesh.triangles.size(), open.triangles.size() + 1);
    options.repair.fill.fill = Fill::none;
    EXPECT_EQ(repair_scan(file.path, options).report.open_edges, 3U);
    EXPECT_NE(refusal([&] { import_scan(file.path, options); }).find("1 hole cannot be closed"), std::string::npos);
}

TEST(ImportedScan, StopsWhenAsked) {
    const std::atomic<bool> stop = true;
    Context context;
    context.cancelled = &stop;
    const TemporaryFile file(to_ply(shapes::ball({0, 0, 0}, 10)));
    EXPECT_THROW(import_scan(file.path, {1, 1}, context), Cancelled);
}

struct RealScan {
    std::string name;
    std::size_t faces;
    std::size_t shells;
    std::size_t collapsed;
    std::size_t holes;
};

TEST(ImportedScan, ImportsTheRealScans) {
    NEEDS_MESH("bunny_bun_zipper.ply");
    const RealScan scans[] = {{"bunny_bun_zipper.ply", 69664, 1, 0, 5},
                              {"ct_head_371k.ply", 371162, 222, 6, 0},
                              {"dragon_vrip_871k.ply", 871306, 1, 108, 0},
                              {"igea_268k.ply", 268686, 1, 0, 0},
                              {"femur_3548.stl", 3548, 1, 0, 0},
                              {"skull_scan_25k.stl", 25098, 1, 0, 0},
                              {"gorilla_skull_159k.ply", 161200, 1, 0, 409},
                              {"nasty/made_flipped_half.stl", 69664, 1, 0, 5},
                              {"nasty/trimesh_multibody.stl", 32, 2, 0, 0},
                              {"nasty/made_inside_out.stl", 69664, 1, 0, 5},
                              {"nasty/made_nested_cavity_cube.stl", 24, 2, 0, 0},
                              {"nasty/slic3r-prusa_tests_data_test_stl_ASCII_20mmbox-CR.stl", 12, 1, 0, 0}};
    for (const RealScan& scan : scans) {
        SCOPED_TRACE(scan.name);
        const ImportedScan imported = import_scan(real_mesh(scan.name), {1000, 1});
        EXPECT_EQ(imported.mesh.triangles.size(), scan.faces);
        EXPECT_EQ(imported.report.repair.shells, scan.shells);
        EXPECT_EQ(imported.report.repair.collapsed, scan.collapsed);
        EXPECT_EQ(imported.report.repair.holes_filled, scan.holes);
        EXPECT_TRUE(edges(imported.mesh).faults.is_closed());
        EXPECT_GT(volume_mm3(imported.mesh), 0);
    }
    EXPECT_EQ(import_scan(real_mesh("ct_head_371k.ply"), {1, 1}).report.repair.cavities, 39U);
    EXPECT_EQ(import_scan(real_mesh("nasty/made_inside_out.stl"), {1000, 1}).report.repair.shells_reoriented, 1U);
}

TEST(ImportedScan, RefusesTheRealScansThatAreNoSolids) {
    NEEDS_MESH("nasty");
    for (const char* name : {"nasty/trimesh_soup.stl", "nasty/ocl_stl_mount_rush.stl", "nasty/made_truncated.stl",
                             "nasty/assimp_STL_triangle_with_two_solids.stl", "nasty/cgal_pig.stl"}) {
        SCOPED_TRACE(name);
        EXPECT_NE(refusal([&] { import_scan(real_mesh(name), {1, 1}); }).find(name), std::string::npos);
    }
}

}  // namespace
}  // namespace qchopper
