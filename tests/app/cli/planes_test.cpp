// qchopper segment with the options that say which planes are tried.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/cli/exit_code.h"
#include "segment/io/read_mesh.h"
#include "segment/mesh/measure.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct PlaneOptions : ::testing::Test {
    program::Folder folder;
    void SetUp() override {
        const program::Ended made = run({"sample", "vertebra", "--faces", "4000", "-o", "scan.ply"});
        ASSERT_EQ(made.code, 0) << made.err;
    }
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    program::Ended segment(const program::Arguments& more) const {
        program::Arguments arguments{"segment", "scan.ply", "--units", "mm", "--preset", "thesis", "-o", "p.qch"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    json document(program::Arguments arguments) const {
        arguments.emplace_back("--json");
        const program::Ended ended = run(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return json::parse(ended.out);
    }
    json settings() const { return json::parse(std::ifstream(folder.path / "p.qch" / "project.json"))["settings"]; }
};

TEST_F(PlaneOptions, OfTheSphereAreTriedAtEveryStep) {
    const program::Ended made = segment({"--normals", "sphere", "--offset-step", "60", "--step"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(settings()["normals"], "sphere");
    EXPECT_EQ(settings()["offset_step_mm"], 60);
    const json proposal = document({"segment", "p.qch", "--step", "--top", "1000"})["proposal"];
    std::set<int> normals;
    for (const json& plane : proposal["planes"]) normals.insert(plane["normal_index"].get<int>());
    EXPECT_GT(normals.size(), 100U);
    EXPECT_LE(*normals.rbegin(), 131);
}

TEST_F(PlaneOptions, OffsetsAreSoMany) {
    ASSERT_EQ(segment({"--offsets", "7", "--step"}).code, 0);
    const json proposal = document({"segment", "p.qch", "--step", "--top", "1000"})["proposal"];
    EXPECT_LE(proposal["candidates"], 21);
    EXPECT_GT(proposal["candidates"], 15);
    EXPECT_LE(proposal["planes"].size(), proposal["candidates"]);
    const json cut = document({"segment", "p.qch", "--accept", "1"});
    EXPECT_EQ(cut["cuts"].size(), 1U);
    EXPECT_EQ(run({"explain", "p.qch"}).code, 0);
}

TEST_F(PlaneOptions, GivenPlanesAreTriedForEveryPiece) {
    program::put(folder.path / "planes.txt", "# through the middle\n1, 0, 0, 0.5\n\n 0,3,4,20 \r\n0,0,1,1e6\n");
    const program::Ended made = segment({"--planes", "planes.txt", "--step"});
    ASSERT_EQ(made.code, 0) << made.err;
    ASSERT_EQ(settings()["planes"].size(), 3U);
    EXPECT_NEAR(settings()["planes"][1]["normal"][1].get<double>(), 0.6, 1e-12);
    EXPECT_NEAR(settings()["planes"][1]["normal"][2].get<double>(), 0.8, 1e-12);
    EXPECT_EQ(settings()["planes"][1]["offset_mm"], 20);
    const auto given = [&] {
        std::set<int> places;
        const json state = document({"segment", "p.qch", "--step", "--top", "1000"});
        for (const json& plane : state["proposal"]["planes"]) {
            if (plane["normal_index"] == -4) places.insert(plane["offset_index"].get<int>());
        }
        return places;
    };
    EXPECT_EQ(given(), (std::set<int>{0, 1})) << "the third misses";
    ASSERT_EQ(run({"segment", "p.qch", "--plane", "0,0,1,60"}).code, 0);
    fs::remove(folder.path / "planes.txt");
    EXPECT_FALSE(given().empty()) << "they are kept in the project";
}

TEST_F(PlaneOptions, TheSymmetryPlaneIsReportedAndTried) {
    const program::Ended made = segment({"--symmetry", "--offsets", "5", "--step"});
    ASSERT_EQ(made.code, 0) << made.err;
    const program::Ended shown = run({"segment", "p.qch"});
    EXPECT_NE(shown.out.find("\nsymmetry plane: normal "), std::string::npos) << shown.out;
    EXPECT_NE(shown.out.find(": symmetric"), std::string::npos) << shown.out;
    const json state = document({"segment", "p.qch", "--step", "--top", "1000"});
    EXPECT_NEAR(std::abs(state["symmetry"]["normal"][0].get<double>()), 1, 1e-4);
    EXPECT_NEAR(state["symmetry"]["ratio"].get<double>(), 0.45, 0.1);
    EXPECT_EQ(state["symmetry"]["is_symmetric"], true);
    std::size_t place = 0;
    for (const json& plane : state["proposal"]["planes"]) {
        if (plane["normal_index"] == -3) place = plane["k"].get<std::size_t>();
    }
    ASSERT_GT(place, 0U);
    ASSERT_EQ(run({"segment", "p.qch", "--accept", std::to_string(place)}).code, 0);
    const program::Ended explained = run({"explain", "p.qch"});
    EXPECT_EQ(explained.code, 0) << explained.err;
    EXPECT_NE(explained.out.find("symmetry plane"), std::string::npos) << explained.out;
    // A plane across a half, and its mirror image for the other one.
    ASSERT_EQ(run({"segment", "p.qch", "--plane", "1,0,2,-40", "--piece", "B"}).code, 0);
    bool has_image = false;
    const json after = document({"segment", "p.qch", "--step", "--piece", "C", "--top", "1000"});
    for (const json& plane : after["proposal"]["planes"]) {
        if (plane["normal_index"] == -5 && plane["offset_index"] == 2) {
            has_image = true;
            EXPECT_LT(plane["normal"][0].get<double>() * plane["normal"][2].get<double>(), 0);
        }
    }
    EXPECT_TRUE(has_image);
}

TEST_F(PlaneOptions, ThoseThatMethodsProposeAreKeptAndTried) {
    std::ofstream(folder.path / "planes.txt") << "0,0,1,5\n";
    const program::Ended made =
        segment({"--offsets", "5", "--planes", "planes.txt", "--propose", "shlafman,zhou-huang", "--step"});
    ASSERT_EQ(made.code, 0) << made.err;
    const std::size_t first = made.err.find("shlafman finds ");
    EXPECT_NE(first, std::string::npos) << made.err;
    EXPECT_LT(first, made.err.find("zhou-huang finds ")) << made.err;
    const json planes = settings()["planes"];
    ASSERT_GT(planes.size(), 2U) << made.err;
    EXPECT_EQ(planes[0]["offset_mm"], 5);  // the operator's own come first
    EXPECT_FALSE(planes[0].contains("proposed_by"));
    EXPECT_EQ(planes[1]["proposed_by"], "shlafman");
    std::set<int> places;
    const json state = document({"segment", "p.qch", "--step", "--top", "1000"});
    for (const json& plane : state["proposal"]["planes"]) {
        if (plane["normal_index"] == -4) places.insert(plane["offset_index"].get<int>());
    }
    EXPECT_GT(places.size(), 1U);
    EXPECT_LT(static_cast<std::size_t>(*places.rbegin()), planes.size());
}

TEST_F(PlaneOptions, RegionsAreWrittenAndNothingIsChanged) {
    ASSERT_EQ(segment({"--offsets", "5"}).code, 0);
    const auto project = [&] {
        std::ifstream in(folder.path / "p.qch" / "project.json");
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    const std::string before = project();
    const json told = document({"segment", "p.qch", "--regions", "shlafman", "-o", "regions.ply"})["found_regions"];
    EXPECT_EQ(told["method"], "shlafman");
    ASSERT_GT(told["regions"], 1) << told;
    EXPECT_EQ(told["copy_faces"], 4000);
    std::ifstream in(folder.path / "regions.ply");
    const std::string ply(std::istreambuf_iterator<char>(in), {});
    for (const char* words : {"element face 4000\n", "property uint region\n", "property uchar red\n"}) {
        EXPECT_NE(ply.find(words), std::string::npos) << words;
    }
    EXPECT_EQ(read_mesh(folder.path / "regions.ply").mesh.triangles.size(), 4000U);
    const program::Ended drawn = run({"segment", "p.qch", "--regions", "garland", "-o", "regions.png"});
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_NE(drawn.out.find("garland finds "), std::string::npos) << drawn.out;
    EXPECT_TRUE(fs::exists(folder.path / "regions.png"));
    EXPECT_EQ(project(), before);
    for (const auto& [options, words] :
         {std::pair<program::Arguments, const char*>{{"--regions", "shlafman"}, "name it"},
          {{"--regions", "shlafman", "-o", "regions.stl"}, "neither in .png nor in .ply"},
          {{"--regions", "voronoi", "-o", "regions.ply"}, "shlafman"},
          {{"--regions", "shlafman", "-o", "regions.ply", "--step"}, "exclude each other"}}) {
        program::Arguments arguments{"segment", "p.qch"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const program::Ended refused = run(arguments);
        EXPECT_EQ(refused.code, exit_use) << words;
        EXPECT_NE(refused.err.find(words), std::string::npos) << refused.err;
    }
    EXPECT_EQ(run({"segment", "scan.ply", "--units", "mm", "--regions", "shlafman", "-o", "r.ply"}).code, exit_use);
    EXPECT_FALSE(fs::exists(folder.path / "r.ply"));
}

TEST_F(PlaneOptions, NoneAreProposedByDefault) {
    const program::Ended made = segment({"--offsets", "5"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_FALSE(settings().contains("planes"));
    EXPECT_EQ(made.err.find(" finds "), std::string::npos) << made.err;
}

TEST_F(PlaneOptions, NoPlaneGoesThroughSurfaceThatMustNotBeCut) {
    const TriangleMesh mesh = read_mesh(folder.path / "scan.ply").mesh;
    const Box box = bounds(mesh);
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.points.size()) +
                       "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\n" +
                       "property uchar green\nproperty uchar blue\nelement face " +
                       std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3& p : mesh.points) {
        text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
                (p.z > box.min.z + 0.5 * box.size().z ? " 255 0 0\n" : " 255 255 255\n");
    }
    for (const Triangle& t : mesh.triangles) {
        text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    }
    program::put(folder.path / "painted.ply", text);
    const program::Ended made = segment({"--no-cut", "painted.ply", "--normals", "sphere", "--step"});
    ASSERT_EQ(made.code, 0) << made.err;
    fs::remove(folder.path / "painted.ply");
    const json state = document({"segment", "p.qch", "--step", "--top", "1000"});
    EXPECT_GT(state["no_cut"]["points"], 100);
    EXPECT_NE(run({"segment", "p.qch"}).out.find("\nno cut: through "), std::string::npos);
    // Along z only planes of the lower half are left; the scan's centre is at 0.
    int level = 0;
    for (const json& plane : state["proposal"]["planes"]) {
        if (plane["normal"][2].get<double>() < 0.9999) continue;
        ++level;
        EXPECT_LT(plane["offset_mm"].get<double>(), 0.02 * box.size().z);
    }
    EXPECT_GT(level, 6) << "every second one: the list leaves neighbours out";
    EXPECT_LT(level, 12);
}

TEST_F(PlaneOptions, ThatAreWrongAreRefused) {
    program::put(folder.path / "bad.txt", "1,0,0,5\n1,0,0\n");
    program::put(folder.path / "none.txt", "# no plane\n");
    program::put(folder.path / "flat.txt", "0,0,0,5\n");
    struct Wrong {
        program::Arguments options;
        int code;
        std::string says;
    };
    for (const Wrong& wrong :
         {Wrong{{"--normals", "cube"}, exit_use, "box"}, Wrong{{"--offsets", "0"}, exit_use, "1 to 10000"},
          Wrong{{"--offset-step", "-5"}, exit_use, "length"},
          Wrong{{"--offsets", "5", "--offset-step", "5"}, exit_use, "--offset"},
          Wrong{{"--planes", "bad.txt"}, exit_config, "bad.txt, line 2: not a plane"},
          Wrong{{"--planes", "none.txt"}, exit_config, "holds no plane"},
          Wrong{{"--planes", "flat.txt"}, exit_config, "line 1"},
          Wrong{{"--planes", "missing.txt"}, exit_missing, "missing.txt"},
          Wrong{{"--propose", "voronoi"}, exit_use, "shlafman"},
          Wrong{{"--propose", "shlafman,shlafman"}, exit_use, "shlafman"},
          Wrong{{"--no-cut", "scan.ply"}, exit_mesh, "no_cut"},
          Wrong{{"--no-cut", "missing.ply"}, exit_missing, "missing.ply"}}) {
        const program::Ended ended = segment(wrong.options);
        EXPECT_EQ(ended.code, wrong.code) << wrong.options[0] << " " << ended.err;
        EXPECT_NE(ended.err.find(wrong.says), std::string::npos) << ended.err;
        EXPECT_FALSE(fs::exists(folder.path / "p.qch"));
    }
    ASSERT_EQ(segment({}).code, 0);
    for (const char* option : {"--normals", "--offsets", "--offset-step", "--planes", "--no-cut"}) {
        const program::Ended ended =
            run({"segment", "p.qch", "--step", option, option == std::string("--normals") ? "box" : "5"});
        EXPECT_EQ(ended.code, exit_use) << option;
        EXPECT_NE(ended.err.find("belongs to a new one"), std::string::npos) << ended.err;
    }
    EXPECT_EQ(run({"segment", "p.qch", "--step", "--symmetry"}).code, exit_use);
    EXPECT_EQ(run({"segment", "p.qch", "--step", "--propose", "all"}).code, exit_use);
}

}  // namespace
}  // namespace qchopper
