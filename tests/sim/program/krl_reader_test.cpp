#include "sim/program/krl_reader.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/error.h"
#include "sim/program/chunk_summary.h"
#include "sim/program/rounded_corner.h"

namespace qchopper {
namespace {

constexpr double radian = std::numbers::pi / 180;

std::string with_line_ends(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return result;
}

std::string source(const std::string& name, const std::string& body) {
    return with_line_ends("&ACCESS RVP\n&REL 1\n&PARAM EDITMASK = *\nDEF " + name + "( )\n" + body + "END\n");
}

const std::string restored = "$APO.CDIS = 0\n";
const std::string init = R"(BAS(#INITMOV,0)
$VEL_AXIS[1] = 30
$VEL_AXIS[2] = 30
$VEL_AXIS[3] = 30
$VEL_AXIS[4] = 30
$VEL_AXIS[5] = 30
$VEL_AXIS[6] = 30
$ACC_AXIS[1] = 20
$ACC_AXIS[2] = 20
$ACC_AXIS[3] = 20
$ACC_AXIS[4] = 20
$ACC_AXIS[5] = 20
$ACC_AXIS[6] = 20
)";

// What a chunk states besides frames and speeds: lines 5 to 20.
const std::string settings = init.substr(init.find("$VEL_AXIS")) +
                             "$LOAD = {M 16.2,CM {X 0.0,Y 0.0,Z 195.4,A 0.0,B 0.0,C 0.0},J {X 0.3,Y 0.3,Z 0.1}}\n"
                             "$VEL.ORI1 = 100.0\n$VEL.ORI2 = 100.0\n$APO.CDIS = 2.0\n";

// Line 21 is the first of these.
const std::string chunk = settings + R"($TOOL = {X 0.000,Y 0.000,Z 550.000,A 0.0000,B 0.0000,C 0.0000}
$BASE = {X 1200.000,Y 0.000,Z 310.000,A 0.0000,B 0.0000,C 0.0000}
$VEL.CP = 0.1000
$ACC.CP = 2.0000
PTP {A1 0.000,A2 -90.000,A3 90.000,A4 0.000,A5 90.000,A6 0.000}
LIN {X 1.00,Y 2.00,Z 30.00,A 180.000,B 0.000,C 180.000}
lin {x 4.00,y 6.00,z 30.00} c_dis
LIN {X 4.00,Y 6.00,Z 18.00}
)";

std::vector<ProgramFile> files_of(const std::string& main_body, const std::string& chunk_body) {
    return {{"qc_1.src", source("qc_1", main_body)},
            {"QC_1.dat", with_line_ends("DEFDAT QC_1\nENDDAT\n")},
            {"qc_1_001.src", source("QC_1_001", chunk_body)}};
}

ParsedProgram read(const std::string& chunk_body) {
    return read_krl(files_of(init + "QC_1_001( )\n" + restored, chunk_body), "qc_1", {"change_tool"});
}

TEST(KrlReader, ReadsMovesWithTheirModalValues) {
    const ParsedProgram program = read(chunk);
    ASSERT_EQ(program.steps.size(), 4U);
    const ProgramStep& ptp = program.steps[0];
    EXPECT_EQ(ptp.kind, StepKind::joint_move);
    EXPECT_NEAR(ptp.values[1], -90 * radian, 1e-12);
    const ProgramStep& last = program.steps[3];
    EXPECT_EQ(last.kind, StepKind::linear_move);
    EXPECT_EQ(program.files[last.place.file], "qc_1_001.src");
    EXPECT_EQ(last.place.line, 28U);
    EXPECT_EQ(last.values[2], 18);
    EXPECT_NEAR(last.values[3], 180 * radian, 1e-12);
    EXPECT_TRUE(program.steps[2].is_rounded);
    EXPECT_FALSE(last.is_rounded);
    EXPECT_NEAR(program.states[last.state].feed, 100, 1e-9);
    EXPECT_NEAR(program.states[last.state].axis_acceleration[5], 0.2, 1e-12);
    EXPECT_EQ(program.states[last.state].base->shift.x, 1200);
}

TEST(KrlReader, KnowsTheHoleThatACommentNames) {
    std::string body = chunk;
    body.insert(body.find("lin {x 4"), ";HOLE 12\n;hole -3\n;hole 4 mm\n;hole 99999\n;another word\n");
    body += ";hole 2\nLIN {X 4.00,Y 6.00,Z 12.00}\n";
    const ParsedProgram program = read(body);
    ASSERT_EQ(program.steps.size(), 5U);
    std::vector<std::uint32_t> holes;
    for (const ProgramStep& step : program.steps) holes.push_back(step.hole);
    EXPECT_EQ(holes, (std::vector<std::uint32_t>{0, 0, 12, 12, 2}));
}

TEST(KrlReader, KnowsWhatAChunkSaysOfItsStart) {
    const auto line_of_comment = [](const std::string& body) {
        const ParsedProgram program = read(body);
        EXPECT_EQ(program.chunks.size(), 3U);
        EXPECT_EQ(program.chunks[1].end_line, 29U + (body.size() > chunk.size() ? 1 : 0));
        EXPECT_EQ(program.chunks[2].end_line, program.chunks[0].end_line);
        return program.chunks[1].free_from_home;
    };
    EXPECT_EQ(line_of_comment(chunk), 0U);
    EXPECT_EQ(line_of_comment(";start from home: free\n" + chunk), 5U);
    EXPECT_EQ(line_of_comment(";start from home: not free, see the chunks before\n" + chunk), 0U);
}

TEST(KrlReader, KnowsWhatAChunkIsFor) {
    const auto operation_of = [](const std::string& comment) { return read(comment + chunk).chunks[1].operation; };
    EXPECT_EQ(operation_of(""), "unknown");
    for (const std::string words : {"roughing", "finishing", "fine finishing", "drilling"}) {
        EXPECT_EQ(operation_of(";operation " + words + "\n"), words);
    }
    EXPECT_EQ(operation_of(";OPERATION Roughing\n"), "roughing");
    for (const std::string other : {";operation engraving\n", ";operation\n", ";operation roughing twice\n"}) {
        EXPECT_EQ(operation_of(other), "unknown") << other;
    }
    EXPECT_EQ(read(chunk).chunks[0].operation, "unknown") << "the main program is none";
}

TEST(KrlReader, SummarisesChunks) {
    const std::vector<ChunkSummary> summaries = summarise_chunks(read(chunk));
    ASSERT_EQ(summaries.size(), 1U);
    EXPECT_EQ(summaries[0].moves, 4U);
    EXPECT_NEAR(summaries[0].length, 5 + 12, 1e-12);
    EXPECT_EQ(summaries[0].box, (Box{{1, 2, 18}, {4, 6, 30}}));
    EXPECT_EQ(summaries[0].first, (Vec3{1, 2, 30}));
    EXPECT_EQ(summaries[0].last, (Vec3{4, 6, 18}));
}

TEST(KrlReader, ReadsSignalsStopsAndCalls) {
    const ParsedProgram program =
        read("$OUT[2] = TRUE\n$ANOUT[1] = 0.5\nWAIT FOR $IN[7]\n;ASK ready?\nHALT\nChange_Tool(3)\n" + chunk);
    EXPECT_EQ(program.steps[0].number, 2U);
    EXPECT_EQ(program.steps[1].value, 0.5);
    EXPECT_EQ(program.steps[2].number, 7U);
    EXPECT_EQ(program.texts[program.steps[3].text], "ready?");
    EXPECT_EQ(program.texts[program.steps[4].text], "change_tool");
    EXPECT_EQ(program.steps[4].value, 3);
}

TEST(KrlReader, ReadsAChainedBaseWithItsExternalAxis) {
    std::string body = chunk;
    const std::size_t base = body.find("{X 1200");
    body.replace(base, body.find("}\n", base) + 1 - base,
                 "EK(MACHINE_DEF[3].ROOT,MACHINE_DEF[3].MECH_TYPE,{X 1.0,Y 2.0,Z 3.0,A 0.0,B 0.0,C 0.0})");
    body.replace(body.find("A6 0.000}"), 9, "A6 0.000,E2 30.000}");
    body.replace(body.find("C 180.000}"), 10, "C 180.000,E2 30.000}");
    const ParsedProgram program = read(body);
    EXPECT_EQ(program.states[program.steps[1].state].base_machine, 3U);
    EXPECT_NEAR(*program.steps[3].e1, 30 * radian, 1e-12);
    body.replace(body.find("E2 30.000}\nLIN"), 2, "E1");
    EXPECT_THROW(read(body), InputError);
}

// A fault in the text, and what the message names.
struct Fault {
    const char* from;
    const char* to;
    const char* place;
};

// A test is named by the position of its fault in the list: its texts are no names, and their addresses differ in each
// run.
void PrintTo(const Fault& fault, std::ostream* out) {
    *out << fault.place;
}
std::string name_of(const testing::TestParamInfo<Fault>& info) {
    return "Fault" + std::to_string(info.index + 1);
}

class KrlFaults : public testing::TestWithParam<Fault> {};

TEST_P(KrlFaults, AreRefusedWithFileAndLine) {
    std::string body = chunk;
    const std::size_t at = body.find(GetParam().from);
    ASSERT_NE(at, std::string::npos);
    body.replace(at, std::string(GetParam().from).size(), GetParam().to);
    try {
        read(body);
        FAIL() << GetParam().to;
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::mesh);
        EXPECT_NE(std::string(error.what()).find(GetParam().place), std::string::npos) << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(
    Krl, KrlFaults,
    testing::Values(
        Fault{"X 1.00", "X 1.00E2", "qc_1_001.src, line 26"}, Fault{"X 1.00", "X nan", "line 26"},
        Fault{"X 1.00", "X 1,00", "line 26"}, Fault{"X 1.00", "X 6000.00", "line 26"}, Fault{"X 1.00", "X ", "line 26"},
        Fault{"X 1.00", "X 1.0.0", "line 26"}, Fault{",A 180.000,B 0.000,C 180.000", "", "line 26"},
        Fault{",C 180.000", "", "line 26"}, Fault{",C 180.000", ",C 180.000,E1 3.0", "line 26"},
        Fault{",z 30.00}", ",x 30.00}", "line 27"}, Fault{"lin", "line", "line 27"}, Fault{"c_dis", "c_ptp", "line 27"},
        Fault{"LIN {X 4.00", "IF TRUE THEN\nLIN {X 4.00", "line 28"},
        Fault{"LIN {X 4.00", "GOTO 3\nLIN {X 4.00", "line 28"}, Fault{"LIN {X 4.00", "HALT\nLIN {X 4.00", "line 28"},
        Fault{"LIN {X 4.00", "unknown( )\nLIN {X 4.00", "line 28"},
        Fault{"LIN {X 4.00", "SPLINE\nSPL {X 4.00", "line 28"}, Fault{"LIN {X 4.00", "SPL {X 4.00", "line 28"},
        Fault{"LIN {X 4.00", "SLIN {X 4.00", "line 28"}, Fault{"LIN {X 4.00", "$VEL.CP = 60.0\nLIN {X 4.00", "line 28"},
        Fault{"LIN {X 4.00", "$VEL.CP = 0.0\nLIN {X 4.00", "line 28"},
        Fault{"LIN {X 4.00", "$VEL.PTP = 0.1\nLIN {X 4.00", "line 28"},
        Fault{"LIN {X 4.00", "$ADVANCE = 6\nLIN {X 4.00", "line 28"},
        Fault{"LIN {X 4.00", "BAS(#INITMOV,0)\nLIN {X 4.00", "line 28"},
        Fault{"LIN {X 4.00", "$OUT[1] = ON\nLIN {X 4.00", "line 28"},
        Fault{"LIN {X 4.00", "$TOOL = {X 0.0,Y 0.0,Z 1.0,A 0.0,B 0.0,C 0.0}\nLIN {X 4.00", "line 29"},
        Fault{"LIN {X 4.00", "\xC3\xA4\nLIN {X 4.00", "line 28"}, Fault{"$TOOL", "$TOLL", "line 21"},
        Fault{"$VEL.CP", ";", "line 26"}, Fault{"$TOOL", ";", "line 26"}, Fault{"$BASE", ";", "line 26"},
        Fault{"$ACC.CP", ";", "line 26"}, Fault{"PTP", ";", "line 26"}, Fault{",A6 0.000", "", "line 25"},
        Fault{"$LOAD", ";", "line 25"}, Fault{"$VEL_AXIS[3]", ";", "line 25"}, Fault{"$ACC_AXIS[6]", ";", "line 25"},
        Fault{"$VEL.ORI1", ";", "line 26"}, Fault{"$VEL.ORI2", ";", "line 26"}, Fault{"$APO.CDIS", ";", "line 27"},
        Fault{"LIN {X 4.00,Y 6.00,Z 18.00}", "", "line 27"},
        Fault{"LIN {X 4.00", "PTP {A1 0,A2 -90,A3 90,A4 0,A5 90,A6 0}\nLIN {X 4.00", "line 27"},
        Fault{"A6 0.000", "A6 900.000", "line 25"}, Fault{"PTP", "PTPX", "line 25"}),
    name_of);

std::string refusal(std::vector<ProgramFile> files) {
    try {
        read_krl(files, "qc_1");
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

TEST(KrlReader, RefusesFilesThatDoNotBelongTogether) {
    const auto good = files_of(init + "QC_1_001( )\n" + restored, chunk);
    EXPECT_EQ(refusal(good), "");
    EXPECT_NE(refusal(files_of(init, chunk)).find("never called"), std::string::npos);
    EXPECT_NE(refusal(files_of(init + "QC_1_001( )\nQC_1_001( )\n" + restored, chunk)).find("called twice"),
              std::string::npos);
    EXPECT_NE(refusal(files_of("QC_1_001( )\n", chunk)), "");
    EXPECT_NE(refusal(files_of(init + "$ADVANCE = 5\nQC_1_001( )\n", chunk)).find("$ADVANCE"), std::string::npos);
    EXPECT_NE(refusal({good[0], good[1]}).find("qc_1.src, line 18"), std::string::npos);
    auto truncated = good;
    truncated[2].text.resize(truncated[2].text.size() - 5);
    EXPECT_NE(refusal(truncated).find("qc_1_001.src"), std::string::npos);
    auto wrong_name = good;
    wrong_name[2].name = "qc_1_002.src";
    EXPECT_NE(refusal(wrong_name).find("not that of the file"), std::string::npos);
    auto bare_line_end = good;
    bare_line_end[2].text.insert(20, "\n");
    EXPECT_NE(refusal(bare_line_end).find("CR LF"), std::string::npos);
    auto twice = good;
    twice.push_back(good[2]);
    EXPECT_NE(refusal(twice).find("twice"), std::string::npos);
}

TEST(RoundedCorner, IsTheParabolaOfTheFormula) {
    const RoundedCorner corner = round_corner({-10, 0, 0}, {0, 0, 0}, {0, 3, 0}, 4);
    EXPECT_NEAR(corner.a, 1.5, 1e-12);
    EXPECT_NEAR(corner.deviation, 0.5 * 1.5 * std::cos(std::numbers::pi / 4), 1e-12);
    EXPECT_NEAR(norm(corner.at(0.5)), corner.deviation, 1e-12);
    // Curvature in the middle by three points close together.
    const Vec3 p = corner.at(0.4999);
    const Vec3 q = corner.at(0.5);
    const Vec3 r = corner.at(0.5001);
    const double area = norm(cross(q - p, r - p)) / 2;
    EXPECT_NEAR(corner.radius, norm(q - p) * norm(r - q) * norm(r - p) / (4 * area), 1e-3);
    EXPECT_EQ(round_corner({0, 0, 0}, {0, 0, 0}, {1, 0, 0}, 2).a, 0);
    EXPECT_NEAR(round_corner({-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, 2).deviation, 0, 1e-12);
}

}  // namespace
}  // namespace qchopper
