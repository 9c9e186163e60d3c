// Surface that must not be cut, and the other candidates of a project: what is kept of them.

#include "app/store/no_cut_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "app/engine/make_project.h"
#include "app/store/project_folder.h"
#include "app/store/project_json.h"
#include "base/error.h"
#include "segment/io/write_mesh.h"
#include "segment/search/rank_piece.h"
#include "tests/folder.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr double top = 30;

struct NoCutSurfaceFiles : ::testing::Test {
    Folder folder;
    const TriangleMesh mesh = shapes::ball({100, 200, 0}, 50, 32);  // in the unit of the file
    fs::path scan = folder.path / "scan.ply";
    fs::path painted = folder.path / "painted.ply";
    fs::path project = folder.path / "p.qch";

    void SetUp() override { write_file(scan, to_ply(mesh)); }

    // A text PLY with a property that is 1 above a height.
    void paint(const TriangleMesh& surface, double above) const {
        std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(surface.points.size()) +
                           "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar no_cut" +
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

    ProjectChoices choices() const {
        ProjectChoices c;
        c.scan = scan;
        c.mm_per_unit = 10;
        c.scale = 0.5;
        c.no_cut = painted;
        c.folder = project;
        c.settings.candidates.normals = CandidateNormals::sphere;
        c.settings.candidates.offset_step_mm = 60;
        c.settings.candidates.takes_symmetry = true;
        c.settings.candidates.given = {{canonical({{0, 1, 1}, 17.25})}, {canonical({{1, 0, 0}, 3}), "shlafman"}};
        c.settings.stop.min_cuts = 2;
        return c;
    }

    std::string refusal(InputFault fault) const {
        try {
            draft_project(choices(), {});
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, fault) << error.what();
            EXPECT_FALSE(fs::exists(project));
            return error.what();
        }
        ADD_FAILURE() << "nothing was refused";
        return {};
    }
};

TEST_F(NoCutSurfaceFiles, ArePointsOfTheScanThatTheProjectKeeps) {
    paint(mesh, top);
    const ProjectDraft draft = draft_project(choices(), {});
    const NoCut& no_cut = draft.project.settings.candidates.no_cut;
    ASSERT_TRUE(draft.project.no_cut && no_cut.points);
    std::vector<Vec3> marked;
    std::copy_if(draft.scan.points.begin(), draft.scan.points.end(), std::back_inserter(marked),
                 [&](Vec3 p) { return (p.z + draft.project.scan.centre.z) / 5 > top; });
    EXPECT_EQ(no_cut, no_cut_at(marked));
    EXPECT_EQ(draft.project.no_cut->points, marked.size());
    EXPECT_GT(marked.size(), 50U);
    const Project made = draft.project;
    { make_project(draft, {}); }
    fs::remove(painted);
    EXPECT_EQ(load_project(project), made);
}

TEST_F(NoCutSurfaceFiles, HoldThroughTheSearchAndAReplay) {
    paint(mesh, top);
    LockedProject locked = make_project(draft_project(choices(), {}), {});
    OpenProject& open = locked.project;
    open.search(
        open.checks(), [](const Segmentation&) {}, {}, std::nullopt);
    ASSERT_EQ(open.project().cuts.size(), 2U);
    const NoCut no_cut = open.project().settings.candidates.no_cut;
    const auto is_cut = [&](const Ranked& r) {
        return is_forbidden(forbidden_heights(no_cut_triangles(open.scan(), no_cut), r.plane.normal), r.plane.offset);
    };
    std::size_t planes = 0;
    for (const Cut& cut : open.project().cuts) {
        EXPECT_FALSE(is_cut(cut.chosen));
        for (const Ranked& r : cut.runners_up) EXPECT_FALSE(is_cut(r));
        planes += cut.candidates;
    }
    EXPECT_GT(planes, 400U);
    // Opened anew, and cut again, the candidates are the same.
    const std::vector<Ranked> before = open.ranking(0, 1, {});
    OpenProject again(project, Context{});
    EXPECT_EQ(again.ranking(0, 1, {}), before);
    EXPECT_EQ(again.project(), open.project());
}

TEST_F(NoCutSurfaceFiles, AreRefusedIfTheyAreNotThoseOfTheProject) {
    paint(mesh, top);
    { make_project(draft_project(choices(), {}), {}); }
    const Bytes good = read_file(project / no_cut_file);
    for (const int damage : {0, 1, 2}) {
        Bytes bad = good;
        if (damage == 0) bad.back() ^= 1;
        if (damage == 1) bad.pop_back();
        write_file(project / no_cut_file, bad);
        if (damage == 2) fs::remove(project / no_cut_file);
        EXPECT_THROW(load_project(project), InputError);
    }
    write_file(project / no_cut_file, good);
    EXPECT_NO_THROW(load_project(project));
}

TEST_F(NoCutSurfaceFiles, OfAnotherSurfaceAreRefused) {
    paint(shapes::ball({100, 200, 30}, 40, 16), top);
    EXPECT_NE(refusal(InputFault::mesh).find("not painted on this scan"), std::string::npos);
    write_file(painted, to_ply(mesh));
    EXPECT_NE(refusal(InputFault::mesh).find("neither a property no_cut or mask nor colours"), std::string::npos);
    write_file(painted, std::string("solid"));
    EXPECT_NE(refusal(InputFault::mesh).find("not a PLY"), std::string::npos);
    fs::remove(painted);
    refusal(InputFault::missing);
}

TEST_F(NoCutSurfaceFiles, ThatMarkNothingChangeNothing) {
    paint(mesh, 1e6);
    const ProjectDraft draft = draft_project(choices(), {});
    EXPECT_FALSE(draft.project.no_cut);
    EXPECT_FALSE(draft.project.settings.candidates.no_cut.points);
    EXPECT_NE(draft.project.warnings.back().find("All surface may be cut"), std::string::npos);
}

TEST_F(NoCutSurfaceFiles, SettingsOfCandidatesAreReadAsTheyWereWritten) {
    paint(mesh, top);
    const Project made = draft_project(choices(), {}).project;
    Project read = project_from_json(to_json(made), "p");
    EXPECT_TRUE(read.settings.candidates.symmetry);
    read.settings.candidates.no_cut = made.settings.candidates.no_cut;  // beside project.json
    EXPECT_EQ(read, made);
    // A project of before has none of the keys.
    Project plain = made;
    plain.settings.candidates = {};
    plain.settings.objectives.symmetry_plane.reset();
    plain.no_cut.reset();
    const std::string text = to_json(plain);
    for (const char* key : {"\"normals\"", "\"offset_step_mm\"", "symmetry", "\"planes\"", "no_cut"}) {
        EXPECT_EQ(text.find(key), std::string::npos) << key;
    }
    EXPECT_EQ(project_from_json(text, "p"), plain);
    for (const auto& [good, bad] : {std::pair{"\"offset_step_mm\": 60", "\"offset_step_mm\": 0"},
                                    {"\"normals\": \"sphere\"", "\"normals\": \"cube\""}}) {
        std::string damaged = to_json(made);
        const std::size_t at = damaged.find(good);
        ASSERT_NE(at, std::string::npos) << good;
        damaged.replace(at, std::string(good).size(), bad);
        EXPECT_THROW(project_from_json(damaged, "p"), InputError) << bad;
    }
}

}  // namespace
}  // namespace qchopper
