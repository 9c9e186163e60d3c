// --json gives exactly one JSON document on stdout, whatever the command; words go to stderr.

#include <gtest/gtest.h>
#include <signal.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/report/prepare_report.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// The one document; a failed test if there is anything before, behind or beside it.
json document(const program::Ended& ended, const std::string& schema, int code = 0) {
    EXPECT_EQ(ended.code, code) << ended.err;
    const json parsed = json::parse(ended.out, nullptr, false);
    EXPECT_TRUE(parsed.is_object()) << ended.out;
    if (!parsed.is_object()) return json::object();
    EXPECT_EQ(parsed.value("schema", ""), schema);
    return parsed;
}

struct Json : ::testing::Test {
    program::Folder folder;
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    void SetUp() override { fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply"); }
    void copy_project() const {
        fs::copy(program::prepared() / "scan.qch", folder.path / "p.qch", fs::copy_options::recursive);
    }
};

TEST_F(Json, OfSample) {
    const json made =
        document(run({"sample", "skull", "--faces", "4000", "-o", "s.stl", "--json"}), "qchopper-sample-1");
    EXPECT_EQ(made["faces"], 4000);
    EXPECT_TRUE(fs::exists(folder.path / "s.stl"));
}

TEST_F(Json, OfInspect) {
    const json seen = document(run({"inspect", "scan.ply", "--json"}), "qchopper-inspect-3");
    EXPECT_EQ(seen["faces"], 3000);
    EXPECT_EQ(seen["closed"], true);
    EXPECT_EQ(seen["units"], nullptr);
    const json with_units = document(run({"inspect", "scan.ply", "--units", "cm", "--json"}), "qchopper-inspect-3");
    EXPECT_EQ(seen["size_text"], nullptr);
    EXPECT_TRUE(with_units["size_text"].is_string());
}

TEST_F(Json, OfPrepare) {
    program::Arguments arguments = program::prepare_arguments("scan.ply");
    arguments.insert(arguments.end(), {"-o", "p.qch", "--json"});
    const program::Ended ended = run(arguments);
    const json made = document(ended, prepare_schema);
    EXPECT_EQ(made["cuts"].size(), 2U);
    EXPECT_EQ(made["all_fit"], true);
    double volume = 0;
    for (const json& piece : made["pieces"]) {
        EXPECT_TRUE(fs::exists(folder.path / piece["job"].get<std::string>()));
        volume += piece["volume_mm3"].get<double>();
        const double share = piece["reach"]["unreachable_share"];
        EXPECT_EQ(piece["out_of_reach"].empty(), share <= made["max_unreachable"].get<double>() || share < 0.001);
        for (const json& part : piece["out_of_reach"]) {
            EXPECT_LE(part["share"].get<double>(), share + 1e-9);
            EXPECT_NE(ended.err.find("piece " + piece["name"].get<std::string>()), std::string::npos) << ended.err;
        }
    }
    EXPECT_EQ(made["reviews"], json::array()) << "only with the weight unreachable";
    for (const json& fragment : made["fragments"]) volume += fragment["volume_mm3"].get<double>();
    const double scan = made["scan"]["volume_mm3"];
    EXPECT_NEAR(volume, scan, 1e-9 * scan);
    // Off a terminal there is no progress line that is drawn over.
    EXPECT_EQ(ended.err.find_first_of("\r\033"), std::string::npos) << ended.err;
}

// Per line of stderr its document.
std::vector<json> progress_of(const program::Ended& ended) {
    std::vector<json> all;
    std::istringstream lines(ended.err);
    for (std::string line; std::getline(lines, line);) {
        all.push_back(json::parse(line, nullptr, false));
        EXPECT_TRUE(all.back().is_object()) << line;
    }
    return all;
}

TEST_F(Json, OfProgress) {
    program::Arguments arguments = program::prepare_arguments("scan.ply");
    arguments.insert(arguments.end(), {"-o", "p.qch", "--scale", "1.01", "--progress", "json"});
    const program::Ended ended = run(arguments);
    std::map<std::string, std::size_t> kinds;
    for (const json& line : progress_of(ended)) {
        for (const char* kind : {"progress", "message", "warning", "error"}) kinds[kind] += line.contains(kind) ? 1 : 0;
        if (!line.contains("progress")) continue;
        EXPECT_GE(line["elapsed_s"].get<double>(), 0);
        EXPECT_LE(line["done"], line["total"].is_null() ? line["done"] : line["total"]) << line;
    }
    EXPECT_GE(kinds["progress"], 5U) << ended.err;
    EXPECT_GE(kinds["message"], 2U) << ended.err;
    EXPECT_GE(kinds["warning"], 1U) << "of the scale";
    EXPECT_EQ(kinds["error"], 0U);
    for (const program::Arguments& wrong : {program::Arguments{"inspect", "no.ply", "--progress=json", "--quiet"},
                                            {"inspect", "scan.ply", "--nonsense", "--progress", "json"}}) {
        const std::vector<json> said = progress_of(run(wrong));
        ASSERT_EQ(said.size(), 1U);
        EXPECT_TRUE(said.front().contains("error")) << said.front();
    }
    EXPECT_EQ(run({"inspect", "scan.ply", "--progress", "yaml"}).code, 64);
}

TEST_F(Json, OfAPieceThatDoesNotFit) {
    std::string cell = program::bytes_in(program::foam_cell());
    const std::string ceiling = "max = [1200.0, 1200.0, 1400.0]";
    ASSERT_NE(cell.find(ceiling), std::string::npos);
    cell.replace(cell.find(ceiling), ceiling.size(), "max = [1200.0, 1200.0, 200.0]");
    program::put(folder.path / "low.toml", cell);
    const program::Ended ended =
        run({"prepare", "scan.ply", "--units", "mm", "--cell", "low.toml", "--min-cuts", "1", "-o", "p.qch", "--json"});
    const json made = document(ended, prepare_schema, 1);
    EXPECT_EQ(made["all_fit"], false);
    for (const json& piece : made["pieces"]) {
        EXPECT_EQ(piece["fits"], false);
        EXPECT_EQ(piece["job"], nullptr);
        EXPECT_NE(ended.err.find("piece " + piece["name"].get<std::string>() + " does not fit: "), std::string::npos)
            << ended.err;
    }
    EXPECT_TRUE(fs::is_empty(folder.path / "p.qch" / "jobs"));
}

TEST_F(Json, OfDryRunWhichLeavesNothingBehind) {
    copy_project();
    fs::create_directory(folder.path / "tmp");
    const program::Contents before = program::contents(folder.path);
    const program::Ended ended =
        program::run({"dry-run", "p.qch", "--json"}, {folder.path, "", false, folder.path / "tmp"});
    const json handed = document(ended, "qchopper-dry-run-2");
    EXPECT_EQ(handed["simulated"], true);
    EXPECT_EQ(handed["all_complete"], true);
    EXPECT_EQ(handed["jobs"].size(), handed["jobs_wanted"]);
    for (const json& job : handed["jobs"]) EXPECT_EQ(job["starts"], 1);
    EXPECT_NE(ended.err.find("consent is given at once"), std::string::npos);
    EXPECT_EQ(program::difference(before, program::contents(folder.path)), "");
}

TEST_F(Json, OfCellSimAndDispatch) {
    copy_project();
    fs::create_directory(folder.path / "drop");
    program::Process cell({"cell-sim", "--listen", "127.0.0.1:0", "--drop", "drop", "--speed", "100000", "--json"},
                          {folder.path});
    ASSERT_TRUE(cell.waits_until_out("\n")) << cell.err();
    const json listening = json::parse(cell.out());
    const json handed =
        document(run({"dispatch", "p.qch", "--piece", "C", "--to", listening["listening"], "--drop", "drop", "--json"}),
                 "qchopper-dispatch-2");
    EXPECT_EQ(handed["jobs"].size(), 1U);
    EXPECT_EQ(handed["simulated"], true);
    cell.signal(SIGTERM);
    document(cell.wait(), "qchopper-cell-sim-1");
}

}  // namespace
}  // namespace qchopper
