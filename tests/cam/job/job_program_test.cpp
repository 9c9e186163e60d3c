// The program of a job: written into the job file and read back, and what a reader refuses.

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/zip.h"
#include "cam/job/job_caps.h"
#include "cam/job/program_document.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "tests/cam/job/some_job.h"

namespace qchopper {
namespace {

using namespace test_pieces;

ProgramInput some_program() {
    ProgramInput input;
    JobProgram& program = input.program;
    program.entry = "qc_2.src";
    program.files = {"qc_2.src", "qc_2.dat", "qc_2_001.src", "qc_2_002.src"};
    program.chunks = {{"qc_2_001.src", 1, 0, 120, 4567.25, {{-1, -2, 0}, {3, 4, 60}}, {0, 0, 60}, {1, 1, 60}},
                      {"qc_2_002.src", 7, 1, 30, 89, {{-1, -2, -3}, {3, 4, 60}}, {0, 0, 60}, {2, 1, 60}}};
    program.scallop_mm = 0.25;
    program.time_s = 3599.2;
    program.left_out = {{1, std::nullopt, "tool 2 roughs"}, {std::nullopt, 2, "nothing is left"}, {7, 0, "its holder"}};
    program.moves_left_out = {6.75, "operation 2 of the toolpath: link 5 comes too near to the block"};
    for (const std::string& name : program.files) input.texts[name] = "DEF " + name + "\r\nEND\r\n";
    input.tools = {1, 7};
    input.proof.figures = {{"max_gouge_mm", "largest gouge", 0.125, "mm", 3}};
    input.deviation_picture = {0x89, 'P', 'N', 'G'};
    return input;
}

JobInput job_with_program() {
    JobInput input = tilting_job(3);
    input.program = some_program();
    return input;
}

std::string refusal(const Bytes& bytes) {
    try {
        parse_job(bytes, "AB.qjob");
    } catch (const InputError& error) {
        return error.what();
    }
    return "taken";
}

TEST(JobProgram, IsReadAsItWasWritten) {
    const JobInput input = job_with_program();
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    ASSERT_TRUE(job.program);
    EXPECT_EQ(*job.program, input.program->program);
    EXPECT_TRUE(job.no_program_because.empty());
    for (const auto& [name, text] : input.program->texts) {
        ASSERT_TRUE(job.files.contains(name)) << name;
        EXPECT_EQ(job.files.at(name), Bytes(text.begin(), text.end()));
    }
    EXPECT_EQ(job.ticket.estimated_time_s, 3600U);
    EXPECT_EQ(job.ticket.tool_no, 1);
    EXPECT_EQ(job.ticket.tool_diameter, 20);
    EXPECT_EQ(job.ticket.feed_max_mm_per_min, 9000U);
    EXPECT_EQ(job.ticket.part, 0);
    EXPECT_EQ(job.ticket.parts, 0);
}

TEST(JobProgram, MovesThatAreLeftOutStandInManifestAndSheet) {
    const ReadJob job = parse_job(job_file(job_with_program()), "AB.qjob");
    for (const char* sheet : {"setup.html", "details.html"}) {
        EXPECT_NE(text_of(job.files.at(sheet))
                      .find("no arm posture reaches 7 mm of its cuts: operation 2 of the toolpath: link 5"),
                  std::string::npos);
    }
    JobInput without = job_with_program();
    without.program->program.moves_left_out = {};
    const std::string whole = text_of(parse_job(job_file(without), "AB.qjob").files.at("setup.html"));
    EXPECT_EQ(whole.find("no arm posture"), std::string::npos);
    without.program->program.moves_left_out.length_mm = 1;
    EXPECT_NE(refusal(job_file(without)).find("because contradicts the length"), std::string::npos);
}

TEST(JobProgram, ToolsThatAreLeftOutStandInTheSheetAndNoOthersThanAllowedOnesAreUsed) {
    JobInput input = job_with_program();
    input.setup.tools = {1, 7};
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    EXPECT_EQ(job.setup.tools, input.setup.tools);
    const std::string details = text_of(job.files.at("details.html"));
    EXPECT_NE(details.find("carved with tools 1 and 7 alone"), std::string::npos);
    EXPECT_NE(details.find("tool 2 roughs"), std::string::npos);
    EXPECT_NE(text_of(job.files.at("setup.html")).find("Tools or orientations left out: "), std::string::npos);
    input.setup.tools = {7};
    EXPECT_NE(refusal(job_file(input)).find("tool 1 of qc_2_001.src is none of those that are allowed"),
              std::string::npos);
    input.setup.tools = {7, 1};
    EXPECT_NE(refusal(job_file(input)).find("tools are not in order"), std::string::npos);
    input.setup.tools.clear();
    input.program->program.left_out[0].because.clear();
    EXPECT_NE(refusal(job_file(input)).find("because is empty"), std::string::npos);
}

JobInput job_that_drills() {
    JobInput input = job_with_program();
    input.caps = {capped(input, 3)};
    decide_holes(input.caps, {1, 3}, {{2, "the piece stands over it"}}, "");
    input.program->program.drilling = {{{0.6, 0, 0.8}, 0.25}, {{0, 0.6, 0.8}, -0.5}};
    input.program->program.holes = {1, 3};
    return input;
}

TEST(JobProgram, WhatItDrillsIsReadAsItWasWritten) {
    const JobInput input = job_that_drills();
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    EXPECT_EQ(*job.program, input.program->program);
    ASSERT_EQ(job.caps.size(), 1U);
    EXPECT_EQ(job.caps[0], input.caps[0].cap);
    const Bytes& sheet = job.files.at("details.html");
    const std::string text(sheet.begin(), sheet.end());
    EXPECT_NE(text.find("by the robot"), std::string::npos);
    EXPECT_NE(text.find("by hand: the piece stands over it"), std::string::npos);
}

TEST(JobProgram, WhatItDrillsIsWhatTheCapsSay) {
    const auto refused = [](const std::function<void(JobInput&)>& change) {
        JobInput input = job_that_drills();
        change(input);
        return refusal(job_file(input));
    };
    EXPECT_EQ(refused([](JobInput&) {}), "taken");
    EXPECT_NE(refused([](JobInput& i) { i.program->program.holes = {1}; }).find("drilled by no program"),
              std::string::npos);
    EXPECT_NE(refused([](JobInput& i) { i.program->program.holes = {1, 2, 3}; }).find("hole 2"), std::string::npos);
    EXPECT_NE(refused([](JobInput& i) { i.program->program.holes = {3, 1}; }).find("not in order"), std::string::npos);
    EXPECT_NE(refused([](JobInput& i) { i.program->program.drilling[0].tool_axis.x = 0.7; }).find("length 1"),
              std::string::npos);
    EXPECT_NE(refused([](JobInput& i) { i.program.reset(); }).find("drilled by no program"), std::string::npos);
}

TEST(JobProgram, AJobWithoutOneSaysWhy) {
    JobInput input = tilting_job(3);
    input.no_program_because = "the cell file describes no machine";
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    EXPECT_FALSE(job.program);
    EXPECT_EQ(job.no_program_because, "the cell file describes no machine");
}

TEST(JobProgram, PartsNameTheJobBefore) {
    JobInput input = job_with_program();
    JobPart& part = input.program->program.part;
    part = {2, 3, sha256({})};
    input.program->stock = {1, 2, 3};
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    EXPECT_EQ(job.program->part, part);
    EXPECT_EQ(job.files.at("stock.bin"), input.program->stock);
    EXPECT_EQ(job.ticket.part, 2);
    EXPECT_EQ(job.ticket.parts, 3);
    part.before.reset();
    EXPECT_NE(refusal(job_file(input)).find("before_sha256"), std::string::npos);
}

TEST(JobProgram, ARestartNamesItsJobAndCarriesItsStock) {
    const JobInput whole = job_with_program();
    const ReadJob first = parse_job(job_file(whole), "AB.qjob");
    ProgramInput program = *whole.program;
    program.program.restart = {first.file_sha256, 1};
    program.program.chunks.erase(program.program.chunks.begin());
    program.program.entry = "qc_2_r2.src";
    program.program.files = {"qc_2_r2.src", "qc_2_002.src"};
    program.program.time_s = 100;
    program.texts = {{"qc_2_r2.src", "x"}, {"qc_2_002.src", "y"}};
    program.tools = {7};
    program.stock = {1, 2, 3};
    const Bytes bytes = restart_job_file(first, program, whole.cell);
    const ReadJob job = parse_job(bytes, "AB.r2.qjob");
    EXPECT_EQ(*job.program, program.program);
    EXPECT_EQ(job.files.at("stock.bin"), program.stock);
    EXPECT_FALSE(job.files.contains("qc_2_001.src"));
    EXPECT_EQ(job.files.at("piece.stl"), first.files.at("piece.stl"));
    EXPECT_EQ(job.setup, first.setup);
    EXPECT_EQ(job.ticket.tool_no, 7);
    EXPECT_EQ(job.ticket.estimated_time_s, 100U);
    EXPECT_EQ(job_file_name("AB", 1, 2), "AB.r2.qjob");
    EXPECT_EQ(job_file_name("AB", 3, 12), "AB.p3.r12.qjob");
    std::map<std::string, Bytes> files = unzip(bytes, "AB.r2.qjob");
    files.at("stock.bin")[1] ^= 1;
    EXPECT_NE(refusal(zip(files)).find("stock.bin does not match its SHA-256"), std::string::npos);
    program.program.restart.reset();
    EXPECT_NE(refusal(restart_job_file(first, program, whole.cell)).find("taken"), std::string::npos)
        << "no stock is carried where nothing is restarted";
    EXPECT_FALSE(parse_job(job_file(whole), "AB.qjob").files.contains("stock.bin"));
}

TEST(JobProgram, SheetAndDetailsShowTimeToolsFiguresAndPicture) {
    JobInput input = job_with_program();
    const ReadJob job = parse_job(job_file(input), "AB.qjob");
    const std::string sheet = text_of(job.files.at("setup.html"));
    const std::string details = text_of(job.files.at("details.html"));
    for (const char* text : {"5. Program and time", "started as qc_2", "<td class=\"n\">7</td>"}) {
        EXPECT_NE(sheet.find(text), std::string::npos) << text;
    }
    for (const char* text : {"largest gouge", "0.125", "deviation.png", "qc_2_002.src"}) {
        EXPECT_NE(details.find(text), std::string::npos) << text;
    }
    EXPECT_EQ(sheet.find("found faults"), std::string::npos);
    input.program->proof.findings = {{"rapid_in_foam", "qc_2_001.src", 7, "rapid move in foam"},
                                     {"rapid_in_foam", "qc_2_001.src", 9, "another"}};
    const ReadJob refused = parse_job(job_file(input), "AB.qjob");
    const std::string stop = text_of(refused.files.at("setup.html"));
    EXPECT_NE(stop.find("DO NOT START: the replay of the program found faults"), std::string::npos);
    EXPECT_NE(stop.find("line 7: rapid move in foam"), std::string::npos);
    EXPECT_NE(text_of(refused.files.at("details.html")).find("line 9: another"), std::string::npos);
}

using Change = std::function<void(nlohmann::ordered_json& program)>;

// What a reader says of the program after a change.
std::string fault_after(const Change& change) {
    nlohmann::ordered_json json;
    put(json, some_program().program);
    change(json);
    try {
        JobProgram program;
        take(json, "programs", program);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "taken";
}

TEST(JobProgram, AProgramThatContradictsItselfIsRefused) {
    const std::pair<const char*, Change> cases[] = {
        {"dialect", [](auto& p) { p["dialect"] = "basic"; }},
        {"entry", [](auto& p) { p["entry"] = "other.src"; }},
        {"files", [](auto& p) { p["files"][1] = "../qc_2.dat"; }},
        {"files", [](auto& p) { p["files"][1] = "qc_2.src"; }},
        {"file", [](auto& p) { p["chunks"][0]["file"] = "qc_2_009.src"; }},
        {"orientation", [](auto& p) { p["chunks"][0]["orientation"] = 0; }},
        {"length_mm", [](auto& p) { p["chunks"][0]["length_mm"] = -1; }},
        {"chunks", [](auto& p) { p["chunks"] = nlohmann::ordered_json::array(); }},
        {"number", [](auto& p) { p["part"]["number"] = 2; }},
        {"scallop_mm", [](auto& p) { p["scallop_mm"] = "0.25"; }}};
    for (const auto& [key, change] : cases) {
        EXPECT_EQ(fault_after(change).find(key), 0U) << key << ": " << fault_after(change);
    }
    EXPECT_EQ(fault_after([](auto&) {}), "taken");
}

TEST(JobProgram, FilesAndProgramBelongTogether) {
    const ProgramInput input = some_program();
    std::map<std::string, Bytes> files;
    for (const auto& [name, text] : input.texts) files[name] = {};
    EXPECT_EQ(fault_of_program_files(input.program, files), "");
    EXPECT_NE(fault_of_program_files(std::nullopt, files), "");
    files["qc_2_003.src"] = {};
    EXPECT_EQ(fault_of_program_files(input.program, files), "qc_2_003.src belongs to no program of the manifest");
    files.erase("qc_2_003.src");
    files.erase("qc_2.dat");
    EXPECT_EQ(fault_of_program_files(input.program, files), "qc_2.dat, a file of the program, is missing");
}

}  // namespace
}  // namespace qchopper
