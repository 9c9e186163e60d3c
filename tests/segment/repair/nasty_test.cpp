// Every file of the folder `nasty` has one row: what repair makes of it, or why it is refused. The table is a sample of
// kinds; nothing in the program is special to any of these files.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <random>

#include "segment/cut/cut.h"
#include "segment/cut/nudge.h"
#include "segment/import/import_scan.h"
#include "segment/import/inspect.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "tests/segment/io/help.h"

namespace qchopper {
namespace {

constexpr std::size_t refused = 0;  // with InputFault::mesh, for which the program ends with 65

struct Row {
    const char* file;
    std::size_t faces;               // of the result
    std::vector<std::string> words;  // of the steps ("step: words"; of STL without the weld), or the refusal
};
void PrintTo(const Row& row, std::ostream* out) {
    *out << row.file;
}

const Row rows[] = {
    {"assimp_OBJ_box_UTF16BE.obj", 12, {}},
    {"assimp_OBJ_concave_polygon.obj", refused, {"is open: 1 open component encloses nothing"}},
    {"assimp_OBJ_regr01.obj",
     2760,
     {"weld: 837 points welded", "faces: 6 faces of flat doubled components dropped",
      "split: 28 edges of more than two faces split, 79 copies of points made",
      "degenerate: 10 faces without area removed",
      "fill: 4 holes closed, with 62 faces, 3 of them faired, 13 points added, 1 open component dropped",
      "fragments: 1 fragment with 0.038 % of the surface kept"}},
    {"assimp_PLY_cube_uv.ply", 12, {"weld: 16 points welded"}},
    {"assimp_PLY_issue623.ply", refused, {"holds no faces"}},
    {"assimp_STL_triangle_with_two_solids.stl", refused, {"is open: 2 open components enclose nothing"}},
    {"assimp_invalid_empty.ply", refused, {"is empty"}},
    {"assimp_invalid_malformed.obj", refused, {"line 28 of the OBJ: a face names point 0, but there are 8"}},
    {"cgal_blobby-shuffled.off", 4050, {"orient: 2,017 faces turned to agree with their neighbours"}},
    {"cgal_bones.off", 4204, {}},
    {"cgal_colored_tetra.ply", 4, {}},
    {"cgal_cow.off", 5804, {"weld: 1 point welded", "split: 1 copy of a point made"}},
    {"cgal_cube_quad.off", 12, {}},
    {"cgal_degtri_sliding.off", refused, {"is open: 1 open component encloses nothing"}},
    {"cgal_diplodocus.off",
     47960,
     {"weld: 2 points welded", "split: 2 edges of more than two faces split, 2 copies of points made"}},
    {"cgal_elephant-with-holes.off",
     5580,
     {"weld: 65 points welded", "split: 65 copies of points made",
      "fill: 106 holes closed, with 1,117 faces, 1 of them faired, 2 points added"}},
    {"cgal_knot2.off", 11520, {}},
    {"cgal_pig.stl", refused, {"is open: 11 open components enclose nothing"}},
    {"cgal_tetra_intersected_by_triangle.off", refused, {"is open: 1 open component encloses nothing"}},
    {"cgal_tetrahedron.off", 4, {"orient_outward: 1 shell turned outwards"}},
    {"common_data_igea.ply", 268686, {}},
    {"lib3mf_TestFiles_CPP_UnitTests_3mfbase11_AdjMount.3mf", 1704, {}},
    {"made_count_lies.stl", refused, {"a binary STL of 5000 triangles has 250084 bytes, but the file has 25084"}},
    {"made_far_from_origin.stl",
     69372,
     {"degenerate: 66 faces without area removed", "fill: 5 holes closed, with 213 faces"}},
    {"made_flipped_half.stl",
     69664,
     {"orient: 34,725 faces turned to agree with their neighbours", "fill: 5 holes closed, with 213 faces"}},
    {"made_header_solid_binary.stl", refused, {"is open: 1,549 open components enclose nothing"}},
    {"made_inside_out.stl", 69664, {"fill: 5 holes closed, with 213 faces", "orient_outward: 1 shell turned outwards"}},
    {"made_nan_inf.stl", refused, {"vertex 1 of triangle 17 (byte 958) has a coordinate that is not a finite number"}},
    {"made_nested_cavity_cube.stl", 24, {}},
    {"made_truncated.stl", refused, {"a binary STL of 69451 triangles has 3472634 bytes, but the file has 2000000"}},
    {"manifold_extras_ember_tests_testfiles_raw_meshes_472042.stl", 3632, {}},
    {"manifold_self_intersectA.obj", 17160, {}},
    {"ocl_stl_mount_rush.stl", refused, {"is open: 44 open components enclose nothing"}},
    {"pmp_data_off_hole_capsule.off", 192, {"fill: 3 holes closed, with 40 faces, 3 of them faired, 9 points added"}},
    {"pychop3d_test_past_failures_bracket.stl", 2386, {}},
    {"pychop3d_test_past_failures_electronics_housing.stl", 3412, {}},
    {"pychop3d_test_past_failures_tadpole.stl", 1426, {}},
    {"pychop3d_test_test_meshes_fragility_test_1.stl", 244, {}},
    {"pychop3d_test_test_meshes_wing.stl",
     8192,
     {"degenerate: 50 faces without area removed, 95 faces without area left", "fill: 2 holes closed, with 160 faces"}},
    {"slic3r-prusa_tests_data_extruder_idler_quads.obj", 7334, {"faces: 10 faces of flat doubled components dropped"}},
    {"slic3r-prusa_tests_data_test_stl_ASCII_20mmbox-CR.stl", 12, {}},
    {"trimesh_box.STL", 8954, {}},
    {"trimesh_counterXP.3MF", 83750, {"weld: 1,149 points welded, 290 unused points dropped"}},
    {"trimesh_cube_and_sphere_same_name.3mf", 5132, {}},
    {"trimesh_fuze_ascii.ply", 1000, {}},
    {"trimesh_joined_tetrahedra.obj", 6, {"faces: 2 faces of flat doubled components dropped"}},
    {"trimesh_multibody.stl",
     32,
     {"orient: 6 faces turned to agree with their neighbours", "orient_outward: 2 shells turned outwards"}},
    {"trimesh_negative_indices.obj", 12, {}},
    {"trimesh_nested.glb", 36, {"weld: 48 points welded"}},
    {"trimesh_origin_inside.STL", 28, {}},
    {"trimesh_plate_holes.STL", 1252, {}},
    {"trimesh_simple_pole.glb", 580, {"weld: 624 points welded"}},
    {"trimesh_soup.stl", refused, {"is open: 100 open components enclose nothing"}},
};

ImportOptions options() {
    ImportOptions options;
    options.may_lack_unit = true;
    return options;
}

std::vector<std::string> words_of(const RepairReport& report) {
    std::vector<std::string> all;
    for (const RepairStep& step : steps(report)) {
        if (step.count > 0) all.push_back(step.name + ": " + step.words);
    }
    return all;
}

// Each face by its corners in ascending order, ascending.
std::vector<std::array<std::array<double, 3>, 3>> faces_by_place(const TriangleMesh& mesh) {
    std::vector<std::array<std::array<double, 3>, 3>> all;
    for (const Triangle& t : mesh.triangles) {
        std::array<std::array<double, 3>, 3> face{};
        for (std::size_t i = 0; i < 3; ++i) face[i] = {mesh.points[t[i]].x, mesh.points[t[i]].y, mesh.points[t[i]].z};
        std::sort(face.begin(), face.end());
        all.push_back(face);
    }
    std::sort(all.begin(), all.end());
    return all;
}

// As many faces as the report says lie, to the last bit, where the scan had them.
void expect_untouched(const RepairedScan& scan, const TriangleMesh& before) {
    const auto scanned = faces_by_place(before);
    std::size_t kept = 0;
    for (const auto& face : faces_by_place(scan.mesh)) {
        kept += std::binary_search(scanned.begin(), scanned.end(), face);
    }
    EXPECT_GE(kept, scan.report.faces_out - scan.report.faces_new);
    EXPECT_EQ(scan.report.faces_out - scan.report.faces_new, scan.report.faces_in - scan.report.faces_gone);
}

// The cutter's own condition, and 20 cuts by random planes through the box.
void expect_it_can_be_cut(TriangleMesh mesh) {
    ASSERT_TRUE(edges(mesh).faults.is_closed());
    const Vec3 centre = bounds(mesh).centre();
    for (Vec3& p : mesh.points) p = p - centre;
    const double volume = volume_mm3(mesh);
    ASSERT_GT(volume, 0);
    Piece piece;
    piece.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    std::mt19937 random(1);
    std::normal_distribution<double> direction;
    std::uniform_real_distribution<double> share(0.05, 0.95);
    int made = 0;
    for (int i = 0; i < 20; ++i) {
        const Vec3 normal =
            canonical({normalized(Vec3{direction(random), direction(random), direction(random)}), 0}).normal;
        const Extent reach = extent(*piece.mesh, normal);
        const double wanted = reach.low + share(random) * reach.size();
        const auto nudged = nudge(piece, normal, std::array{wanted});
        ASSERT_TRUE(nudged[0].has_value());
        const std::optional<CutHalves> halves = cut(*piece.mesh, {normal, nudged[0]->offset}, 1);
        if (!halves) continue;  // between two solids
        ++made;
        EXPECT_TRUE(edges(halves->above.mesh).faults.is_closed()) << i;
        EXPECT_TRUE(edges(halves->below.mesh).faults.is_closed()) << i;
        EXPECT_NEAR((volume_mm3(halves->above.mesh) + volume_mm3(halves->below.mesh)) / volume, 1, 1e-9) << i;
    }
    EXPECT_GE(made, 15);
}

void expect_a_solid_once_and_for_all(const TriangleMesh& mesh, const RepairOptions& again) {
    EXPECT_EQ(repair(mesh, again).mesh, mesh);
    expect_it_can_be_cut(mesh);
}

class Nasty : public testing::TestWithParam<Row> {
 protected:
    std::filesystem::path path() const { return real_mesh("nasty") / GetParam().file; }
};

TEST_P(Nasty, IsRepairedOrRefusedWithWords) {
    NEEDS_MESH(std::string("nasty/") + GetParam().file);
    const Row& row = GetParam();
    if (row.faces == refused) {
        const std::string what = refusal([&] { repair_scan(path(), options()); });
        EXPECT_NE(what.find(row.file), std::string::npos) << what;
        for (const std::string& words : row.words) EXPECT_NE(what.find(words), std::string::npos) << what;
        return;
    }
    const RepairedScan scan = repair_scan(path(), options());
    EXPECT_EQ(scan.mesh.triangles.size(), row.faces);
    EXPECT_EQ(scan.report.faces_out, row.faces);
    EXPECT_TRUE(scan.report.is_solid());
    EXPECT_GT(scan.report.volume, 0);
    std::vector<std::string> words = words_of(scan.report);
    const bool is_stl = scan.format == MeshFormat::stl_ascii || scan.format == MeshFormat::stl_binary;
    if (is_stl) std::erase_if(words, [](const std::string& w) { return w.starts_with("weld:"); });
    EXPECT_EQ(words, row.words);
    expect_untouched(scan, read_mesh(path()).mesh);
    expect_a_solid_once_and_for_all(scan.mesh, {});
    RawMesh result;
    result.mesh = scan.mesh;
    if (scan.report.degenerate_left == 0) {
        EXPECT_EQ(judge(inspect(result)).verdict, Verdict::ready);
    }
}

TEST_P(Nasty, StaysASolidWhenSelfIntersectionsAreResolved) {
    NEEDS_MESH(std::string("nasty/") + GetParam().file);
    if (GetParam().faces == refused) return;
    ImportOptions resolving = options();
    resolving.repair.resolve_self_intersections = true;
    const RepairedScan scan = repair_scan(path(), resolving);
    ASSERT_TRUE(scan.report.resolved.has_value());
    EXPECT_LE(scan.report.resolved->left, scan.report.resolved->pairs);
    expect_untouched(scan, read_mesh(path()).mesh);
    if (scan.report.resolved->pairs > 0) expect_a_solid_once_and_for_all(scan.mesh, resolving.repair);
}

std::string name_of_row(const testing::TestParamInfo<Row>& info) {
    std::string name = info.param.file;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Every, Nasty, testing::ValuesIn(rows), name_of_row);

TEST(NastyTable, HasARowForEveryFile) {
    NEEDS_MESH("nasty");
    for (const auto& entry : std::filesystem::directory_iterator(real_mesh("nasty"))) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(std::any_of(std::begin(rows), std::end(rows), [&](const Row& row) { return name == row.file; }))
            << name;
    }
}

}  // namespace
}  // namespace qchopper
