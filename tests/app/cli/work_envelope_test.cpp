// prepare in a cell with an arm: jobs say where the block stands and that every pose is held, and a piece that the
// machine cannot carve gets none.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cam/job/read_job.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct WorkEnvelopeCommand : ::testing::Test {
    program::Folder folder;
    void SetUp() override { fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply"); }
    program::Ended run(const program::Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    program::Ended prepare(const std::string& cell, const std::string& project, bool as_json, bool one_core = false) {
        program::Arguments arguments{"prepare",    "scan.ply", "--units",       "mm", "--cell", cell,
                                     "--min-cuts", "1",        "--no-programs", "-o", project};
        if (as_json) arguments.emplace_back("--json");
        return program::run(arguments, {folder.path, {}, one_core});
    }
    // The ready cell with more at its end.
    void put_cell(const std::string& more) const {
        std::ifstream file(fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
        std::stringstream text;
        text << file.rdbuf();
        program::put(folder.path / "cell.toml", text.str() + more);
    }
};

TEST_F(WorkEnvelopeCommand, EveryJobCarriesItsEnvelope) {
    put_cell("");
    const program::Ended made = prepare("cell.toml", "p.qch", true);
    const json document = json::parse(made.out, nullptr, false);
    ASSERT_EQ(document["pieces"].size(), 2U) << made.err;
    for (const json& piece : document["pieces"]) {
        EXPECT_EQ(piece["fits"], true) << made.err;
        EXPECT_EQ(piece["work_envelope"]["arm_checked"], true);
        EXPECT_EQ(piece["work_envelope"]["holds"], true);
        const ReadJob job = parse_job(read_job(folder.path / piece["job"].get<std::string>()), "job");
        EXPECT_TRUE(job.is_arm_checked && job.holds_poses);
        EXPECT_EQ(job.setup.placement.x, piece["work_envelope"]["placement"]["x_mm"]);
        const auto envelope = json::parse(job.files.at("envelope.json"));
        EXPECT_EQ(envelope["tightest"], piece["work_envelope"]["tightest"]["check"]);
        EXPECT_TRUE(job.files.contains("envelope.png"));
    }
    const program::Ended shown = run({"setup", "p.qch", "--piece", document["pieces"][0]["name"]});
    EXPECT_NE(shown.out.find("Work envelope: piece "), std::string::npos) << shown.out;
    EXPECT_NE(shown.out.find("can be carved, tightest: "), std::string::npos) << shown.out;
    EXPECT_NE(run({"prepare", "p.qch", "--no-programs"}).out.find("tightest margin"), std::string::npos);

    ASSERT_EQ(prepare("cell.toml", "q.qch", false, true).in_time, true);
    const json again = json::parse(std::ifstream(folder.path / "q.qch" / "project.json"));
    const json first = json::parse(std::ifstream(folder.path / "p.qch" / "project.json"));
    EXPECT_EQ(again["jobs"], first["jobs"]) << "the same bytes on one core";
}

TEST_F(WorkEnvelopeCommand, APieceThatTheMachineCannotMillGetsNoJob) {
    put_cell("\n[[obstacle]]\nname = \"press\"\nmin = [500.0, -900.0, 320.0]\nmax = [1900.0, 900.0, 900.0]\n");
    const program::Ended made = prepare("cell.toml", "p.qch", false);
    EXPECT_EQ(made.code, 1) << made.err;
    EXPECT_NE(made.err.find("piece B cannot be carved: "), std::string::npos) << made.err;
    EXPECT_NE(made.err.find("press"), std::string::npos) << made.err;
    EXPECT_NE(made.err.find("to do: cut the piece otherwise; it gets no job"), std::string::npos) << made.err;
    EXPECT_NE(made.out.find(" no "), std::string::npos) << made.out;
    EXPECT_FALSE(fs::exists(folder.path / "p.qch" / "jobs" / "B.qjob"));
    EXPECT_TRUE(json::parse(std::ifstream(folder.path / "p.qch" / "project.json"))["jobs"].empty());
}

TEST_F(WorkEnvelopeCommand, ACellWithoutAMachineIsNotChecked) {
    const json project = json::parse(std::ifstream(program::prepared() / "scan.qch" / "project.json"));
    const std::string piece = project["jobs"][0]["piece"];
    const ReadJob job = parse_job(read_job(program::prepared() / "scan.qch" / "jobs" / (piece + ".qjob")), "job");
    EXPECT_FALSE(job.is_arm_checked);
    EXPECT_EQ(json::parse(job.files.at("envelope.json"))["arm_checked"], false);
    EXPECT_EQ(job.setup.placement, BlockPlacement{});
}

}  // namespace
}  // namespace qchopper
