// qchopper verify, and what dispatch does with its verdicts. Where a positive verdict is needed the piece is the cap of
// a ball (tests/app/ball_cap.h), which is verified in both ready KUKA cells.

#include <gtest/gtest.h>
#include <signal.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "app/cli/exit_code.h"
#include "base/files/file.h"
#include "base/files/zip.h"
#include "base/hex.h"
#include "base/sha256.h"
#include "segment/io/write_mesh.h"
#include "tests/app/ball_cap.h"
#include "tests/app/cli/program.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using program::Arguments;
using program::Ended;

constexpr const char* arm_alone = "kr60-ha";
constexpr const char* with_table = "kr120-r2500-pro-rotary";

fs::path cell_file(const std::string& name) {
    return fs::path(QCHOPPER_SOURCE_DIR) / "cells" / (name + ".toml");
}

Ended prepare(const fs::path& folder, const std::string& cell, const Arguments& more = {}) {
    write_file(folder / "cap.ply", to_ply(ball_cap()));
    Arguments arguments{"prepare",  "cap.ply", "--units",    "mm", "--cell", cell_file(cell).string(),
                        "--preset", "thesis",  "--max-cuts", "0",  "-o",     "p.qch"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return program::run(arguments, {folder});
}

// Made once per process and cell: a folder with the project p.qch of one piece.
const fs::path& proven(const std::string& cell) {
    static std::map<std::string, program::Folder> folders;
    const auto known = folders.find(cell);
    if (known != folders.end()) return known->second.path;
    const fs::path& folder = folders[cell].path;
    const Ended made = prepare(folder, cell);
    EXPECT_EQ(made.code, 0) << made.err << made.out;
    EXPECT_NE(made.out.find("verified"), std::string::npos) << made.out;
    return folder;
}

bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

struct VerifyCommand : ::testing::Test {
    program::Folder folder;
    fs::path job = folder.path / "p.qch" / "jobs" / "A.qjob";
    fs::path verdict = folder.path / "p.qch" / "jobs" / "A.verdict.json";

    void copy_project(const std::string& cell = arm_alone) const {
        fs::copy(proven(cell) / "p.qch", folder.path / "p.qch", fs::copy_options::recursive);
        fs::copy(proven(cell) / "cap.ply", folder.path / "cap.ply");
    }
    Ended run(const Arguments& arguments) const { return program::run(arguments, {folder.path}); }
    // Nothing listens there: a job that is refused is refused before. The piece stands on its rim.
    Ended dispatch() const {
        return run({"dispatch", "p.qch", "--to", "127.0.0.1:1", "--drop", ".", "--accept-workholding"});
    }
    // Changes a file of the job with the hashes of it in the manifest and of the job in the project.
    void change_entry(const std::string& name, const std::function<void(Bytes&)>& change) const {
        const Bytes before = read_file(job);
        std::map<std::string, Bytes> files = unzip(before, "A.qjob");
        const std::string old_hash = to_hex(sha256(files.at(name)));
        change(files.at(name));
        const Bytes& manifest = files.at("manifest.json");
        const std::string text = replaced({manifest.begin(), manifest.end()}, old_hash, to_hex(sha256(files.at(name))));
        files.at("manifest.json") = {text.begin(), text.end()};
        const Bytes after = zip(files);
        write_file(job, after);
        const fs::path project = folder.path / "p.qch" / "project.json";
        program::put(project, replaced(program::bytes_in(project), to_hex(sha256(before)), to_hex(sha256(after))));
    }
    // The same of the manifest: once, at `from` behind the first `after`.
    void change_manifest(const fs::path& job_file, const std::string& after, const std::string& from,
                         const std::string& to) const {
        const Bytes before = read_file(job_file);
        std::map<std::string, Bytes> files = unzip(before, "job");
        const Bytes& manifest = files.at("manifest.json");
        const std::string text{manifest.begin(), manifest.end()};
        const std::size_t at = text.find(after);
        ASSERT_NE(at, std::string::npos) << after;
        const std::string changed = text.substr(0, at) + replaced(text.substr(at), from, to);
        files.at("manifest.json") = {changed.begin(), changed.end()};
        const Bytes written = zip(files);
        write_file(job_file, written);
        const fs::path project = folder.path / "p.qch" / "project.json";
        program::put(project, replaced(program::bytes_in(project), to_hex(sha256(before)), to_hex(sha256(written))));
    }
    // Its lines are as long as the path of the proof, less what it goes from and to home, and it has a colour for what
    // is within tolerance.
    static void expect_view(const fs::path& file, const json& figures) {
        const Bytes bytes = read_file(file);
        EXPECT_LT(bytes.size(), 12'000'000U);
        tinygltf::Model model;
        std::string errors;
        std::string warnings;
        ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(&model, &errors, &warnings, bytes.data(),
                                                              static_cast<unsigned>(bytes.size())))
            << errors;
        double length = 0;
        for (const tinygltf::Mesh& mesh : model.meshes) {
            if (mesh.primitives[0].mode == TINYGLTF_MODE_LINE) length += length_of_lines(model, mesh.primitives[0]);
        }
        const auto path =
            std::find_if(figures.begin(), figures.end(), [](const json& f) { return f["key"] == "path_m"; });
        ASSERT_NE(path, figures.end());
        EXPECT_NEAR(length / 1000, (*path)["value"].get<double>(), 0.03 * length / 1000);
        EXPECT_EQ(model.nodes[1].name, "piece as left");
        const auto is_fine = [](const tinygltf::Material& m) { return m.name == "to 0.3"; };
        EXPECT_TRUE(std::any_of(model.materials.begin(), model.materials.end(), is_fine));
    }
    static double length_of_lines(const tinygltf::Model& model, const tinygltf::Primitive& lines) {
        const auto data = [&](int accessor) {
            const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(
                model.accessors[static_cast<std::size_t>(accessor)].bufferView)];
            return model.buffers[0].data.data() + view.byteOffset;
        };
        const std::size_t count = model.accessors[static_cast<std::size_t>(lines.indices)].count;
        std::vector<std::uint32_t> ends(count);
        std::memcpy(ends.data(), data(lines.indices), 4 * count);
        double length = 0;
        for (std::size_t i = 0; i + 1 < count; i += 2) {
            std::array<float, 6> p{};
            for (std::size_t k = 0; k < 2; ++k) {
                std::memcpy(&p[3 * k], data(lines.attributes.at("POSITION")) + 12 * std::size_t{ends[i + k]}, 12);
            }
            length += std::hypot(p[3] - p[0], p[4] - p[1], p[5] - p[2]);
        }
        return length;
    }
    // The verdict of verify, whose bytes are then those of prepare; in another folder too.
    void expect_verdict_repeats(const std::string& cell) const {
        copy_project(cell);
        const std::string made = program::bytes_in(verdict);
        fs::remove(verdict);
        const Ended again = run({"verify", "p.qch"});
        EXPECT_EQ(again.code, 0) << again.err;
        EXPECT_TRUE(has(again.out, "piece A (A.qjob): verified")) << again.out;
        EXPECT_EQ(program::bytes_in(verdict), made);
        const program::Folder elsewhere;
        fs::copy(job, elsewhere.path / "A.qjob");
        const Ended alone =
            program::run({"verify", "A.qjob", "--cell", cell_file(cell).string()}, {elsewhere.path, {}, true});
        EXPECT_EQ(alone.code, 0) << alone.err;
        json of_file = json::parse(program::bytes_in(elsewhere.path / "A.verdict.json"));
        EXPECT_TRUE(has(of_file["notes"].dump(), "its setup was not compared with that of its project"));
        of_file["notes"] = json::array();
        EXPECT_EQ(of_file, json::parse(made)) << "on one core, without the project";
        expect_view(elsewhere.path / "A.carved.glb", of_file["figures"]);
    }
};

TEST_F(VerifyCommand, RepeatsTheVerdictOfPrepareForAnArmAlone) {
    expect_verdict_repeats(arm_alone);
}

TEST_F(VerifyCommand, RepeatsTheVerdictOfPrepareForARotaryTable) {
    expect_verdict_repeats(with_table);
}

TEST_F(VerifyCommand, GivesOneDocument) {
    copy_project();
    const Ended ended = run({"verify", "p.qch", "--piece", "A", "--json"});
    const json document = json::parse(ended.out, nullptr, false);
    ASSERT_TRUE(document.is_object()) << ended.out;
    EXPECT_EQ(document["schema"], "qchopper-verify-1");
    EXPECT_EQ(document["all_positive"], true);
    ASSERT_EQ(document["jobs"].size(), 1U);
    const json& first = document["jobs"][0];
    EXPECT_EQ(first["sha256"], to_hex(sha256(read_file(job))));
    EXPECT_EQ(first["cell_sha256"], to_hex(sha256(read_file(cell_file(arm_alone)))));
    EXPECT_EQ(first["positive"], true);
    EXPECT_EQ(first["findings"], json::array());
    EXPECT_LE(first["figures"]["max_gouge_mm"].get<double>(), 0.25);
    EXPECT_GE(first["figures"]["within_tolerance_percent"].get<double>(), 99.5);
    EXPECT_EQ(first["figures"]["rapids_in_foam"], 0);
    EXPECT_EQ(first["figures"]["holder_contacts"], 0);
    EXPECT_TRUE(fs::exists(folder.path / first["verdict"].get<std::string>()));
}

TEST_F(VerifyCommand, AJobOfAnotherCellIsRefused) {
    copy_project();
    const Ended ended = run({"verify", job.string(), "--cell", cell_file(with_table).string()});
    EXPECT_EQ(ended.code, exit_demand_broken) << ended.err;
    EXPECT_TRUE(has(ended.out, "REFUSED")) << ended.out;
    EXPECT_TRUE(has(ended.out, "the job is made for cell")) << ended.out;
    EXPECT_EQ(dispatch().code, exit_demand_broken) << "the verdict beside it is that of the other cell file now";
}

TEST_F(VerifyCommand, AChangedCellFileMakesTheVerdictVoid) {
    copy_project();
    std::ofstream(folder.path / "p.qch" / "cell.toml", std::ios::app) << "# changed\n";
    const Ended refused = dispatch();
    EXPECT_EQ(refused.code, exit_demand_broken) << refused.err;
    EXPECT_TRUE(has(refused.err, "that of another cell file")) << refused.err;
    EXPECT_EQ(run({"verify", "p.qch"}).code, 0);
    EXPECT_EQ(dispatch().code, exit_unreachable) << "judged again it goes on to the cell, which is not there";
}

TEST_F(VerifyCommand, AChangedJobFileGetsNoVerdict) {
    copy_project();
    const std::string before = program::bytes_in(verdict);
    std::string bytes = program::bytes_in(job);
    bytes[bytes.size() / 2] ^= 1;
    program::put(job, bytes);
    for (const Arguments& arguments : {Arguments{"verify", "p.qch"}, Arguments{"verify", job.string()}}) {
        const Ended ended = run(arguments);
        EXPECT_EQ(ended.code, exit_mesh) << ended.err;
        EXPECT_TRUE(has(ended.err, "A.qjob")) << ended.err;
        EXPECT_TRUE(has(ended.err, "No verdict was changed.")) << ended.err;
    }
    EXPECT_EQ(program::bytes_in(verdict), before);
    EXPECT_EQ(dispatch().code, exit_mesh);
}

TEST_F(VerifyCommand, AJobWithAnotherPieceThanTheProjectIsNamed) {
    copy_project();
    change_entry("piece.stl", [](Bytes& stl) { stl[84 + 12 + 2] ^= 0x40U; });  // a coordinate of the first triangle
    const Ended ended = run({"verify", "p.qch"});
    EXPECT_EQ(ended.code, exit_demand_broken) << ended.err;
    EXPECT_TRUE(has(ended.out, "the mesh of the job is not that of piece A")) << ended.out;
}

// As if the operator had ordered it, which only the project knows.
TEST_F(VerifyCommand, ASetupOtherThanThatOfTheProjectIsNamed) {
    copy_project();
    const std::string order = "\"tools\": [\n      1,\n      3,\n      4,\n      8\n    ]";
    // Of each kind of tool the shortest, which is no order.
    const std::string chosen =
        "\"tools\": [\n      1,\n      2,\n      3,\n      4,\n      5,\n      6,\n      7,\n      8\n    ]";
    change_manifest(job, "\"setup\": {", chosen, order);
    const Ended alone = run({"verify", job.string()});
    EXPECT_EQ(alone.code, 0) << alone.err << alone.out;
    EXPECT_TRUE(has(alone.out, "Note: of the cell's tools it is carved with tools 1, 3, 4 and 8 alone.")) << alone.out;
    EXPECT_TRUE(has(alone.out, "Note: its setup was not compared")) << alone.out;
    const Ended ended = run({"verify", "p.qch"});
    EXPECT_EQ(ended.code, exit_demand_broken) << ended.err;
    EXPECT_TRUE(has(ended.out, "the setup of the job is not that of the project for piece A: other tools"))
        << ended.out;
}

TEST_F(VerifyCommand, ToolsThatAreOrderedStandInProjectAndJob) {
    copy_project();
    const Ended made = run({"setup", "p.qch", "--piece", "A", "--tools", "4,2,4", "--json"});
    ASSERT_EQ(made.code, 0) << made.err;
    const json document = json::parse(made.out, nullptr, false);
    EXPECT_EQ(document["pieces"][0]["ordered"]["tools"], json({2, 4}));
    EXPECT_EQ(document["pieces"][0]["setups"][0]["tools"], json({2, 4}));
    EXPECT_EQ(document["program"]["proven"], true) << made.err;
    EXPECT_TRUE(has(document["program"]["verdicts"][0]["notes"].dump(), "with tools 2 and 4 alone")) << made.out;
    EXPECT_TRUE(document["program"]["verdicts"][0]["figures"].contains("not_allowed_percent"));
    EXPECT_TRUE(has(made.err, "with tools 2 and 4 alone")) << made.err;
    EXPECT_EQ(run({"verify", "p.qch"}).code, 0) << "the project knows the order";
    EXPECT_EQ(run({"setup", "p.qch", "--piece", "A", "--tools", "4,99"}).code, exit_use);
    EXPECT_EQ(run({"setup", "p.qch", "--tools", "4"}).code, exit_use) << "of which piece?";
    EXPECT_EQ(run({"prepare", "p.qch", "--tools", "4"}).code, exit_use) << "belongs to a new project";
}

TEST_F(VerifyCommand, HolesOtherThanThoseOfTheProjectAreNamed) {
    write_file(folder.path / "bar.ply", to_ply(shapes::box({0, 0, 0}, {150, 60, 50}, 3)));
    const Ended made = run({"prepare", "bar.ply", "--units", "mm", "--cell", cell_file(arm_alone).string(), "--preset",
                            "thesis", "--min-cuts", "1", "--no-programs", "-o", "p.qch"});
    ASSERT_EQ(made.code, 0) << made.err;
    const fs::path cut = folder.path / "p.qch" / "jobs" / "B.qjob";
    const Ended as_made = run({"verify", "p.qch"});
    EXPECT_FALSE(has(as_made.out, "hole")) << as_made.out;
    change_manifest(cut, "\"caps\"", "\"depth_mm\": 22", "\"depth_mm\": 20");
    const Ended ended = run({"verify", "p.qch"});
    EXPECT_EQ(ended.code, exit_demand_broken) << ended.err;
    EXPECT_TRUE(has(ended.out, "piece B: hole 1 is 20.000 mm deep, in the joint with piece C at cut 1 it is 22.000 mm"))
        << ended.out;
}

TEST_F(VerifyCommand, ATruncatedProgramIsNamedAndNotSent) {
    copy_project();
    std::string data;  // of the main program
    for (const auto& [name, bytes] : unzip(read_file(job), "A.qjob")) {
        if (name.ends_with("_1.dat")) data = name;
    }
    change_entry(data, [](Bytes& text) { text.back() = ' '; });
    EXPECT_EQ(dispatch().code, exit_demand_broken) << "the verdict is that of other bytes";
    const Ended ended = run({"verify", "p.qch"});
    EXPECT_EQ(ended.code, exit_demand_broken) << ended.err;
    EXPECT_TRUE(has(ended.out, data)) << ended.out;
    const Ended refused = dispatch();
    EXPECT_EQ(refused.code, exit_demand_broken);
    EXPECT_TRUE(has(refused.err, "its verdict is negative: ")) << refused.err;
    EXPECT_TRUE(has(refused.err, data)) << refused.err;
}

TEST_F(VerifyCommand, AJobWithoutAProgramGoesToASimulatedCellOnly) {
    const Ended made = prepare(folder.path, arm_alone, {"--no-programs"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_FALSE(fs::exists(verdict));
    const Ended dry = run({"dry-run", "p.qch"});
    EXPECT_EQ(dry.code, 0) << dry.err;
    EXPECT_TRUE(has(dry.err, "it holds no robot program")) << dry.err;
    const Ended ended = run({"verify", "p.qch"});
    EXPECT_EQ(ended.code, exit_demand_broken) << ended.err;
    EXPECT_TRUE(has(ended.out, "the job holds no robot program: prepare was asked for none")) << ended.out;
}

TEST_F(VerifyCommand, AProjectMadeWithoutProgramsGoesOnWithoutThemUntilItIsToldTo) {
    const Ended made = prepare(folder.path, arm_alone, {"--no-programs"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(run({"prepare", "p.qch"}).code, 0);
    EXPECT_FALSE(fs::exists(verdict));
    EXPECT_EQ(run({"prepare", "p.qch", "--programs", "--no-programs"}).code, exit_use);
    const Ended with = run({"prepare", "p.qch", "--programs"});
    EXPECT_EQ(with.code, 0) << with.err;
    EXPECT_TRUE(fs::exists(verdict));
    EXPECT_EQ(run({"prepare", "p.qch"}).code, 0);
    EXPECT_TRUE(fs::exists(verdict)) << "that is kept too";
}

TEST_F(VerifyCommand, AVerifiedJobGoesToTheCell) {
    copy_project();
    fs::create_directory(folder.path / "drop");
    program::Process cell(
        {"cell-sim", "--listen", "127.0.0.1:0", "--drop", "drop", "--speed", "100000", "--consent", "auto", "--json"},
        {folder.path});
    ASSERT_TRUE(cell.waits_until_out("\n")) << cell.err();
    const std::string to = json::parse(cell.out())["listening"];
    const Ended ended = run({"dispatch", "p.qch", "--to", to, "--drop", "drop", "--accept-workholding"});
    EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
    EXPECT_FALSE(has(ended.err, "warning")) << ended.err;
    cell.signal(SIGTERM);
    EXPECT_EQ(cell.wait().code, 0);
}

// "1000.000,0.000,310.000,0.0000,0.0000,0.0000": of the configuration module, moved along x.
std::string base_of(const fs::path& job, double moved) {
    std::string source;
    for (const auto& [name, bytes] : unzip(read_file(job), "A.qjob")) {
        if (name.ends_with("_cfg.dat")) source = {bytes.begin(), bytes.end()};
    }
    const std::size_t at = source.find("_base = {X ");
    EXPECT_NE(at, std::string::npos);
    if (at == std::string::npos) return {};
    std::array<double, 6> v{};
    EXPECT_EQ(std::sscanf(source.c_str() + at, "_base = {X %lf,Y %lf,Z %lf,A %lf,B %lf,C %lf", &v[0], &v[1], &v[2],
                          &v[3], &v[4], &v[5]),
              6);
    v[0] += moved;
    std::string words;
    for (const double value : v) words += (words.empty() ? "" : ",") + std::to_string(value);
    return words;
}

TEST_F(VerifyCommand, EnteredValuesAreProvenAndNothingIsWritten) {
    copy_project();
    const std::string kept = program::bytes_in(verdict);
    const Arguments base{"verify", job.string(), "--base", base_of(job, 15)};
    const Ended ended = run(base);
    EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
    EXPECT_TRUE(has(ended.out, "piece A (A.qjob): verified")) << ended.out;
    EXPECT_TRUE(has(ended.out, "Entered values: base X ")) << ended.out;
    EXPECT_TRUE(has(ended.out, ", 15.00 mm and 0.000 degrees from the planned one.")) << ended.out;
    EXPECT_TRUE(has(ended.out, "1 of 1 job verified with the entered values; no file was written")) << ended.out;
    EXPECT_EQ(program::bytes_in(verdict), kept);
    EXPECT_FALSE(fs::exists(folder.path / "p.qch" / "jobs" / "A.carved.glb"));

    const json planned = json::parse(kept);
    const int tool = planned["time"][0]["tool"];
    const Ended too_long = run({"verify", job.string(), "--tool", std::to_string(tool) + "=900"});
    EXPECT_EQ(too_long.code, exit_use);
    const std::size_t at = too_long.err.find(" mm from the ");
    ASSERT_NE(at, std::string::npos) << too_long.err;
    const double length = std::stod(too_long.err.substr(at + 13)) + 1.5;
    Arguments both = base;
    both.insert(both.end(), {"--tool", std::to_string(tool) + "=" + std::to_string(length), "--json"});
    const json document = json::parse(run(both).out, nullptr, false);
    ASSERT_TRUE(document.is_object());
    const json& first = document["jobs"][0];
    EXPECT_EQ(first["positive"], true) << first["findings"].dump();
    EXPECT_FALSE(first.contains("verdict"));
    const json& entered = first["entered_values"];
    EXPECT_NEAR(entered["base"]["off_mm"].get<double>(), 15, 1e-3);
    EXPECT_NEAR(entered["base"]["off_deg"].get<double>(), 0, 1e-3);
    EXPECT_NEAR(entered["base"]["entered"]["shift_mm"][0].get<double>() -
                    entered["base"]["planned"]["shift_mm"][0].get<double>(),
                15, 1e-3);
    EXPECT_EQ(entered["base"]["entered"]["abc_deg"].size(), 3U);
    ASSERT_EQ(entered["lengths"].size(), 1U);
    EXPECT_EQ(entered["lengths"][0]["tool"], tool);
    EXPECT_NEAR(entered["lengths"][0]["entered_mm"].get<double>() - entered["lengths"][0]["planned_mm"].get<double>(),
                1.5, 1e-3);
    EXPECT_EQ(program::bytes_in(verdict), kept);
}

TEST_F(VerifyCommand, EnteredValuesThatCannotBeAreRefused) {
    copy_project();
    const std::string kept = program::bytes_in(verdict);
    const auto expect_refused = [&](const Arguments& values, const std::string& words) {
        Arguments arguments{"verify", job.string()};
        arguments.insert(arguments.end(), values.begin(), values.end());
        const Ended ended = run(arguments);
        EXPECT_EQ(ended.code, exit_use) << ended.err;
        EXPECT_TRUE(has(ended.err, words)) << ended.err;
    };
    expect_refused({"--base", base_of(job, 1000)}, "No verdict was changed.");
    expect_refused({"--base", base_of(job, 1000)},
                   "the entered base is 1000.0 mm and 0.00 degrees from the base that ");
    expect_refused({"--base", "1,2,3"}, "\"1,2,3\" is no X,Y,Z,A,B,C");
    expect_refused({"--base", "1,2,3,4,5,nan"}, "is no X,Y,Z,A,B,C");
    expect_refused({"--tool", "1=long"}, "\"1=long\" is no N=LENGTH");
    expect_refused({"--tool", "99=200"}, "does not use tool 99, but tool");
    const int tool = json::parse(kept)["time"][0]["tool"];
    expect_refused({"--tool", std::to_string(tool) + "=900"}, "at most 2 mm are allowed");
    const Ended project = run({"verify", "p.qch", "--base", base_of(job, 1)});
    EXPECT_EQ(project.code, exit_use);
    EXPECT_TRUE(has(project.err, "p.qch is a project, and --base and --tool are of one job")) << project.err;
    EXPECT_EQ(program::bytes_in(verdict), kept);
}

TEST_F(VerifyCommand, WrongUseIsNamed) {
    copy_project();
    const auto expect_refused = [&](const Arguments& arguments, int code, const std::string& words) {
        const Ended ended = run(arguments);
        EXPECT_EQ(ended.code, code) << ended.err;
        EXPECT_TRUE(has(ended.err, words)) << ended.err;
    };
    expect_refused({"verify", "p.qch", "--cell", cell_file(arm_alone).string()}, exit_use, "leave --cell out");
    expect_refused({"verify", job.string(), "--piece", "A"}, exit_use, "leave --piece out");
    expect_refused({"verify", "p.qch", "--piece", "Z"}, exit_use, "Z");
    expect_refused({"verify", "none.qjob", "--cell", cell_file(arm_alone).string()}, exit_missing, "none.qjob");
    fs::copy(job, folder.path / "A.qjob");
    expect_refused({"verify", "A.qjob"}, exit_use, "pass --cell FILE");
    expect_refused({"verify", "cap.ply", "--cell", cell_file(arm_alone).string()}, exit_mesh, "cap.ply");
}

}  // namespace
}  // namespace qchopper
