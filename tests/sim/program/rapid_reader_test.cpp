#include "sim/program/rapid_reader.h"

#include <gtest/gtest.h>

#include <ctime>
#include <numbers>

#include "sim/program/chunk_summary.h"
#include "sim/program/program_line.h"

namespace qchopper {
namespace {

constexpr double radian = std::numbers::pi / 180;

std::string module(const std::string& name, const std::string& body) {
    const std::string text = "%%%\n  VERSION:1\n  LANGUAGE:ENGLISH\n%%%\nMODULE " + name + "\n" + body + "ENDMODULE\n";
    std::string result;
    for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return result;
}

// Lines 6 to 9, then the procedure.
const std::string main_body =
    R"(PERS tooldata qc_1_t1:=[TRUE,[[0,0,550],[1,0,0,0]],[16.2,[0,0,195],[1,0,0,0],0.27,0.27,0.06]];
PERS wobjdata qc_1_w:=[FALSE,TRUE,"",[[1650,0,310],[0.70710678,0,0,0.70710678]],[[0,0,0],[1,0,0,0]]];
VAR intnum qc_1_i;
LOCAL VAR num k;
PROC main()
ConfL\Off;
VelSet 50,5000;
AccSet 40,100;
MoveAbsJ [[0,0,0,0,90,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vmax,fine,qc_1_t1\WObj:=qc_1_w;
TPWrite "ASK tool 1 (ball nose 20 mm) is in the spindle, 200.00 mm from the";
TPWrite "nose to the tip: check its length";
TPReadFK k,"Go on?",stEmpty,stEmpty,stEmpty,stEmpty,"Done";
qc_1_001_run;
IDelete qc_1_i;
SetDO do_on,0;
ENDPROC
TRAP qc_1_fell
StopMove;
SetDO do_on,0;
TPWrite "The spindle has lost its speed";
EXIT;
ENDTRAP
)";

const std::string chunk_body = R"(!operation finishing
LOCAL VAR speeddata v:=[10,100,1000,100];
LOCAL VAR zonedata z:=[FALSE,1,1,1,0.1,1,0.1];
LOCAL CONST robtarget p:=[[0,0,0],[0,1,0,0],[0,-1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
PROC qc_1_001_run()
ConfL\Off;
VelSet 50,5000;
AccSet 50,100;
SetAO ao_rpm,15000.0;
SetDO do_on,1;
WaitDI di_speed,1;
IDelete qc_1_i;
CONNECT qc_1_i WITH qc_1_fell;
ISignalDI\Single,di_speed,0,qc_1_i;
MoveAbsJ [[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]],vmax,fine,qc_1_t1\WObj:=qc_1_w;
VelSet 100,5000;
PathAccLim TRUE\AccMax:=2.0,TRUE\DecelMax:=2.0;
v.v_tcp:=300.0;
!hole 3
MoveL Offs(p,1.00,2.00,30.00),v,fine,qc_1_t1\WObj:=qc_1_w;
z.pzone_tcp:=0.500;
movel offs(P,4.00,6.00,30.00),V,Z,QC_1_T1\wobj:=QC_1_W;
MoveL [[4,6,18],[0,1,0,0],[0,-1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v,fine,qc_1_t1\WObj:=qc_1_w;
ENDPROC
)";

std::vector<ProgramFile> files_of(const std::string& main, const std::string& chunk) {
    return {{"qc_1.mod", module("qc_1", main)}, {"QC_1_001.mod", module("QC_1_001", chunk)}};
}

ParsedProgram read(const std::string& main, const std::string& chunk) {
    return read_rapid(files_of(main, chunk), "qc_1", {"change_tool"});
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

// "file line: why"; empty if it is read.
std::string refusal(const std::vector<ProgramFile>& files) {
    try {
        read_rapid(files, "qc_1", {"change_tool"});
    } catch (const LineRefused& refused) {
        return refused.file + " " + std::to_string(refused.line) + ": " + refused.why;
    }
    return {};
}

TEST(RapidReader, ReadsWhatTheControllerWouldDo) {
    const ParsedProgram program = read(main_body, chunk_body);
    ASSERT_EQ(program.steps.size(), 10U);
    EXPECT_EQ(program.steps[0].kind, StepKind::joint_move);
    EXPECT_NEAR(program.steps[0].values[4], 90 * radian, 1e-12);
    EXPECT_EQ(program.states[program.steps[0].state].axis_speed[3], 0.5);
    EXPECT_EQ(program.states[program.steps[0].state].axis_acceleration[3], 0.4);
    EXPECT_EQ(program.texts[program.steps[1].text],
              "tool 1 (ball nose 20 mm) is in the spindle, 200.00 mm from the nose to the tip: check its length");
    EXPECT_EQ(program.steps[2].kind, StepKind::analog_output);
    EXPECT_EQ(signal_of(program, program.steps[2]), "ao_rpm");
    EXPECT_EQ(program.steps[2].value, 15000);
    EXPECT_EQ(signal_of(program, program.steps[4]), "di_speed");
    const ProgramStep& corner = program.steps[7];
    const ModalState& state = program.states[corner.state];
    EXPECT_EQ(corner.values[0], 4);
    EXPECT_EQ(corner.values[1], 6);
    EXPECT_NEAR(std::abs(corner.values[5]), 180 * radian, 1e-12);
    EXPECT_TRUE(corner.is_rounded);
    EXPECT_EQ(corner.hole, 3U);
    EXPECT_EQ(state.feed, 300);
    EXPECT_EQ(state.acceleration, 2000);
    EXPECT_EQ(state.rounding, 0.5);
    EXPECT_NEAR(state.turn_speed[0], 100 * radian, 1e-12);
    EXPECT_EQ(state.tool->shift, (Vec3{0, 0, 550}));
    EXPECT_EQ(state.base->shift, (Vec3{1650, 0, 310}));
    EXPECT_NEAR(state.base->abc.x, 90 * radian, 1e-9);
    EXPECT_EQ(state.load->mass_kg, 16.2);
    EXPECT_EQ(program.chunks[1].operation, "finishing");
    const ChunkSummary summary = summarise_chunks(program).front();
    EXPECT_EQ(summary.moves, 4U);
    EXPECT_NEAR(summary.length, 17, 1e-12);
}

TEST(RapidReader, LoadsAndUnloadsModules) {
    const std::string loaded =
        replaced(main_body, "qc_1_001_run;",
                 "Load\\Dynamic,\"HOME:/qc_1_001.mod\";\n%\"qc_1_001_run\"%;\nUnLoad \"HOME:/qc_1_001.mod\";");
    EXPECT_EQ(read(loaded, chunk_body).steps.size(), 10U);
    const auto why = [&](const std::string& what, const std::string& by) {
        return refusal(files_of(replaced(loaded, what, by), chunk_body));
    };
    EXPECT_NE(why("UnLoad \"HOME:/qc_1_001.mod\";\n", "").find("still loaded"), std::string::npos);
    EXPECT_NE(why("Load\\Dynamic,\"HOME:/qc_1_001.mod\";\n", "").find("not loaded"), std::string::npos);
    EXPECT_NE(why("%\"qc_1_001_run\"%;\n", "").find("not called"), std::string::npos);
    EXPECT_NE(why("\"HOME:/qc_1_001.mod\"", "\"HOME:/qc_1_002.mod\"").find("missing"), std::string::npos);
}

TEST(RapidReader, TheTableIsTheUnitOfTheWorkObject) {
    const std::string turning =
        replaced(replaced(main_body, "TRUE,\"\",[[1650,0,310],[0.70710678,0,0,0.70710678]],[[0,0,0],[1,0,0,0]]",
                          "FALSE,\"STN2\",[[0,0,0],[1,0,0,0]],[[0,0,12],[1,0,0,0]]"),
                 "90,0],[9E9,9E9", "90,0],[9E9,30.000");
    const std::string chunk = replaced(replaced(replaced(chunk_body, "[0,-1,0,0],[9E9,9E9", "[0,-1,0,0],[9E9,30.000"),
                                                "5,6],[9E9,9E9", "5,6],[9E9,30.000"),
                                       "18],[0,1,0,0],[0,-1,0,0],[9E9,9E9", "18],[0,1,0,0],[0,-1,0,0],[9E9,30.000");
    const ParsedProgram program = read(turning, chunk);
    EXPECT_EQ(program.states[program.steps[7].state].base_machine, 3U);
    EXPECT_NEAR(*program.steps[7].e1, 30 * radian, 1e-12);
    EXPECT_NE(refusal(files_of(turning, chunk_body)), "");
    EXPECT_NE(refusal(files_of(main_body, chunk)), "");
}

struct Refused {
    std::string what;
    std::string by;
    std::string where;  // begins the refusal
};

TEST(RapidReader, RefusesWhatItDoesNotKnow) {
    const std::vector<Refused> in_chunk{{"MoveL Offs", "MoveC Offs", "QC_1_001.mod 25"},
                                        {"Offs(p,", "Offs(q,", "QC_1_001.mod 25"},
                                        {"v,fine,qc_1_t1", "v1000,fine,qc_1_t1", "QC_1_001.mod 25"},
                                        {"v,fine,qc_1_t1", "v,z5,qc_1_t1", "QC_1_001.mod 25"},
                                        {"30.00),v,fine", "3E1),v,fine", "QC_1_001.mod 25"},
                                        {"30.00),v,fine", "9000.0),v,fine", "QC_1_001.mod 25"},
                                        {"!hole 3", "IF TRUE THEN", "QC_1_001.mod 24"},
                                        {"!hole 3", "GOTO again;", "QC_1_001.mod 24"},
                                        {"!hole 3", "WHILE TRUE DO", "QC_1_001.mod 24"},
                                        {"!hole 3", "SetDO do_on,0;", "QC_1_001.mod 24"},
                                        {"ConfL\\Off;\n", "", "QC_1_001.mod 19"},
                                        {"v.v_tcp:=300.0;\n", "", "QC_1_001.mod 24"},
                                        {"PathAccLim TRUE\\AccMax:=2.0,TRUE\\DecelMax:=2.0;\n", "", "QC_1_001.mod 24"},
                                        {"z.pzone_tcp:=0.500;\n", "", "QC_1_001.mod 26"},
                                        {"ISignalDI\\Single,di_speed,0,qc_1_i;\n", "", "QC_1_001.mod 24"},
                                        {"CONNECT qc_1_i WITH qc_1_fell;\n", "", "QC_1_001.mod 18"},
                                        {"IDelete qc_1_i;\n", "", "QC_1_001.mod 17"},
                                        {"[0,1,0,0],[0,-1", "[0,0.9,0,0],[0,-1", "QC_1_001.mod 9"},
                                        {"ENDPROC\n", "", "QC_1_001.mod"},
                                        {"di_speed,0,qc_1_i", "di_door,0,qc_1_i", "QC_1_001.mod 19"}};
    for (const Refused& row : in_chunk) {
        const std::string why = refusal(files_of(main_body, replaced(chunk_body, row.what, row.by)));
        EXPECT_TRUE(why.starts_with(row.where)) << row.what << " -> " << row.by << ": " << why;
    }
    const std::vector<Refused> in_main{
        {"[TRUE,[[0", "[FALSE,[[0", "qc_1.mod 6"},  {"qc_1_001_run;", "qc_1_002_run;", "qc_1.mod 18"},
        {"qc_1_001_run;\n", "", "QC_1_001.mod 1"},  {"qc_1_001_run;", "qc_1_001_run;\nqc_1_001_run;", "qc_1.mod 19"},
        {"IDelete qc_1_i;\n", "", "qc_1.mod 19"},   {"ASK tool 1", "tool 1", "qc_1.mod 17"},
        {"StopMove;\n", "", "qc_1.mod 23"},         {"EXIT;\n", "", "qc_1.mod"},
        {"PROC main()", "PROC other()", "qc_1.mod"}};
    for (const Refused& row : in_main) {
        const std::string why = refusal(files_of(replaced(main_body, row.what, row.by), chunk_body));
        EXPECT_TRUE(why.starts_with(row.where)) << row.what << " -> " << row.by << ": " << why;
    }
}

TEST(RapidReader, RefusesFilesThatAreNotWhole) {
    const std::vector<ProgramFile> files = files_of(main_body, chunk_body);
    EXPECT_EQ(refusal(files), "");
    for (std::size_t length = 0; length < files[1].text.size(); length += 7) {
        std::vector<ProgramFile> cut = files;
        cut[1].text.resize(length);
        EXPECT_TRUE(refusal(cut).starts_with("QC_1_001.mod ")) << length;
    }
    EXPECT_NE(refusal({files[0]}), "");
    EXPECT_NE(refusal({files[1]}), "");
    std::vector<ProgramFile> changed = files;
    changed[1].text = "\xEF\xBB\xBF" + changed[1].text;
    EXPECT_TRUE(refusal(changed).starts_with("QC_1_001.mod 1: ")) << refusal(changed);
    changed = files;
    changed[1].text.erase(changed[1].text.find('\r'), 1);
    EXPECT_TRUE(refusal(changed).starts_with("QC_1_001.mod 1: ")) << refusal(changed);
}

TEST(RapidReader, ReadsAMillionLinesInFiveSeconds) {
    std::string body = chunk_body.substr(0, chunk_body.find("z.pzone_tcp"));
    const std::string line = "MoveL Offs(p,-120.91,-86.95,151.10),v,fine,qc_1_t1\\WObj:=qc_1_w;\n";
    constexpr std::size_t count = 1'000'000;
    body.reserve(body.size() + count * line.size());
    for (std::size_t i = 0; i < count; ++i) body += line;
    body += "ENDPROC\n";
    const std::vector<ProgramFile> files = files_of(main_body, body);
    const std::clock_t start = std::clock();
    const ParsedProgram program = read_rapid(files, "qc_1");
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_GT(program.steps.size(), count);
    std::printf("1,000,000 lines of RAPID: %.2f CPU-s\n", seconds);
#ifdef NDEBUG
    EXPECT_LT(seconds, 5);
#endif
}

}  // namespace
}  // namespace qchopper
