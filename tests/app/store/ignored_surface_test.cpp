// Surface that may stay: what a project keeps of it, and what is refused.

#include "app/store/ignored_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/engine/make_project.h"
#include "app/store/caches/distance_store.h"
#include "app/store/project_folder.h"
#include "app/store/project_json.h"
#include "base/error.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/measure.h"
#include "segment/search/segmentation.h"
#include "tests/folder.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr double top = 30;

struct IgnoredSurfaceFiles : ::testing::Test {
    Folder folder;
    const TriangleMesh mesh = shapes::ball({100, 200, 0}, 50, 32);  // in the unit of the file
    fs::path scan = folder.path / "scan.ply";
    fs::path painted = folder.path / "painted.ply";
    fs::path project = folder.path / "p.qch";

    void SetUp() override { write_file(scan, to_ply(mesh)); }

    // A text PLY with a property that is 1 above a height.
    void paint(const TriangleMesh& surface, double above, const std::string& property = "ignore") const {
        std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(surface.points.size()) +
                           "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar " + property +
                           "\nelement face " + std::to_string(surface.triangles.size()) +
                           "\nproperty list uchar int vertex_indices\nend_header\n";
        for (const Vec3& p : surface.points) {
            text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
                    (p.z > above ? " 1\n" : " 0\n");
        }
        for (const Triangle& t : surface.triangles) {
            text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
        }
        write_file(painted, text);
    }

    ProjectChoices choices(bool is_painted = true, bool inside = false) const {
        ProjectChoices c;
        c.scan = scan;
        c.mm_per_unit = 10;
        c.scale = 0.5;
        if (is_painted) c.ignore.painted = painted;
        c.ignore.inside = inside;
        c.folder = project;
        return c;
    }

    std::string refusal(const ProjectChoices& c, InputFault fault) const {
        try {
            draft_project(c, {});
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, fault) << error.what();
            EXPECT_FALSE(fs::exists(project));
            return error.what();
        }
        ADD_FAILURE() << "nothing was refused";
        return {};
    }
};

TEST_F(IgnoredSurfaceFiles, AreKeptWithTheProjectAndNeedThePaintedFileNoMore) {
    paint(mesh, top);
    const ProjectDraft draft = draft_project(choices(), {});
    ASSERT_TRUE(draft.project.ignored.has_value());
    // The cap of a sphere: 2 pi r h of 4 pi r2.
    EXPECT_NEAR(draft.project.ignored->share, (50 - top) / 100, 0.03);
    for (std::size_t t = 0; t < draft.scan.triangles.size(); ++t) {
        const auto p = corners_of(draft.scan, t);
        const auto is_marked = [](Vec3 corner) { return corner.z > 5 * top; };
        EXPECT_EQ(is_ignored(draft.scan, t), std::count_if(p.begin(), p.end(), is_marked) >= 2);
    }
    make_project(draft, {});
    fs::remove(painted);
    const Project loaded = load_project(project);
    EXPECT_EQ(loaded, draft.project);
    EXPECT_EQ(scan_of_project(project, loaded, {}), draft.scan);
    OpenProject opened(project, {});
    EXPECT_EQ(opened.scan(), draft.scan);
    EXPECT_FALSE(opened.segmentation().pieces.front().mesh->ignored.empty());
}

TEST_F(IgnoredSurfaceFiles, ThatAreLostOrChangedAreRefused) {
    paint(mesh, top);
    const ProjectDraft draft = draft_project(choices(), {});
    make_project(draft, {});
    const Bytes good = read_file(project / ignored_file);
    const auto refused = [&] {
        try {
            scan_of_project(project, draft.project, {});
        } catch (const InputError& error) {
            return error.fault == InputFault::config;
        }
        return false;
    };
    EXPECT_FALSE(refused());
    Bytes bad = good;
    bad[7] ^= 1;
    write_file(project / ignored_file, bad);
    EXPECT_TRUE(refused());
    bad = good;
    bad.pop_back();
    write_file(project / ignored_file, bad);
    EXPECT_TRUE(refused());
    fs::remove(project / ignored_file);
    EXPECT_TRUE(refused());
}

TEST_F(IgnoredSurfaceFiles, AreMissingWhereNothingIsIgnored) {
    paint(mesh, 1000);
    const ProjectDraft plain = draft_project(choices(false), {});
    const ProjectDraft draft = draft_project(choices(true, true), {});
    EXPECT_FALSE(draft.project.ignored.has_value());
    EXPECT_EQ(draft.scan, plain.scan);
    EXPECT_TRUE(draft.scan.ignored.empty());
    ASSERT_EQ(draft.project.warnings.size(), plain.project.warnings.size() + 1);
    EXPECT_NE(draft.project.warnings.back().find("No surface is ignored"), std::string::npos);
    EXPECT_EQ(to_json(plain.project).find("ignored"), std::string::npos);
    make_project(draft, {});
    EXPECT_FALSE(fs::exists(project / ignored_file));
}

TEST_F(IgnoredSurfaceFiles, OfAnotherSurfaceOrAllOfItAreRefused) {
    paint(shapes::moved(mesh, {5, 0, 0}), top);
    EXPECT_NE(refusal(choices(), InputFault::mesh).find("is not painted on this scan"), std::string::npos);
    paint(mesh, -1000);
    EXPECT_NE(refusal(choices(), InputFault::mesh).find("all of the scan's surface"), std::string::npos);
    paint(mesh, top, "temperature");
    EXPECT_NE(refusal(choices(), InputFault::mesh).find("marks nothing"), std::string::npos);
    fs::remove(painted);
    refusal(choices(), InputFault::missing);
}

TEST_F(IgnoredSurfaceFiles, TheScanItselfMayBePainted) {
    paint(mesh, top);
    ProjectChoices c = choices();
    c.scan = painted;
    const ProjectDraft draft = draft_project(c, {});
    ASSERT_TRUE(draft.project.ignored.has_value());
    EXPECT_NEAR(draft.project.ignored->share, (50 - top) / 100, 0.03);
}

TEST_F(IgnoredSurfaceFiles, PaintAndInsideAddUp) {
    const TriangleMesh hollow = shapes::joined({mesh, shapes::turned_inside_out(shapes::ball({100, 200, 0}, 40, 24))});
    write_file(scan, to_ply(hollow));
    paint(hollow, top);
    const ProjectDraft both = draft_project(choices(true, true), {});
    const ProjectDraft inside = draft_project(choices(false, true), {});
    ASSERT_TRUE(both.project.ignored && inside.project.ignored);
    EXPECT_NEAR(inside.project.ignored->share, 1600.0 / 4100, 0.01);
    EXPECT_NEAR(both.project.ignored->share, (1600 + 2500 * 0.2) / 4100, 0.02);
    // What the cache keeps of the samples is not that of the scan without marks.
    const auto casts_rays = [&](const TriangleMesh& of) {
        Segmentation segmentation = uncut(of, 0);
        DistanceStore store = distance_store(folder.path / "cache");
        bool were_cast = false;
        const auto keep = store.keep;
        store.keep = [&](const SampledScan& s, const std::vector<PieceAccessibility>& pieces) {
            were_cast = true;
            keep(s, pieces);
        };
        sample_uncut(segmentation.pieces, store, 300);
        return were_cast;
    };
    TriangleMesh unmarked = both.scan;
    unmarked.ignored.clear();
    EXPECT_TRUE(casts_rays(unmarked));
    EXPECT_TRUE(casts_rays(both.scan));
    EXPECT_TRUE(casts_rays(inside.scan));
    EXPECT_FALSE(casts_rays(both.scan));
}

}  // namespace
}  // namespace qchopper
