// A plane tried by setups on a copy: what setup says of the pieces once the plane is decided, and nothing is changed.

#include <gtest/gtest.h>
#include <unistd.h>

#include "app/engine/decide.h"
#include "app/store/project_folder.h"
#include "app/store/replay.h"
#include "base/error.h"
#include "base/files/file.h"
#include "segment/mesh/measure.h"
#include "tests/app/engine/planned.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct PlaneSetupsOf : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("plane_setups" + std::to_string(::getpid()));
    TriangleMesh mesh;

    ~PlaneSetupsOf() override { fs::remove_all(folder); }
    // Uncut, with this cell; "": none.
    void make(const TriangleMesh& scan, const std::string& cell) {
        mesh = scan;
        fs::remove_all(folder);
        fs::create_directories(folder);
        if (!cell.empty()) fs::copy_file(fs::path(QCHOPPER_SOURCE_DIR) / "cells" / cell, folder / "cell.toml");
        save_project(folder, planned::project_of(mesh, {0, 0, 0}, 0));
    }
    OpenProject open() const {
        return {folder, load_project(folder), [this] { return mesh; }};
    }
    std::string bytes() const {
        const Bytes b = read_file(folder / "project.json");
        return {b.begin(), b.end()};
    }
};

SegmentAnswer previewed(OpenProject& project, const Plane& plane) {
    ProjectRequest request;
    request.preview = plane;
    request.preview_setups = true;
    return decide(project, request, {});
}

void expect_areas_of(const PlanePiece& part, const std::string& what) {
    const SurfaceAreas& a = part.areas;
    const double all = area_mm2(*part.piece.mesh);
    EXPECT_NEAR(a.reached + a.too_narrow + a.steep + a.holder + a.hidden + a.ignored + a.sawn + a.base, all, 1e-9 * all)
        << what;
    const Setup& setup = part.setups.piece_setup.setup();
    double base = 0;
    for (std::size_t t = 0; t < part.piece.mesh->triangles.size(); ++t) {
        const bool is_base = setup.base && cap_of(*part.piece.mesh, t) == *setup.base;
        if (is_base) base += norm(area_vector(*part.piece.mesh, t));
    }
    EXPECT_NEAR(a.base, base, 1e-9 * all) << what;
    // Triangles count whole: no triangle is more than a part of what is reached and of what is not.
    const SurfaceAccess& access = setup.access;
    EXPECT_NEAR(a.hidden + a.holder + a.steep, access.hidden_mm2 + access.holder_mm2 + access.steep_mm2,
                0.05 * access.area_mm2)
        << what;
}

TEST_F(PlaneSetupsOf, AreThoseOfThePiecesOnceThePlaneIsDecided) {
    const std::vector<std::pair<std::string, TriangleMesh>> scans{
        {"stairs", shapes::stairs()},
        {"torus", shapes::torus({0, 0, 0}, 90, 30)},
        {"box", shapes::box({-150, -100, -80}, {150, 100, 80}, 6)},
        {"two balls", shapes::joined({shapes::ball({-90, 0, 0}, 60), shapes::ball({90, 0, 5}, 60)})}};
    for (const char* cell : {"foam-1.toml", "kr60-ha.toml"}) {
        for (const auto& [name, scan] : scans) {
            make(scan, cell);
            const std::string what = name + " in " + cell;
            OpenProject project = open();
            const Extent range = extent(mesh, {0, 0, 1});
            const Plane plane{{0, 0, 1}, range.low + 0.37 * range.size()};
            const std::string before = bytes();
            const std::size_t pieces = project.segmentation().pieces.size();
            const SegmentAnswer answer = previewed(project, plane);
            ASSERT_TRUE(answer.preview && answer.preview->setups) << what;
            const PlaneSetups& tried = *answer.preview->setups;
            EXPECT_EQ(bytes(), before) << what;
            EXPECT_EQ(project.segmentation().pieces.size(), pieces) << what;
            std::size_t solids = 0;
            for (const SolidEvaluation& s : answer.preview->solids) solids += s.volume_mm3 > 0 ? 1 : 0;
            EXPECT_EQ(tried.pieces.size(), solids) << what;

            ProjectRequest cut;
            cut.plane = plane;
            EXPECT_TRUE(decide(project, cut, {}).is_demand_met) << what;
            OpenProject decided = open();  // knows nothing of what was tried
            std::size_t found = 0;
            for (const Piece& piece : decided.segmentation().pieces) {
                for (const PlanePiece& part : tried.pieces) {
                    if (part.piece.name != piece.name) continue;
                    ++found;
                    const PlacedSetup& placed = decided.setups()->placed(piece);
                    EXPECT_EQ(part.setups.piece_setup.choice.setups, placed.choice.setups) << what;
                    EXPECT_EQ(part.setups.piece_setup.choice.states, placed.choice.states) << what;
                    EXPECT_EQ(part.setups.piece_setup.stock_fit, placed.stock_fit) << what;
                    EXPECT_EQ(part.setups.piece_setup.machine_reachability, placed.machine_reachability) << what;
                    EXPECT_EQ(part.is_above, piece.half_spaces.back().above) << what;
                    expect_areas_of(part, what);
                }
            }
            EXPECT_EQ(found, tried.pieces.size()) << what;
        }
    }
}

TEST_F(PlaneSetupsOf, NeedACellAndAPlaneThatParts) {
    make(shapes::box({-150, -100, -80}, {150, 100, 80}, 6), "");
    OpenProject without = open();
    EXPECT_THROW(previewed(without, {{0, 0, 1}, 3.3}), InputError);
    make(mesh, "foam-1.toml");
    OpenProject project = open();
    EXPECT_FALSE(previewed(project, {{0, 0, 1}, 300}).preview) << "it misses";
    ProjectRequest request;
    request.preview = Plane{{0, 0, 1}, 3.3};
    EXPECT_FALSE(decide(project, request, {}).preview->setups) << "they were not asked for";
}

}  // namespace
}  // namespace qchopper
