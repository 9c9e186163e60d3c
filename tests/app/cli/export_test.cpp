// Export writes what it says, whole or not at all, and never over something.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "segment/io/write_mesh.h"
#include "tests/app/cli/program.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Export : ::testing::Test {
    program::Folder folder;
    void SetUp() override {
        fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply");
        fs::copy(program::prepared() / "scan.qch", folder.path / "p.qch", fs::copy_options::recursive);
    }
    program::Ended run(program::Arguments arguments) const {
        arguments.insert(arguments.begin(), {"export", "p.qch", "--format"});
        return program::run(arguments, {folder.path});
    }
    json document(program::Arguments arguments, int code = 0) const {
        arguments.push_back("--json");
        const program::Ended ended = run(arguments);
        EXPECT_EQ(ended.code, code) << ended.err;
        const json parsed = json::parse(ended.out, nullptr, false);
        EXPECT_TRUE(parsed.is_object()) << ended.out;
        EXPECT_EQ(parsed.value("schema", ""), "qchopper-export-1");
        return parsed;
    }
    std::string bytes(const std::string& name) const { return program::bytes_in(folder.path / name); }
};

TEST_F(Export, PiecesInPlaceAsPlyAreThoseOfTheProject) {
    const json made = document({"ply"});
    ASSERT_GE(made["pieces"].size(), 3U);
    for (const json& piece : made["pieces"]) {
        const std::string name = piece["piece"].get<std::string>() + ".ply";
        EXPECT_EQ(bytes("p-ply/" + name), bytes("p.qch/pieces/" + name)) << name;
    }
}

TEST_F(Export, EveryFormatIsWrittenTheSameWayTwice) {
    for (const std::string format : {"3mf", "glb", "stl", "ply"}) {
        for (const std::string pose : {"place", "setup"}) {
            const bool is_folder = format == "stl" || format == "ply";
            const std::string one = "a-" + pose + (is_folder ? "-" : ".") + format;
            const std::string two = "b-" + pose + (is_folder ? "-" : ".") + format;
            EXPECT_EQ(run({format, "--pose", pose, "-o", one}).code, 0);
            EXPECT_EQ(run({format, "--pose", pose, "-o", two}).code, 0);
            if (is_folder) {
                EXPECT_EQ(
                    program::difference(program::contents(folder.path / one), program::contents(folder.path / two)),
                    "");
            } else {
                EXPECT_EQ(bytes(one), bytes(two));
                EXPECT_GT(bytes(one).size(), 10000U);
            }
        }
    }
}

TEST_F(Export, HolesAreCutInAndTheMeshesStayClosed) {
    const json plain = document({"ply", "-o", "plain"});
    const json holed = document({"ply", "--holes", "-o", "holed"});
    ASSERT_EQ(plain["pieces"].size(), holed["pieces"].size());
    std::size_t changed = 0;
    for (std::size_t i = 0; i < plain["pieces"].size(); ++i) {
        const std::string file = holed["pieces"][i]["file"].get<std::string>();
        changed += plain["pieces"][i]["faces"] != holed["pieces"][i]["faces"] ? 1 : 0;
        const program::Ended seen = program::run({"inspect", file, "--json"}, {folder.path});
        EXPECT_EQ(seen.code, 0) << seen.err;
    }
    EXPECT_GT(changed, 0U);
    EXPECT_EQ(run({"ply", "--holes", "--simplify", "1", "-o", "both"}).code, 64);
}

TEST_F(Export, AGlbOfAllPiecesShowsTheAssembly) {
    EXPECT_EQ(run({"glb", "-o", "all.glb"}).code, 0);
    EXPECT_NE(bytes("all.glb").find("\"animations\""), std::string::npos);
    EXPECT_EQ(run({"glb", "--pose", "setup", "-o", "setup.glb"}).code, 0);
    EXPECT_EQ(bytes("setup.glb").find("\"animations\""), std::string::npos);
}

TEST_F(Export, WhatIsWrittenCanBeReadAgain) {
    EXPECT_EQ(run({"3mf", "--piece", "C"}).code, 0);
    EXPECT_EQ(run({"glb", "--piece", "C", "-o", "c.glb"}).code, 0);
    for (const std::string file : {"p-C.3mf", "c.glb"}) {
        const program::Ended seen = program::run({"inspect", file, "--json"}, {folder.path});
        EXPECT_EQ(seen.code, 0) << seen.err;
        EXPECT_EQ(json::parse(seen.out)["closed"], true) << file;
    }
}

TEST_F(Export, SimplifiedPiecesStateHowFarTheyAreOff) {
    const json made = document({"stl", "--simplify", "3", "-o", "few"});
    for (const json& piece : made["pieces"]) {
        const json& s = piece["simplified"];
        EXPECT_LT(piece["faces"], s["faces_before"]);
        EXPECT_LE(s["from_piece_mm"], 3);
        EXPECT_LE(s["from_result_mm"], 3);
        const auto size = fs::file_size(folder.path / piece["file"].get<std::string>());
        EXPECT_EQ(size, 84 + 50 * piece["faces"].get<std::size_t>());
    }
}

TEST_F(Export, TooFewFacesToKeepTheCapsIsADemandNotMet) {
    const json made = document({"3mf", "--piece", "C", "--max-faces", "4", "--max-distance", "1e6"}, 1);
    for (const json& piece : made["pieces"]) EXPECT_GT(piece["faces"], 4);
    EXPECT_TRUE(fs::exists(folder.path / "p-C.3mf"));
}

TEST_F(Export, ANumberOfFacesWithWhichAPieceLosesItsShapeIsRefused) {
    const program::Contents before = program::contents(folder.path);
    const program::Ended refused = run({"stl", "--piece", "C", "--max-faces", "60"});
    EXPECT_EQ(refused.code, 64);
    EXPECT_NE(refused.err.find("moves the surface of piece C by up to"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("1 % of its diagonal"), std::string::npos) << refused.err;
    EXPECT_EQ(run({"stl", "--max-distance", "1"}).code, 64);
    EXPECT_EQ(program::difference(before, program::contents(folder.path)), "");
    const json made = document({"stl", "--piece", "C", "--max-faces", "1500"});
    EXPECT_LE(made["pieces"][0]["faces"], 1500);
    EXPECT_EQ(made["pieces"][0]["simplified"]["crossings"], 0);
    const double moved = made["pieces"][0]["simplified"]["from_piece_mm"];
    EXPECT_EQ(
        run({"stl", "--piece", "C", "--max-faces", "1500", "--max-distance", std::to_string(moved / 2), "-o", "b.stl"})
            .code,
        64);
}

TEST_F(Export, NothingIsEverWrittenOver) {
    program::put(folder.path / "p.3mf", "mine");
    fs::create_directory(folder.path / "p-stl");
    EXPECT_EQ(run({"3mf"}).code, 73);
    EXPECT_EQ(run({"stl"}).code, 73);
    EXPECT_EQ(bytes("p.3mf"), "mine");
    EXPECT_TRUE(fs::is_empty(folder.path / "p-stl"));
}

TEST_F(Export, AFolderThatIsThereGetsTheFile) {
    fs::create_directory(folder.path / "out");
    EXPECT_EQ(run({"glb", "-o", "out"}).code, 0);
    EXPECT_TRUE(fs::exists(folder.path / "out" / "p.glb"));
    EXPECT_EQ(run({"stl", "--piece", "C", "-o", "out/"}).code, 0);
    EXPECT_TRUE(fs::exists(folder.path / "out" / "p-C.stl"));
}

TEST_F(Export, WrongUseIsToldAndWritesNothing) {
    const program::Contents before = program::contents(folder.path);
    EXPECT_EQ(run({"obj"}).code, 64);
    EXPECT_EQ(run({"3mf", "--piece", "nobody"}).code, 64);
    EXPECT_EQ(run({"3mf", "-o", "a.stl"}).code, 64);
    EXPECT_EQ(run({"stl", "-o", "a.stl"}).code, 64);
    EXPECT_EQ(run({"stl", "--simplify", "0"}).code, 64);
    EXPECT_EQ(run({"stl", "--simplify", "1", "--max-faces", "100"}).code, 64);
    EXPECT_EQ(run({"3mf", "-o", "no/such/folder/a.3mf"}).code, 73);
    EXPECT_EQ(program::difference(before, program::contents(folder.path)), "");
    fs::remove(folder.path / "p.qch" / "cell.toml");
    const program::Ended ended = run({"3mf", "--pose", "setup"});
    EXPECT_EQ(ended.code, 64);
    EXPECT_NE(ended.err.find("has no cell"), std::string::npos) << ended.err;
    EXPECT_EQ(program::run({"export", "nowhere.qch", "--format", "3mf"}, {folder.path}).code, 66);
}

TEST_F(Export, FragmentsThatAreNotExportedAreNamed) {
    const TriangleMesh bar = shapes::box({0, 0, 0}, {150, 60, 50}, 3);
    write_file(folder.path / "bar.ply", to_ply(shapes::joined({bar, shapes::box({160, 0, 0}, {161, 1, 1})})));
    for (const std::string choice : {"keep", "drop"}) {
        const std::string project = choice + ".qch";
        const program::Ended made = program::run(
            {"segment", "bar.ply", "--units", "mm", "--fragments", choice, "--plane", "1,0,0,0", "-o", project},
            {folder.path});
        ASSERT_EQ(made.code, 0) << made.err;
        const program::Ended ended = program::run({"export", project, "--format", "3mf", "--json"}, {folder.path});
        EXPECT_EQ(ended.code, 0) << ended.err;
        EXPECT_NE(ended.err.find("1 fragment (0.00100 ml in all)"), std::string::npos) << ended.err;
        EXPECT_EQ(ended.err.find("dropped") != std::string::npos, choice == "drop") << ended.err;
        EXPECT_EQ(json::parse(ended.out)["fragments"], 1);
    }
    EXPECT_EQ(document({"3mf", "-o", "none.3mf"})["fragments"], 0);
}

TEST_F(Export, APieceThatSomebodyChangedIsRefused) {
    fs::copy_file(folder.path / "scan.ply", folder.path / "p.qch" / "pieces" / "C.ply",
                  fs::copy_options::overwrite_existing);
    EXPECT_EQ(run({"3mf"}).code, 65);
    EXPECT_FALSE(fs::exists(folder.path / "p.3mf"));
}

TEST_F(Export, AProjectThatIsBeingCutIsCutAgainFromItsScan) {
    ASSERT_EQ(program::run({"segment", "p.qch", "--undo"}, {folder.path}).code, 0);
    const json made = document({"3mf"});
    EXPECT_GE(made["pieces"].size(), 2U);
}

}  // namespace
}  // namespace qchopper
