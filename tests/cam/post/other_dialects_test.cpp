// Programs in RAPID and RS-274/NGC as text: sizes, names, line ends, what is stated once, what is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "cam/cell/kuka_angles.h"
#include "cam/post/post.h"
#include "cam/post/rapid_chunk.h"
#include "cam/post/rapid_text.h"
#include "tests/cam/post/scanned_krl.h"
#include "tests/cam/program/hand_made.h"

namespace qchopper {
namespace {

using test_programs::Job;
using test_programs::job_in;
using test_programs::program_of;
using test_programs::ready_cell;

const Job& abb_job() {
    static const Job job = job_in(ready_cell("irb6640-185-2.8.toml"), {250, 200, 150}, 25, 200);
    return job;
}

Job gantry_job() {
    Job job = job_in(ready_cell("gantry-3axis.toml"), {250, 200, 150}, 0, 0);
    job.toolpath.operations.pop_back();
    return job;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find("\r\n", at);
        EXPECT_NE(end, std::string::npos) << "a line ends with CR LF";
        lines.push_back(text.substr(at, end - at));
        at = end + 2;
    }
    return lines;
}

std::string all_text(const std::vector<ProgramPart>& parts) {
    std::string text;
    for (const ProgramPart& part : parts) {
        for (const ProgramText& file : part.files) text += file.text;
    }
    return text;
}

std::size_t count_of(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

TEST(PostRapid, IsPlainAndSmall) {
    const test_krl::CommaLocale comma;
    const std::vector<ProgramPart> parts = post_program(program_of(abb_job()), abb_job().cell, {7});
    std::size_t moves = 0;
    std::size_t bytes = 0;
    for (const std::string& line : lines_of(all_text(parts))) {
        EXPECT_TRUE(std::ranges::all_of(line, [](char c) { return c >= ' ' && c <= '~'; })) << line;
        EXPECT_EQ(line.find("-0.00,"), std::string::npos) << line;
        if (line.starts_with("MoveL ")) ++moves, bytes += line.size() + 2;
        EXPECT_LE(line.size() + 2, line.starts_with("MoveAbsJ ") ? 241U : 400U);
        for (std::size_t at = 0; at < line.size();) {
            const std::size_t end = std::min(line.find_first_of(" (),;:=[]\\\"%", at), line.size());
            EXPECT_LE(end - at, 32U) << line;
            at = end + 1;
        }
    }
    EXPECT_LE(static_cast<double>(bytes) / static_cast<double>(moves), 120.0);
    std::printf("RAPID: %.1f bytes a straight move\n", static_cast<double>(bytes) / static_cast<double>(moves));
    EXPECT_EQ(all_text(parts), all_text(post_program(program_of(abb_job()), abb_job().cell, {7})));
}

TEST(PostRapid, ToolsAndWorkObjectStandOnce) {
    const std::vector<ProgramPart> parts = post_program(program_of(abb_job()), abb_job().cell, {7});
    const std::string text = all_text(parts);
    EXPECT_EQ(count_of(text, "PERS tooldata "), 2U);
    EXPECT_EQ(count_of(text, "PERS wobjdata "), 1U);
    EXPECT_EQ(count_of(parts[0].files[0].text, "PERS "), 3U);
    EXPECT_EQ(count_of(text, "LOCAL CONST robtarget p:="), parts[0].chunks.size());
    EXPECT_EQ(count_of(text, "TRAP " + RapidNames{"qc_7"}.trap()), 1U);
    EXPECT_EQ(count_of(text, "PROC " + rapid_procedure("qc_7_001") + "()"), 1U);
}

TEST(PostRapid, QuaternionsAreNormalised) {
    for (const std::string& line : lines_of(all_text(post_program(program_of(abb_job()), abb_job().cell, {7})))) {
        if (!line.starts_with("LOCAL CONST robtarget")) continue;
        double squared = 0;
        std::size_t at = line.find("],[") + 3;
        for (int i = 0; i < 4; ++i) {
            const std::size_t end = line.find_first_of(",]", at);
            EXPECT_EQ(end - line.find('.', at) - 1, 8U) << line;
            squared += std::pow(std::strtod(line.substr(at, end - at).c_str(), nullptr), 2);
            at = end + 1;
        }
        EXPECT_NEAR(squared, 1, 4e-8);
    }
}

// w, x, y, z turn the unit vectors to the columns of the pose.
TEST(PostRapid, QuaternionsAreTheRotation) {
    for (double a = -3; a <= 3; a += 0.7) {
        for (double b = -1.5; b <= 1.5; b += 0.3) {
            for (double c = -3.1; c <= 3.1; c += 0.6) {
                const Pose pose = pose_of({a, b, c}, {});
                double q[4];
                const std::string text = rapid::quaternion(pose);
                ASSERT_EQ(std::sscanf(text.c_str(), "[%lf,%lf,%lf,%lf]", &q[0], &q[1], &q[2], &q[3]), 4) << text;
                EXPECT_GE(q[0], 0);
                const Vec3 v{q[1], q[2], q[3]};
                for (const Vec3 unit : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
                    const Vec3 turned = unit + 2 * q[0] * cross(v, unit) + 2 * cross(v, cross(v, unit));
                    EXPECT_NEAR(norm(turned - rotate(pose, unit)), 0, 1e-7) << text;
                }
            }
        }
    }
}

TEST(PostRapid, LoadsModulesWhereTheyDoNotFitTogether) {
    Cell cell = abb_job().cell;
    const std::size_t bytes = all_text(post_program(program_of(abb_job()), cell, {7})).size();
    EXPECT_EQ(count_of(all_text(post_program(program_of(abb_job()), cell, {7})), "Load"), 0U);
    cell.machine->program.memory_bytes = static_cast<std::uint32_t>(bytes / 2);
    const std::vector<ProgramPart> parts = post_program(program_of(abb_job()), cell, {7});
    ASSERT_EQ(parts.size(), 1U);
    const std::string& main = parts[0].files[0].text;
    EXPECT_EQ(count_of(main, "Load\\Dynamic,\"HOME:/qc_7_"), parts[0].chunks.size());
    EXPECT_EQ(count_of(main, "UnLoad \"HOME:/qc_7_"), parts[0].chunks.size());
    for (const ProgramText& file : parts[0].files) EXPECT_LE(file.text.size(), bytes / 4 + 3000);
}

TEST(PostRapid, ATableIsAMechanicalUnit) {
    Cell cell = ready_cell("kr120-r2500-pro-rotary.toml");
    cell.machine->program.dialect = Dialect::rapid;
    const Job job = job_in(cell, {300, 240, 200}, 40, 120);
    const std::string text = all_text(post_program(program_of(job), cell, {7}));
    EXPECT_EQ(count_of(text, ":=[FALSE,FALSE,\"STN1\",[[0.000,0.000,0.000],"), 1U);
    for (const std::string& line : lines_of(text)) {
        if (!line.starts_with("MoveAbsJ ") && !line.starts_with("LOCAL CONST")) continue;
        EXPECT_EQ(count_of(line, "9E9"), 5U) << line;
    }
}

TEST(PostNgc, BeginsWithItsModes) {
    const Job job = gantry_job();
    const std::vector<ProgramPart> parts = post_program(program_of(job), job.cell, {7});
    const std::vector<std::string> main = lines_of(parts[0].files[0].text);
    EXPECT_EQ(main[1], "G21");
    EXPECT_EQ(main[2], "G90 G17 G94 G40");
    EXPECT_EQ(main[3], "G54");
    EXPECT_EQ(main.back(), "M2");
    EXPECT_EQ(parts[0].chunks.size(), 2U);
    for (const std::string& line : lines_of(all_text(parts))) {
        EXPECT_NE(line, "G64");
        const bool is_mixed = line.find('Z') != std::string::npos && line.find('X') != std::string::npos;
        EXPECT_FALSE(line.starts_with("G0 ") && is_mixed) << line;
    }
    const std::string text = all_text(parts);
    EXPECT_EQ(count_of(text, "o<qc_7_001> sub"), 1U);
    EXPECT_EQ(count_of(text, "o<qc_7_001> call"), 1U);
    EXPECT_EQ(count_of(text, " M6\r\n"), 2U);
}

std::string refusal(const Program& program, const Cell& cell) {
    try {
        post_program(program, cell, {7});
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(PostNgc, RefusesWhatAGantryCannot) {
    const Job job = gantry_job();
    Program tilted = program_of(job);
    tilted.operations[1].tool_axis = normalized({0.3, 0, 1});
    EXPECT_NE(refusal(tilted, job.cell).find("tilts nothing"), std::string::npos);
    Cell with_signal = job.cell;
    with_signal.machine->spindle.on = Signal{SignalKind::output, "3", 1};
    EXPECT_NE(refusal(program_of(job), with_signal).find("M3"), std::string::npos);
}

TEST(PostOtherDialects, APieceOfAnotherNumberHasOtherNames) {
    const Job gantry = gantry_job();
    for (const Job* job : {&abb_job(), &gantry}) {
        const std::vector<ProgramPart> seven = post_program(program_of(*job), job->cell, {7});
        const std::vector<ProgramPart> eight = post_program(program_of(*job), job->cell, {8});
        for (std::size_t i = 0; i < seven[0].files.size(); ++i) {
            EXPECT_EQ(renamed_file(seven[0].files[i].name, {7}, {8}), eight[0].files[i].name);
            EXPECT_EQ(renamed_text(seven[0].files[i].text, {7}, {8}), eight[0].files[i].text);
        }
    }
}

}  // namespace
}  // namespace qchopper
