// qchopper repair as a process: what it writes, what it says, and that a failure leaves everything as it was.

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/cli/exit_code.h"
#include "segment/io/read_mesh.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/connectivity/edges.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

using nlohmann::json;
using program::Ended;
using program::Folder;

TriangleMesh vertebra() {
    return read_mesh(program::prepared() / "scan.ply").mesh;
}

// Every second face turned, three faces away, one twice.
TriangleMesh damaged() {
    TriangleMesh mesh = vertebra();
    mesh.triangles.resize(mesh.triangles.size() - 3);
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 2) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
    mesh.triangles.push_back(mesh.triangles.front());
    return mesh;
}

struct Repair : ::testing::Test {
    Folder folder;
    void SetUp() override { write_file(folder.path / "scan.ply", to_ply(damaged())); }
    Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    TriangleMesh written(const std::string& name) const { return read_mesh(folder.path / name).mesh; }
};

TEST_F(Repair, MakesASolidAndSaysHow) {
    const Ended ended = run({"repair", "scan.ply", "--units", "mm", "-o", "solid.ply"});
    EXPECT_EQ(ended.code, exit_done) << ended.err;
    for (const char* words : {"solid.ply: 3,000 faces", "repeated face dropped", "faces turned to agree", "hole",
                              "distance", "closed: a solid"}) {
        EXPECT_NE(ended.out.find(words), std::string::npos) << words << "\n" << ended.out;
    }
    const TriangleMesh solid = written("solid.ply");
    EXPECT_TRUE(edges(solid).faults.is_closed());
    EXPECT_EQ(solid.points, vertebra().points);  // to the last bit
}

// CGAL cannot be asked to stop; this wrap would take minutes.
TEST_F(Repair, StopsInTheMiddleOfAnAlphaWrapAndLeavesNothing) {
    const program::Contents before = program::contents(folder.path);
    program::Process process(
        {"repair", "scan.ply", "--units", "mm", "--alpha-wrap", "0.3", "-o", "wrapped.ply", "--json"}, {folder.path});
    ASSERT_TRUE(process.waits_until_signals_are_caught());
    std::this_thread::sleep_for(std::chrono::seconds(1));
    process.signal(SIGINT);
    const Ended ended = process.wait(60);
    EXPECT_TRUE(ended.in_time);
    EXPECT_EQ(ended.code, exit_interrupted) << ended.err;
    EXPECT_NE(ended.err.find("stopped on request. Nothing was written."), std::string::npos) << ended.err;
    EXPECT_EQ(json::parse(ended.out)["exit_code"], int{exit_interrupted});
    EXPECT_EQ(program::difference(before, program::contents(folder.path)), "");
}

TEST_F(Repair, EnlargesByAFactorAndSaysSo) {
    const program::Arguments plain{"repair", "scan.ply", "--units", "mm", "-o", "one.ply", "--json"};
    const program::Arguments twice{"repair", "scan.ply", "--units", "mm", "-o", "two.ply", "--json", "--scale", "2"};
    const json one = json::parse(run(plain).out);
    const Ended ended = run(twice);
    ASSERT_EQ(ended.code, exit_done) << ended.err;
    const json two = json::parse(ended.out);
    EXPECT_EQ(two["scale"], 2);
    EXPECT_DOUBLE_EQ(two["volume"], 8 * one["volume"].get<double>());
    EXPECT_NE(ended.err.find("The scan is scaled by 2:"), std::string::npos) << ended.err;
    TriangleMesh expected = written("one.ply");
    for (Vec3& p : expected.points) p = 2 * p;
    EXPECT_EQ(written("two.ply"), expected);
    EXPECT_EQ(run({"repair", "scan.ply", "-o", "none.ply", "--scale", "0"}).code, exit_use);
}

TEST_F(Repair, TellsASmallVolumeInMillilitres) {
    write_file(folder.path / "cube.off",
               "OFF\n4 4 0\n0 0 0\n30 0 0\n0 30 0\n0 0 30\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    EXPECT_NE(run({"repair", "cube.off", "--units", "mm", "-o", "solid.ply"}).out.find("volume       4.50 ml"),
              std::string::npos);
    EXPECT_NE(run({"inspect", "cube.off", "--units", "mm"}).out.find("4.50 ml"), std::string::npos);
}

TEST_F(Repair, OfASolidIsTheSameFile) {
    ASSERT_EQ(run({"repair", "scan.ply", "-o", "once.ply"}).code, exit_done);
    ASSERT_EQ(run({"repair", "once.ply", "-o", "twice.ply"}).code, exit_done);
    EXPECT_EQ(program::bytes_in(folder.path / "twice.ply"), program::bytes_in(folder.path / "once.ply"));
}

TEST_F(Repair, DocumentHoldsStepsCountsAndVerdict) {
    const Ended ended = run({"repair", "scan.ply", "--units", "cm", "-o", "solid.ply", "--json"});
    ASSERT_EQ(ended.code, exit_done) << ended.err;
    const json made = json::parse(ended.out);
    for (const char* key : {"schema",
                            "file",
                            "out",
                            "format",
                            "sha256",
                            "units",
                            "faces_in",
                            "vertices_in",
                            "faces",
                            "vertices",
                            "faces_gone",
                            "faces_new",
                            "passes",
                            "steps",
                            "counts",
                            "self_intersections",
                            "pen_grooves",
                            "alpha_wrap",
                            "left_open",
                            "closed",
                            "solid",
                            "volume",
                            "hausdorff_distance",
                            "warnings",
                            "verdict"}) {
        EXPECT_TRUE(made.contains(key)) << key;
    }
    EXPECT_EQ(made["schema"], "qchopper-repair-3");
    EXPECT_EQ(made["units"], "cm");
    EXPECT_EQ(made["solid"], true);
    EXPECT_EQ(made["steps"][2]["step"], "faces");
    EXPECT_EQ(made["counts"]["faces_repeated"], 1);
    EXPECT_EQ(made["hausdorff_distance"]["unit"], "mm");
}

TEST_F(Repair, WhatIsNoSolidIsRefusedAndNothingIsWritten) {
    TriangleMesh open_component = vertebra();
    open_component.triangles.resize(20);
    write_file(folder.path / "sheet.ply", to_ply(open_component));
    program::put(folder.path / "old.ply", "what was there");
    const program::Contents before = program::contents(folder.path);
    const std::pair<program::Arguments, ExitCode> cases[] = {
        {{"repair", "sheet.ply", "-o", "new.ply"}, exit_mesh},
        {{"repair", "nowhere.ply", "-o", "new.ply"}, exit_missing},
        {{"repair", "scan.ply", "-o", "new.obj"}, exit_use},
        {{"repair", "scan.ply"}, exit_use},
        {{"repair", "scan.ply", "-o", "new.ply", "--fill", "putty"}, exit_use},
        {{"repair", "scan.ply", "-o", "new.ply", "--skip", "everything"}, exit_use},
        {{"repair", "scan.ply", "-o", "new.ply", "--snap-borders", "-1", "--units", "mm"}, exit_use},
        {{"repair", "scan.ply", "-o", "new.ply", "--snap-borders", "1"}, exit_use},  // of what unit?
        {{"repair", "scan.ply", "-o", "old.ply"}, exit_create},
        {{"repair", "scan.ply", "-o", "scan.ply"}, exit_create},
        {{"repair", "scan.ply", "-o", "no/such/folder.ply"}, exit_create}};
    for (const auto& [arguments, code] : cases) {
        const Ended ended = run(arguments);
        EXPECT_EQ(ended.code, code) << ended.err;
        EXPECT_TRUE(ended.out.empty()) << ended.out;
        EXPECT_NE(ended.err.find("Nothing was written."), std::string::npos) << ended.err;
        EXPECT_EQ(program::difference(before, program::contents(folder.path)), "") << ended.err;
    }
}

TEST_F(Repair, StepsAreLeftOutAsAsked) {
    const Ended open = run({"repair", "scan.ply", "-o", "open.ply", "--fill", "none"});
    EXPECT_EQ(open.code, exit_demand_broken) << open.err;
    EXPECT_NE(open.out.find("open at"), std::string::npos) << open.out;
    EXPECT_GT(edges(written("open.ply")).faults.open, 0U);
    write_file(folder.path / "inside.ply", to_ply([] {
                   TriangleMesh mesh = vertebra();
                   for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
                   return mesh;
               }()));
    EXPECT_EQ(run({"repair", "inside.ply", "-o", "out.ply", "--skip", "orient_outward"}).code, exit_mesh);
    EXPECT_EQ(run({"repair", "inside.ply", "-o", "out.ply"}).code, exit_done);
}

TEST_F(Repair, StlIsWrittenWithAWordOnItsPrecision) {
    const Ended ended = run({"repair", "scan.ply", "-o", "solid.stl"});
    EXPECT_EQ(ended.code, exit_done) << ended.err;
    EXPECT_NE(ended.err.find("single precision"), std::string::npos) << ended.err;
    EXPECT_EQ(written("solid.stl").triangles.size(), 3000U);
}

TEST_F(Repair, ChoicesOfAProjectAreRemembered) {
    program::Arguments arguments{"segment", "scan.ply", "--units",        "mm",   "-o", "p.qch",
                                 "--fill",  "flat",     "--snap-borders", "0.001"};
    ASSERT_EQ(run(arguments).code, exit_done);
    const json project = json::parse(program::bytes_in(folder.path / "p.qch/project.json"));
    EXPECT_EQ(project["scan"]["repair"]["fill"], "flat");
    EXPECT_EQ(project["scan"]["repair"]["snap_borders_mm"], 0.001);
    EXPECT_EQ(run({"segment", "p.qch", "--step", "--top", "1"}).code, exit_done);
    const Ended again = run({"segment", "p.qch", "--step", "--fill", "fair"});
    EXPECT_EQ(again.code, exit_use);
    EXPECT_NE(again.err.find("belongs to a new one"), std::string::npos) << again.err;
}

}  // namespace
}  // namespace qchopper
