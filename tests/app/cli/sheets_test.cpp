// sheets.html of a project: all setup sheets of its jobs, and never those of other jobs; and its saw list.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "segment/io/write_mesh.h"
#include "tests/app/cli/program.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Sheets : ::testing::Test {
    program::Folder folder;
    void SetUp() override {
        fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply");
        fs::copy(program::prepared() / "scan.qch", folder.path / "p.qch", fs::copy_options::recursive);
    }
    int code_of(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}).code; }
    fs::path file() const { return folder.path / "p.qch" / "sheets.html"; }
};

TEST_F(Sheets, HaveAPageForEveryJobAndStandAlone) {
    const std::string html = program::bytes_in(file());
    const json project = json::parse(program::bytes_in(folder.path / "p.qch" / "project.json"));
    ASSERT_GE(project["jobs"].size(), 2U);
    std::size_t number = 0;
    for (const json& job : project["jobs"]) {
        const std::string piece = job["piece"];
        ++number;
        EXPECT_NE(html.find("<a href=\"#sheet-" + std::to_string(number) + "\">" + piece + "</a>"), std::string::npos);
        EXPECT_NE(html.find("<h1>Setup sheet: piece " + piece + " ("), std::string::npos);
        EXPECT_NE(html.find("<td>" + piece + ".qjob</td>"), std::string::npos);
    }
    EXPECT_EQ(html.find("src=\"setup-"), std::string::npos) << "a picture that is not in it";
    EXPECT_NE(html.find("<td>jobs</td><td>" + std::to_string(number) + "</td>"), std::string::npos);
}

TEST_F(Sheets, FollowAnotherSetupAndItsUndoAndGoWithTheJobs) {
    const std::string before = program::bytes_in(file());
    const json project = json::parse(program::bytes_in(folder.path / "p.qch" / "project.json"));
    const std::string piece = project["jobs"][0]["piece"];
    ASSERT_EQ(code_of({"setup", "p.qch", "--piece", piece, "--orientations", "1", "-q"}), 0);
    EXPECT_NE(program::bytes_in(file()), before);
    ASSERT_EQ(code_of({"segment", "p.qch", "--undo", "-q"}), 0);
    EXPECT_FALSE(fs::exists(file())) << "the job of that piece is not written";
    ASSERT_EQ(code_of({"prepare", "p.qch", "-q"}), 0);
    EXPECT_EQ(program::bytes_in(file()), before);
    ASSERT_EQ(code_of({"segment", "p.qch", "--undo", "-q"}), 0);
    EXPECT_FALSE(fs::exists(file())) << "a cut is taken back";
}

TEST_F(Sheets, OfBlocksThatAreNotSawnComeWithoutASawList) {
    for (const char* name : {"saw-list.html", "saw-list.json"}) {
        EXPECT_FALSE(fs::exists(folder.path / "p.qch" / name)) << name;
    }
}

// A box of which six cuts leave a cube in the middle, in a cell whose stock may be sawn.
struct SawnSheets : ::testing::Test {
    program::Folder folder;

    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    json project() const { return json::parse(program::bytes_in(folder.path / "p.qch" / "project.json")); }
    json saw_list() const { return json::parse(program::bytes_in(folder.path / "p.qch" / "saw-list.json")); }

    void write_cell() const {
        std::string cell = program::bytes_in(program::foam_cell());
        const std::string stock = "material = \"pu_foam\"\n";
        for (std::size_t at = cell.find(stock); at != std::string::npos; at = cell.find(stock, at + stock.size())) {
            cell.insert(at + stock.size(), "sawn = true\nkerf = 3.0\n");
        }
        program::put(folder.path / "cell.toml", cell);
    }

    // The piece whose middle is nearest to that of the scan.
    std::string nearest_piece() const {
        std::string nearest;
        double least = std::numeric_limits<double>::infinity();
        const json of_project = project();
        for (const json& piece : of_project["pieces"]) {
            const json& centre = piece["centre_mm"];
            const double away = std::hypot(centre[0].get<double>(), centre[1].get<double>(), centre[2].get<double>());
            if (away < least) nearest = piece["name"];
            least = std::min(least, away);
        }
        return nearest;
    }

    void SetUp() override {
        write_cell();
        write_mesh(folder.path / "box.ply", shapes::box({-150, -140, -130}, {150, 140, 130}, 4));
        bool is_first = true;
        for (const char* plane : {"1,0,0,-50", "1,0,0,50", "0,1,0,-45", "0,1,0,45", "0,0,1,-40", "0,0,1,40"}) {
            program::Arguments arguments{"segment", "p.qch", "--plane", plane, "-q"};
            if (is_first) {
                arguments = {"segment",    "box.ply", "--units", "mm",    "--cell",  "cell.toml", "--preset", "thesis",
                             "--min-cuts", "6",       "-o",      "p.qch", "--plane", plane,       "-q"};
            } else {
                arguments.insert(arguments.end(), {"--piece", nearest_piece()});
            }
            is_first = false;
            const program::Ended cut = run(arguments);
            ASSERT_EQ(cut.code, 0) << cut.err;
        }
    }
};

TEST_F(SawnSheets, APieceOfGlueFacesAloneIsSawnAndHasNoJob) {
    const program::Ended made = run({"prepare", "p.qch", "--json"});
    ASSERT_EQ(made.code, 0) << made.err;
    const json prepared = json::parse(made.out);
    const std::string cube = nearest_piece();
    ASSERT_EQ(prepared["pieces"].size(), 7U);
    for (const json& piece : prepared["pieces"]) {
        const bool is_cube = piece["name"] == cube;
        EXPECT_EQ(piece["piece_state"] == "sawn", is_cube) << piece["piece_state"];
        EXPECT_EQ(piece["job"].is_null(), is_cube);
    }
    EXPECT_TRUE(prepared["all_fit"].get<bool>());
    std::size_t sawn = 0;
    for (const json& joint : prepared["joints"]["joints"]) sawn += joint["made_by"] == "sawn-sawn" ? 1 : 0;
    EXPECT_GE(sawn, 6U) << "those of the cube at least whose neighbours are sawn";
    EXPECT_EQ(prepared["joints"]["longest_chain"]["chain_joints"], 2) << "from one side of the cube to the other";
    EXPECT_EQ(prepared["joints"]["longest_chain"]["largest_mm"], 1.0);

    EXPECT_FALSE(fs::exists(folder.path / "p.qch" / "jobs" / (cube + ".qjob")));
    const json list = saw_list();
    std::size_t without_job = 0;
    for (const json& block : list["blocks"]) {
        if (!block["job"].is_null()) continue;
        ++without_job;
        EXPECT_EQ(block["piece"], cube);
        std::vector<double> size = block["block_mm"];
        std::sort(size.begin(), size.end());
        EXPECT_NEAR(size[0], 80, 0.11);
        EXPECT_NEAR(size[1], 90, 0.11);
        EXPECT_NEAR(size[2], 100, 0.11);
    }
    EXPECT_EQ(without_job, 1U);
    const std::string sheets = program::bytes_in(folder.path / "p.qch" / "sheets.html");
    EXPECT_NE(sheets.find("Sawn only, without a job: " + cube + "."), std::string::npos);
    EXPECT_EQ(sheets.find("Without a job: "), std::string::npos);
}

TEST_F(SawnSheets, TheSawListFollowsTheJobsAndGoesWithThem) {
    const program::Ended made = run({"prepare", "p.qch"});
    ASSERT_EQ(made.code, 0) << made.err;
    const std::string cube = nearest_piece();
    EXPECT_NE(made.out.find("1 piece made by the saw alone, without a job: see p.qch/saw-list.html."),
              std::string::npos)
        << made.out;
    EXPECT_NE(made.out.find("Longest chain of joints: 2, "), std::string::npos) << made.out;
    const std::string before = program::bytes_in(folder.path / "p.qch" / "saw-list.json");
    const std::string piece = project()["jobs"][0]["piece"];
    ASSERT_EQ(run({"setup", "p.qch", "--piece", piece, "--directions", "1", "-q"}).code, 0);
    EXPECT_EQ(program::bytes_in(folder.path / "p.qch" / "saw-list.json"), before)
        << "its block is the same, and that of the cube is known again";
    ASSERT_EQ(run({"segment", "p.qch", "--undo", "-q"}).code, 0);
    ASSERT_EQ(run({"segment", "p.qch", "--undo", "-q"}).code, 0);
    for (const char* name : {"saw-list.html", "saw-list.json"}) {
        EXPECT_FALSE(fs::exists(folder.path / "p.qch" / name)) << "a cut is taken back: " << name;
    }
}

}  // namespace
}  // namespace qchopper
