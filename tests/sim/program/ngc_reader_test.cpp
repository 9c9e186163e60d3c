#include "sim/program/ngc_reader.h"

#include <gtest/gtest.h>

#include <ctime>

#include "sim/program/chunk_summary.h"
#include "sim/program/program_line.h"

namespace qchopper {
namespace {

std::string with_line_ends(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return result;
}

const std::string main_text = R"((part 1 of 1)
G21
G90 G17 G94 G40
G54
G61
G49
(MSG, ASK tool 1 [ball nose 20 mm] is in the spindle)
M0
T1 M6
G43 H1
G0 Z850.00
G0 X100.00 Y100.00
o<qc_1_001> call
M5
M65 P0
G0 Z850.00
G0 X100.00 Y100.00
M2
)";

const std::string chunk_text = R"(o<qc_1_001> sub
(operation finishing)
G21
G90 G17 G94 G40
G54
G61
G43 H1
M64 P0
S15000.0 M3
G4 P5.0
G0 Z850.00
G0 X1.00 Y2.00
(hole 3)
G1 X1.00 Y2.00 Z30.00 F18000.0
G64 P0.100
g1 x4.00 y6.00 z30.00
G61
G1 X4.00 Y6.00 Z18.00 F7200.0
G0 Z850.00
o<qc_1_001> endsub
)";

std::vector<ProgramFile> files_of(const std::string& main, const std::string& chunk) {
    return {{"qc_1.ngc", with_line_ends(main)}, {"QC_1_001.ngc", with_line_ends(chunk)}};
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

// "file line: why"; empty if it is read.
std::string refusal(const std::vector<ProgramFile>& files) {
    try {
        read_ngc(files, "qc_1", {"change_tool"});
    } catch (const LineRefused& refused) {
        return refused.file + " " + std::to_string(refused.line) + ": " + refused.why;
    }
    return {};
}

TEST(NgcReader, ReadsWhatTheControllerWouldDo) {
    const ParsedProgram program = read_ngc(files_of(main_text, chunk_text), "qc_1");
    ASSERT_EQ(program.steps.size(), 17U);
    EXPECT_EQ(program.texts[program.steps[0].text], "tool 1 (ball nose 20 mm) is in the spindle");
    EXPECT_EQ(program.steps[1].kind, StepKind::tool_change);
    EXPECT_EQ(program.steps[1].number, 1U);
    EXPECT_EQ(program.steps[2].kind, StepKind::rapid_move);
    EXPECT_EQ(program.steps[2].given, 0b100);
    EXPECT_EQ(program.steps[3].given, 0b111);
    EXPECT_EQ(signal_of(program, program.steps[4]), "0");
    EXPECT_EQ(program.steps[5].kind, StepKind::spindle);
    EXPECT_EQ(program.steps[5].value, 15000);
    EXPECT_EQ(program.steps[6].kind, StepKind::dwell);
    const ProgramStep& corner = program.steps[10];
    const ModalState& state = program.states[corner.state];
    EXPECT_EQ(corner.values[1], 6);
    EXPECT_TRUE(corner.is_rounded);
    EXPECT_EQ(corner.hole, 3U);
    EXPECT_EQ(state.feed, 300);
    EXPECT_EQ(state.rounding, 0.1);
    EXPECT_EQ(state.tool_number, 1U);
    EXPECT_EQ(state.length_register, 1U);
    EXPECT_FALSE(program.steps[11].is_rounded);
    EXPECT_EQ(program.states[program.steps[11].state].feed, 120);
    EXPECT_EQ(program.chunks[1].operation, "finishing");
    const ChunkSummary summary = summarise_chunks(program).front();
    EXPECT_EQ(summary.moves, 6U);
    EXPECT_NEAR(summary.length, 17, 1e-12);
}

struct Refused {
    std::string what;
    std::string by;
    std::string where;  // begins the refusal
};

TEST(NgcReader, RefusesWhatItDoesNotKnow) {
    const std::vector<Refused> in_chunk{{"G21", "G20", "QC_1_001.ngc 3"},
                                        {"G21\nG90", "G21 G90", "QC_1_001.ngc 3"},
                                        {"G21\n", "", "QC_1_001.ngc 10"},
                                        {"G90 ", "G91 ", "QC_1_001.ngc 4"},
                                        {"G17 ", "", "QC_1_001.ngc 11"},
                                        {"G54", "G55", "QC_1_001.ngc 5"},
                                        {"G43 H1\n", "", "QC_1_001.ngc 10"},
                                        {"G0 Z850.00\n", "G0 X0 Z850.00\n", "QC_1_001.ngc 11"},
                                        {" F18000.0", "", "QC_1_001.ngc 14"},
                                        {"F18000.0", "F1.8E4", "QC_1_001.ngc 14"},
                                        {"G64 P0.100", "G64", "QC_1_001.ngc 15"},
                                        {"G61\nG1", "G1", "QC_1_001.ngc 17"},
                                        {"g1 x4.00", "g2 x4.00", "QC_1_001.ngc 16"},
                                        {"g1 x4.00", "x4.00", "QC_1_001.ngc 16"},
                                        {"(hole 3)", "o100 if [#1 GT 0]", "QC_1_001.ngc 13"},
                                        {"(hole 3)", "o100 while [1]", "QC_1_001.ngc 13"},
                                        {"(hole 3)", "G28", "QC_1_001.ngc 13"},
                                        {"(hole 3)", "M30", "QC_1_001.ngc 13"},
                                        {"(hole 3)", "#1=5", "QC_1_001.ngc 13"},
                                        {"o<qc_1_001> endsub\n", "", "QC_1_001.ngc"},
                                        {"o<qc_1_001> sub", "o<qc_1_002> sub", "QC_1_001.ngc 1"},
                                        {"S15000.0 M3", "M3", "QC_1_001.ngc 9"}};
    for (const Refused& row : in_chunk) {
        const std::string why = refusal(files_of(main_text, replaced(chunk_text, row.what, row.by)));
        EXPECT_TRUE(why.starts_with(row.where)) << row.what << " -> " << row.by << ": " << why;
    }
    const std::vector<Refused> in_main{{"G43 H1\n", "", "qc_1.ngc 10"},
                                       {"(MSG, ASK tool", "(tool", "qc_1.ngc 8"},
                                       {"o<qc_1_001> call\n", "", "QC_1_001.ngc 1"},
                                       {"o<qc_1_001> call", "o<qc_1_002> call", "qc_1.ngc 13"},
                                       {"o<qc_1_001> call\n", "o<qc_1_001> call\no<qc_1_001> call\n", "qc_1.ngc 14"},
                                       {"M2\n", "", "qc_1.ngc 17"},
                                       {"M2\n", "M2\nG0 Z1.0\n", "qc_1.ngc 19"}};
    for (const Refused& row : in_main) {
        const std::string why = refusal(files_of(replaced(main_text, row.what, row.by), chunk_text));
        EXPECT_TRUE(why.starts_with(row.where)) << row.what << " -> " << row.by << ": " << why;
    }
}

TEST(NgcReader, RefusesFilesThatAreNotWhole) {
    const std::vector<ProgramFile> files = files_of(main_text, chunk_text);
    EXPECT_EQ(refusal(files), "");
    for (std::size_t length = 0; length + 2 < files[1].text.size(); length += 7) {
        std::vector<ProgramFile> cut = files;
        cut[1].text.resize(length);
        EXPECT_TRUE(refusal(cut).starts_with("QC_1_001.ngc ")) << length;
    }
    EXPECT_NE(refusal({files[0]}), "");
    EXPECT_NE(refusal({files[1]}), "");
    std::vector<ProgramFile> changed = files;
    changed[1].text = "\xEF\xBB\xBF" + changed[1].text;
    EXPECT_TRUE(refusal(changed).starts_with("QC_1_001.ngc 1: ")) << refusal(changed);
}

TEST(NgcReader, ReadsAMillionLinesInFiveSeconds) {
    std::string text = chunk_text.substr(0, chunk_text.find("G64"));
    const std::string line = "G1 X-120.91 Y-86.95 Z151.10\n";
    constexpr std::size_t count = 1'000'000;
    for (std::size_t i = 0; i < count; ++i) text += line;
    text += "o<qc_1_001> endsub\n";
    const std::vector<ProgramFile> files = files_of(main_text, text);
    const std::clock_t start = std::clock();
    const ParsedProgram program = read_ngc(files, "qc_1");
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_GT(program.steps.size(), count);
    std::printf("1,000,000 lines of NGC: %.2f CPU-s\n", seconds);
#ifdef NDEBUG
    EXPECT_LT(seconds, 5);
#endif
}

}  // namespace
}  // namespace qchopper
