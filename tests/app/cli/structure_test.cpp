// The option --structure: what it reports and keeps, and what it refuses.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/files/file.h"
#include "segment/io/write_mesh.h"
#include "tests/app/cli/program.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A ring that stands upright, and a cube that hangs in the air in its middle.
TriangleMesh ring() {
    return shapes::joined({shapes::rotated(shapes::torus({0, 0, 0}, 60, 18), {1, 0, 0}, 1.5707963267948966),
                           shapes::box({-12, -12, -12}, {12, 12, 12})});
}

struct Structure : ::testing::Test {
    program::Folder folder;
    const std::string load = "upright=+z,density=100,strength=0.5,load=weight,voxel=5";
    void SetUp() override { write_file(folder.path / "scan.ply", to_ply(ring())); }
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    program::Ended make(const std::string& structure, const std::string& name) const {
        return run({"segment", "scan.ply", "--units", "mm", "--preset", "thesis", "--structure", structure, "--step",
                    "-o", name, "--json"});
    }
    std::vector<fs::path> stress_files() const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder.path / "p.qch" / "cache")) {
            if (entry.path().extension() == ".stress") files.push_back(entry.path());
        }
        return files;
    }
};

TEST_F(Structure, IsReportedKeptAndRecomputedIfItsFileIsBroken) {
    const program::Ended first = make(load, "p.qch");
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_NE(first.err.find("structure: voxels of 5 mm"), std::string::npos) << first.err;
    EXPECT_NE(first.err.find("1 solid of voxels"), std::string::npos) << first.err;
    const json told = json::parse(first.out);
    EXPECT_EQ(told["stress"]["voxel_mm"], 5);
    EXPECT_EQ(told["stress"]["floating"].size(), 1U);
    EXPECT_TRUE(told["stress"].contains("hinges"));
    EXPECT_EQ(told["stress"]["floating"][0]["hinged"], false);
    EXPECT_LE(told["stress"]["residual"].get<double>(), 1e-6);
    EXPECT_EQ(told["weights"]["structure"], 1);
    for (const json& plane : told["proposal"]["planes"]) EXPECT_GT(plane["terms"].value("structure", 0.0), 0);
    ASSERT_EQ(stress_files().size(), 1U);
    const fs::path file = stress_files()[0];
    const std::string kept = program::bytes_in(file);
    write_file(file, "broken");
    const program::Ended again = run({"segment", "p.qch", "--step", "--json"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(program::bytes_in(file), kept);
    EXPECT_EQ(json::parse(again.out)["proposal"], told["proposal"]);
    const program::Ended cut = run({"segment", "p.qch", "--accept", "1", "--json"});
    ASSERT_EQ(cut.code, 0) << cut.err;
    EXPECT_EQ(json::parse(cut.out)["cuts"][0]["terms"], told["proposal"]["planes"][0]["terms"]);
    EXPECT_EQ(run({"explain", "p.qch"}).code, 0);
}

TEST_F(Structure, IsOffWithoutTheOption) {
    const program::Ended off =
        run({"segment", "scan.ply", "--units", "mm", "--preset", "thesis", "-o", "p.qch", "--json"});
    ASSERT_EQ(off.code, 0) << off.err;
    EXPECT_FALSE(json::parse(off.out).contains("stress"));
    EXPECT_EQ(off.err.find("structure"), std::string::npos);
    const program::Ended weight = run({"segment", "p.qch", "--weights", "structure=1", "--step"});
    EXPECT_EQ(weight.code, 64) << weight.err;
    EXPECT_NE(weight.err.find("--structure"), std::string::npos) << weight.err;
    EXPECT_EQ(run({"segment", "p.qch", "--structure", load}).code, 64) << "it belongs to a new project";
}

TEST_F(Structure, AWrongLoadIsRefusedAndNothingIsMade) {
    for (const char* wrong :
         {"", "upright=+z", "upright=+z,density=100,strength=0.5", "upright=0:0:0,density=100,strength=0.5,load=weight",
          "upright=up,density=100,strength=0.5,load=weight", "upright=+z,density=0,strength=0.5,load=weight",
          "upright=+z,density=100,strength=-1,load=weight", "upright=+z,density=nan,strength=1,load=weight",
          "upright=+z,density=100,strength=0.5,load=none", "upright=+z,density=100,strength=0.5,load=-3",
          "upright=+z,density=100,strength=0.5,load=weight+", "upright=+z,upright=+z,density=1,strength=1,load=weight",
          "upright=+z,density=100,strength=0.5,load=weight,poisson=0.5"}) {
        const program::Ended refused = make(wrong, "q.qch");
        EXPECT_EQ(refused.code, 64) << wrong << refused.err;
        EXPECT_FALSE(fs::exists(folder.path / "q.qch")) << wrong;
    }
    EXPECT_EQ(make("upright=0:0.1:2,density=100,strength=0.5,load=weight+25,voxel=8,poisson=0.2", "r.qch").code, 0);
    const program::Ended fine = make("upright=+z,density=100,strength=0.5,load=weight,voxel=0.001", "s.qch");
    EXPECT_EQ(fine.code, 64) << fine.err;
    EXPECT_NE(fine.err.find("250 million"), std::string::npos) << fine.err;
}

}  // namespace
}  // namespace qchopper
