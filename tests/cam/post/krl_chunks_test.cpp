// Sizes of chunks and parts, of random programs.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <set>

#include "tests/cam/post/scanned_krl.h"
#include "tests/cam/program/hand_made.h"

namespace qchopper {
namespace {

constexpr std::size_t lines_beside_runs = 70;

Cell kr60() {
    return test_programs::ready_cell("kr60-ha.toml");
}

class RandomProgram {
 public:
    explicit RandomProgram(unsigned seed) : random_(seed) {}

    Program make(const Cell& cell, std::size_t sections, std::size_t max_runs, std::size_t max_moves) {
        Program program;
        for (const CuttingTool& tool : cell.machine->tools) {
            program.tools.push_back({{}, load_data(cell.machine->spindle, tool)});
        }
        for (std::size_t i = 0; i < sections; ++i) {
            ProgramOperation operation;
            operation.tool = whole(0, 3);
            operation.orientation = whole(0, 2);
            operation.rpm = 15'000;
            operation.link_feed = 300;
            operation.entry = {0, 300, {Joints{}}};
            operation.exit = {0, 300, {Joints{}}};
            for (std::size_t r = whole(1, max_runs); r > 0; --r) operation.runs.push_back(run(whole(1, max_moves)));
            program.operations.push_back(std::move(operation));
        }
        return program;
    }

    std::size_t whole(std::size_t least, std::size_t most) {
        return std::uniform_int_distribution<std::size_t>(least, most)(random_);
    }

 private:
    Vec3 point() {
        const auto number = [&] { return std::uniform_real_distribution<double>(-900, 900)(random_); };
        return {number(), number(), number()};
    }

    ProgramRun run(std::size_t moves) {
        ProgramRun made;
        made.start = point();
        made.link_speed = 300;
        for (std::size_t i = 0; i < moves; ++i) {
            made.moves.push_back({point(), MoveKind::cut, static_cast<double>(i % 3), whole(0, 3) > 0 ? 100.0 : 55.0});
        }
        return made;
    }

    std::mt19937 random_;
};

std::size_t lines_of_text(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(KrlChunks, HoldEveryRunOnceAndAreSmallEnough) {
    RandomProgram random(1);
    for (int i = 0; i < 40; ++i) {
        Cell cell = kr60();
        cell.machine->program.lines_per_chunk = static_cast<std::uint32_t>(random.whole(200, 900));
        cell.machine->program.memory_bytes = static_cast<std::uint32_t>(random.whole(40'000, 200'000));
        const Program program = random.make(cell, random.whole(1, 6), 12, 60);
        const std::vector<ProgramPart> parts = post_program(program, cell, {3});
        std::size_t order = 0;
        std::vector<std::size_t> runs(program.operations.size(), 0);
        std::set<std::string> names;
        std::size_t at_operation = 0;
        for (const ProgramPart& part : parts) {
            std::size_t bytes = 0;
            for (const ProgramText& file : part.files) {
                bytes += file.text.size();
                const bool is_of_module = file.name.starts_with("qc_3_cfg");
                EXPECT_TRUE(names.insert(file.name).second || is_of_module) << file.name;
                const bool is_chunk = file.name.find("qc_3_0") == 0;
                if (!is_chunk) continue;
                EXPECT_LE(lines_of_text(file.text), cell.machine->program.lines_per_chunk);
                EXPECT_LE(file.text.size(), cell.machine->program.memory_bytes / 2);
            }
            EXPECT_LE(bytes, cell.machine->program.memory_bytes);
            for (const PostedChunk& chunk : part.chunks) {
                EXPECT_EQ(chunk.order, order++);
                EXPECT_GE(chunk.operation, at_operation);
                at_operation = chunk.operation;
                EXPECT_EQ(chunk.first_run, runs[chunk.operation]);
                runs[chunk.operation] += chunk.runs;
                EXPECT_EQ(chunk.tool, program.operations[chunk.operation].tool);
                EXPECT_EQ(chunk.orientation, program.operations[chunk.operation].orientation);
                EXPECT_FALSE(test_krl::text_of(part, chunk.name).empty());
            }
            EXPECT_EQ(part.files.size(), part.chunks.size() + 4);
        }
        for (std::size_t s = 0; s < runs.size(); ++s) EXPECT_EQ(runs[s], program.operations[s].runs.size());
    }
}

TEST(KrlChunks, StateTheLimitsOfTheCellFile) {
    Cell cell = kr60();
    cell.machine->program.acceleration = 1500;
    cell.machine->program.turn_speed = std::numbers::pi / 4;
    cell.machine->program.joint_share = 0.2;
    const ProgramPart part = post_program(RandomProgram(4).make(cell, 2, 3, 5), cell, {3}).front();
    for (const ProgramText& file : part.files) {
        if (file.name.ends_with(".dat") || file.name.starts_with("qc_3_cfg")) continue;
        const bool is_chunk = file.name.starts_with("qc_3_0");
        const auto states = [&](const char* line) {
            return file.text.find(std::string("\r\n") + line + "\r\n") != std::string::npos;
        };
        EXPECT_TRUE(states("$VEL_AXIS[1] = 20") && states("$ACC_AXIS[6] = 20")) << file.name;
        EXPECT_EQ(states("$ACC.CP = 1.5000"), is_chunk) << file.name;
        EXPECT_EQ(states("$VEL.ORI1 = 45.0000") && states("$VEL.ORI2 = 45.0000"), is_chunk) << file.name;
    }
}

TEST(KrlChunks, SayWhatTheyAreFor) {
    const Cell cell = kr60();
    Program program = RandomProgram(5).make(cell, 4, 3, 5);
    const std::vector<std::string> words{"roughing", "finishing", "fine finishing", "drilling"};
    for (std::size_t i = 0; i < words.size(); ++i) program.operations[i].kind = static_cast<OperationKind>(i);
    const ProgramPart part = post_program(program, cell, {3}).front();
    ASSERT_GE(part.chunks.size(), words.size());
    for (const PostedChunk& chunk : part.chunks) {
        const std::string& text = test_krl::text_of(part, chunk.name);
        EXPECT_NE(text.find("\r\n;operation " + words[chunk.operation] + "\r\n"), std::string::npos) << text;
    }
}

TEST(KrlChunks, AreNotSmallerThanTheyMustBe) {
    RandomProgram random(2);
    Cell cell = kr60();
    const Program program = random.make(cell, 1, 300, 60);
    const std::vector<ProgramPart> parts = post_program(program, cell, {3});
    ASSERT_EQ(parts.size(), 1U);
    for (std::size_t i = 0; i + 1 < parts[0].chunks.size(); ++i) {
        const std::string& text = test_krl::text_of(parts[0], parts[0].chunks[i].name);
        EXPECT_GT(lines_of_text(text) + 130 + lines_beside_runs, cell.machine->program.lines_per_chunk);
    }
}

// Every part is a program of its own, with its own question but in the first.
TEST(KrlChunks, PartsAreProgramsOfTheirOwn) {
    RandomProgram random(3);
    Cell cell = kr60();
    cell.machine->program.memory_bytes = 60'000;
    const Program program = random.make(cell, 8, 12, 60);
    const std::vector<ProgramPart> parts = post_program(program, cell, {12});
    ASSERT_GT(parts.size(), 1U);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const std::string stem = "qc_12_p" + std::to_string(k + 1);
        EXPECT_EQ(parts[k].entry, stem + ".src");
        const std::string& main = parts[k].files[0].text;
        EXPECT_NE(main.find("DEF " + stem + "( )\r\n"), std::string::npos);
        EXPECT_EQ(main.find("not moved\")\r\n") != std::string::npos, k > 0);
        EXPECT_EQ(main.find("BAS(#INITMOV,0)") == std::string::npos, false);
        EXPECT_NE(main.find("\r\nqc_12_ask(\"Put tool "), std::string::npos);
        EXPECT_NE(main.find("$ADVANCE = 3\r\nEND\r\n"), std::string::npos);
    }
}

// Operations that a toolpath makes are small enough for parts of whole operations.
TEST(KrlChunks, PartsBeginAndEndAtHome) {
    test_programs::Job job = test_programs::job_in(kr60(), {250, 200, 150}, 35, 200, 2);
    job.cell.machine->program.memory_bytes = 90'000;
    const Program program = test_programs::program_of(job);
    const std::vector<ProgramPart> parts = post_program(program, job.cell, {7});
    ASSERT_GT(parts.size(), 2U);
    for (const ProgramPart& part : parts) {
        std::size_t bytes = 0;
        for (const ProgramText& file : part.files) bytes += file.text.size();
        EXPECT_LE(bytes, 90'000U);
        EXPECT_TRUE(bytes > 40'000 || part.entry == parts.back().entry) << bytes;
        EXPECT_EQ(part.chunks.front().first_run, 0U);
        const PostedChunk& last = part.chunks.back();
        EXPECT_EQ(last.first_run + last.runs, program.operations[last.operation].runs.size());
    }
}

TEST(KrlChunks, RefusesAChunkThatDoesNotFit) {
    RandomProgram random(4);
    Cell cell = kr60();
    cell.machine->program.memory_bytes = 10'000;
    Program program = random.make(cell, 1, 1, 1);
    EXPECT_EQ(post_program(program, cell, {3}).size(), 1U);
    program.operations[0].runs[0].moves.assign(400, {{1, 2, 3}, MoveKind::cut, false, 100});
    for (std::size_t i = 0; i < 400; ++i) program.operations[0].runs[0].moves[i].tip.x = static_cast<double>(i);
    EXPECT_THROW(post_program(program, cell, {3}), InputError);
}

// A line of the finishing that carries most of the bytes.
TEST(KrlChunks, LinesAreShort) {
    const test_programs::Job job = test_programs::job_in(kr60(), {250, 200, 150}, 35, 200, 2);
    const std::vector<ProgramPart> parts = post_program(test_programs::program_of(job), job.cell, {7});
    std::size_t bytes = 0;
    std::size_t lines = 0;
    for (const ProgramPart& part : parts) {
        for (const PostedChunk& chunk : part.chunks) {
            for (const test_krl::ScannedLine& line : test_krl::scan(test_krl::text_of(part, chunk.name))) {
                if (line.word != "LIN" || line.names.size() != 3) continue;
                bytes += line.text.size() + 2;
                ++lines;
            }
        }
    }
    EXPECT_LT(static_cast<double>(bytes) / static_cast<double>(lines), 46);
}

}  // namespace
}  // namespace qchopper
