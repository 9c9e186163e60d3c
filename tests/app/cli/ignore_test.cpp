// qchopper prepare and segment with surface that may stay as it is.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/cli/exit_code.h"
#include "segment/io/read_mesh.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/measure.h"
#include "tests/app/cli/program.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct IgnoreOptions : ::testing::Test {
    program::Folder folder;
    void SetUp() override { fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply"); }
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    program::Ended prepare(const program::Arguments& more) const {
        program::Arguments arguments = program::prepare_arguments("scan.ply");
        arguments.insert(arguments.end(), {"-o", "p.qch"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    json project() const { return json::parse(std::ifstream(folder.path / "p.qch" / "project.json")); }

    // A copy of the scan that is red above this share of its height, and white elsewhere.
    void paint(double share) const {
        const TriangleMesh mesh = read_mesh(folder.path / "scan.ply").mesh;
        const Box box = bounds(mesh);
        std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.points.size()) +
                           "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\n" +
                           "property uchar green\nproperty uchar blue\nelement face " +
                           std::to_string(mesh.triangles.size()) +
                           "\nproperty list uchar int vertex_indices\nend_header\n";
        for (const Vec3& p : mesh.points) {
            text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
                    (p.z > box.min.z + share * box.size().z ? " 255 0 0\n" : " 255 255 255\n");
        }
        for (const Triangle& t : mesh.triangles) {
            text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
        }
        program::put(folder.path / "painted.ply", text);
    }
};

TEST_F(IgnoreOptions, AreReportedEverywhereAndKept) {
    paint(0.5);
    const program::Ended made = prepare({"--ignore-surface", "painted.ply"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_NE(made.out.find("\nignored: "), std::string::npos) << made.out;
    EXPECT_NE(made.out.find("% of the scan's surface (painted in "), std::string::npos) << made.out;
    const json ignored = project()["ignored"];
    EXPECT_GT(ignored["share"], 0.2);
    EXPECT_LT(ignored["share"], 0.8);
    EXPECT_EQ(ignored["inside"], false);
    fs::remove(folder.path / "painted.ply");
    EXPECT_EQ(run({"segment", "p.qch", "--undo"}).code, 0);
    EXPECT_NE(run({"segment", "p.qch"}).out.find("\nignored: "), std::string::npos);
    EXPECT_EQ(json::parse(run({"segment", "p.qch", "--redo", "--json"}).out)["ignored"], ignored);
    const program::Ended again = run({"prepare", "p.qch", "--json"});
    ASSERT_EQ(again.code, 0) << again.err;
    const json document = json::parse(again.out);
    EXPECT_EQ(document["ignored"], ignored);
    double mm2 = 0;
    for (const json& piece : document["pieces"]) mm2 += piece["reach"].value("ignored_mm2", 0.0);
    const TriangleMesh mesh = read_mesh(folder.path / "scan.ply").mesh;
    double all = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) all += norm(area_vector(mesh, t));
    EXPECT_NEAR(mm2 / all, ignored["share"].get<double>(), 0.01) << "fragments apart";
    EXPECT_EQ(json::parse(run({"setup", "p.qch", "--json"}).out)["ignored"], ignored);
    EXPECT_NE(run({"setup", "p.qch"}).out.find("ignored: "), std::string::npos);
    EXPECT_NE(run({"explain", "p.qch"}).out.find("\nignored: "), std::string::npos);
    EXPECT_EQ(run({"dry-run", "p.qch"}).code, 0) << "the jobs are read again";
}

TEST_F(IgnoreOptions, ThatIgnoreNothingChangeNothing) {
    paint(2);
    const program::Ended made = prepare({"--ignore-surface", "painted.ply"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_NE(made.err.find("No surface is ignored"), std::string::npos) << made.err;
    for (const char* part : {"pieces", "pictures"}) {  // the jobs have the warning
        const program::Contents here = program::contents(folder.path / "p.qch" / part);
        EXPECT_EQ(program::difference(program::contents(program::prepared() / "scan.qch" / part), here), "") << part;
    }
}

TEST_F(IgnoreOptions, TheInsideOfAHollowBoxStays) {
    const TriangleMesh mesh = shapes::joined({shapes::box({0, 0, 0}, {100, 100, 100}, 4),
                                              shapes::turned_inside_out(shapes::box({10, 10, 10}, {90, 90, 90}, 4))});
    write_file(folder.path / "box.ply", to_ply(mesh));
    const program::Ended made = run({"segment", "box.ply", "--units", "mm", "--ignore-inside", "-o", "p.qch"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_NE(made.out.find("ignored: 39.02 % of the scan's surface (inside)"), std::string::npos) << made.out;
    EXPECT_EQ(project()["ignored"]["painted"], nullptr);
}

TEST_F(IgnoreOptions, WrongOnesAreRefused) {
    const auto expect_refused = [&](const program::Arguments& more, ExitCode code, const std::string& words) {
        const program::Ended ended = prepare(more);
        EXPECT_EQ(ended.code, code) << ended.err;
        EXPECT_NE(ended.err.find(words), std::string::npos) << ended.err;
        EXPECT_FALSE(fs::exists(folder.path / "p.qch"));
    };
    expect_refused({"--ignore-surface", "none.ply"}, exit_missing, "none.ply");
    expect_refused({"--ignore-surface", "scan.ply"}, exit_mesh, "marks nothing");
    program::put(folder.path / "text.ply", "red");
    expect_refused({"--ignore-surface", "text.ply"}, exit_mesh, "not a PLY");
    const fs::path made = program::prepared() / "scan.qch";
    EXPECT_EQ(run({"prepare", made.string(), "--ignore-inside"}).code, exit_use);
    EXPECT_EQ(run({"segment", made.string(), "--ignore-surface", "painted.ply"}).code, exit_use);
}

}  // namespace
}  // namespace qchopper
