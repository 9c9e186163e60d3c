// Programs with a configuration module: base and tools in one place, questions, stops.

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "sim/program/krl_reader.h"

namespace qchopper {
namespace {

std::string with_line_ends(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return result;
}

std::string source(const std::string& name, const std::string& body) {
    return "&ACCESS RVP\n&REL 1\nDEF " + name + "( )\n" + body + "END\n";
}

std::string axis_speeds() {
    std::string text;
    for (const char* name : {"$VEL_AXIS", "$ACC_AXIS"}) {
        for (int axis = 1; axis <= 6; ++axis) text += name + ("[" + std::to_string(axis) + "] = 30\n");
    }
    return text;
}

const std::string stops = "INTERRUPT DECL 21 WHEN $STOPMESS == TRUE DO m_stop( )\nINTERRUPT ON 21\n";

const std::string chunk_lines = R"($LOAD = m_l1
$TOOL = m_t1
$BASE = m_base
$VEL.ORI1 = 100.0
$VEL.ORI2 = 100.0
$VEL.CP = 0.1
$ACC.CP = 2.0
$OUT[2] = TRUE
$OUT[1] = TRUE
WAIT FOR $IN[1]
INTERRUPT DECL 22 WHEN $IN[1] == FALSE DO m_fall( )
INTERRUPT ON 22
PTP {A1 0.000,A2 -90.000,A3 90.000,A4 0.000,A5 90.000,A6 0.000}
LIN {X 1.00,Y 2.00,Z 30.00,A 180.000,B 0.000,C 180.000}
LIN {X 4.00,Y 6.00,Z 18.00}
WAIT SEC 0
INTERRUPT OFF 22
)";

const std::string main_lines = R"(m_ask("Put tool 1 (ball) into the spindle.")
m_ask("Measure tool 1: 200.00 mm from nose to tip.")
m_say("The table turns.")
m_ask("Is the block fixed?")
m_001( )
$OUT[1] = FALSE
$OUT[2] = FALSE
)";

const std::string routines = R"(END
GLOBAL DEF m_stop( )
$OUT[1] = FALSE
$OUT[2] = FALSE
LOOP
HALT
ENDLOOP
END
GLOBAL DEF m_fall( )
BRAKE
$OUT[1] = FALSE
$OUT[2] = FALSE
LIN_REL {Z -50.00} #TOOL
LOOP
HALT
ENDLOOP
END
GLOBAL DEF m_ask(ASKED[ ]:OUT)
DECL CHAR ASKED[ ]
DECL KRLMSG_T MSG
DECL KRLMSGPAR_T PAR[3]
DECL KRLMSGDLGSK_T KEY[7]
DECL KRLMSGOPT_T OPT
DECL INT DIALOG,ANSWER,I
MSG = {MODUL[] "QChopper",NR 1,MSG_TXT[] " "}
MSG.MSG_TXT[ ] = ASKED[ ]
FOR I = 1 TO 3
PAR[I] = {PAR_TYPE #EMPTY}
ENDFOR
FOR I = 2 TO 7
KEY[I] = {SK_TYPE #EMPTY}
ENDFOR
KEY[1] = {SK_TYPE #VALUE,SK_TXT[] "Done"}
OPT = {VL_STOP TRUE,CLEAR_P_RESET TRUE,CLEAR_P_SAW FALSE,LOG_TO_DB TRUE}
DIALOG = SET_KRLDLG(MSG,PAR[ ],KEY[ ],OPT)
IF DIALOG <= 0 THEN
HALT
ENDIF
WHILE (DIALOG > 0) AND EXISTS_KRLDLG(DIALOG,ANSWER)
WAIT SEC 0.1
ENDWHILE
END
GLOBAL DEF m_say(SAID[ ]:OUT)
DECL CHAR SAID[ ]
DECL KRLMSG_T MSG
DECL KRLMSGPAR_T PAR[3]
DECL KRLMSGOPT_T OPT
DECL INT MESSAGE,I
MSG = {MODUL[] "QChopper",NR 2,MSG_TXT[] " "}
MSG.MSG_TXT[ ] = SAID[ ]
FOR I = 1 TO 3
PAR[I] = {PAR_TYPE #EMPTY}
ENDFOR
OPT = {VL_STOP FALSE,CLEAR_P_RESET TRUE,CLEAR_P_SAW FALSE,LOG_TO_DB FALSE}
MESSAGE = SET_KRLMSG(#NOTIFY,MSG,PAR[ ],OPT)
)";

const std::string data = R"(DECL GLOBAL FRAME m_base = {X 1200.000,Y 0.000,Z 310.000,A 0.0000,B 0.0000,C 0.0000}
DECL GLOBAL FRAME m_t1 = {X 0.000,Y 0.000,Z 550.000,A 0.0000,B 0.0000,C 0.0000}
DECL GLOBAL LOAD m_l1 = {M 16.2,CM {X 0.0,Y 0.0,Z 195.4,A 0.0,B 0.0,C 0.0},J {X 0.3,Y 0.3,Z 0.1}}
)";

std::vector<ProgramFile> good_files() {
    return {{"m.src", with_line_ends(source("m", stops + "BAS(#INITMOV,0)\n" + axis_speeds() + main_lines))},
            {"m_001.src", with_line_ends(source("m_001", stops + axis_speeds() + chunk_lines))},
            {"m_cfg.src", with_line_ends(source("m_cfg", routines))},
            {"m_cfg.dat", with_line_ends("DEFDAT m_cfg PUBLIC\n" + data + "ENDDAT\n")}};
}

std::string refusal(const std::vector<ProgramFile>& files) {
    try {
        read_krl(files, "m");
        return "";
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::mesh);
        return error.what();
    }
}

TEST(KrlConfig, FramesAreThoseOfTheModule) {
    const ParsedProgram program = read_krl(good_files(), "m");
    const auto line = std::ranges::find(program.steps, StepKind::linear_move, &ProgramStep::kind);
    ASSERT_NE(line, program.steps.end());
    const ModalState& state = program.states[line->state];
    EXPECT_EQ(state.base->shift, (Vec3{1200, 0, 310}));
    EXPECT_EQ(state.tool->shift, (Vec3{0, 0, 550}));
    EXPECT_EQ(state.load->mass_kg, 16.2);
    EXPECT_EQ(program.retract, (Vec3{0, 0, -50}));
    EXPECT_EQ(program.files[program.retract_place.file], "m_cfg.src");
}

// Dialogs one behind the other are one question; a message between them is no part of it.
TEST(KrlConfig, DialogsAreQuestions) {
    const ParsedProgram program = read_krl(good_files(), "m");
    std::vector<std::string> asked;
    for (const ProgramStep& step : program.steps) {
        if (step.kind == StepKind::halt) asked.push_back(program.texts[step.text]);
    }
    EXPECT_EQ(asked, (std::vector<std::string>{
                         "Put tool 1 (ball) into the spindle. Measure tool 1: 200.00 mm from nose to tip.",
                         "Is the block fixed?"}));
}

// A text in a file that stands in the place of another one, and what the refusal says.
struct ModuleFault {
    std::size_t file;
    std::string from;
    std::string to;
    std::string says;
};

TEST(KrlConfig, EveryFaultIsRefusedWithItsPlace) {
    const std::vector<ModuleFault> faults{
        {0, "m_ask(\"Is the block fixed?\")",
         "WAIT SEC 0\r\nINTERRUPT OFF 21\r\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 90,A6 0}", "m.src, line"},
        {1, "INTERRUPT ON 21", "", "the interrupt for $STOPMESS is not on"},
        {1, "INTERRUPT ON 22", "", "no interrupt for $IN[1] is on"},
        {1, "$IN[1] == FALSE", "$IN[1] == TRUE", "m_001.src, line"},
        {1, "$IN[1] == FALSE", "$IN[2] == FALSE", "no interrupt for $IN[1] is on"},
        {1, "DO m_fall", "DO m_stop", "no such routine"},
        {1, "DO m_fall", "DO m_gone", "no such routine"},
        {1, "INTERRUPT DECL 22", "INTERRUPT DECL 21", "declared twice"},
        {1, "INTERRUPT ON 22", "INTERRUPT ON 23", "not declared"},
        {1, "WAIT SEC 0\r\n", "", "WAIT SEC 0 is missing"},
        {1, "WAIT SEC 0\r\n", "WAIT SEC 1\r\n", "m_001.src, line"},
        {1, "Z 18.00}", "Z 18.00} C_DIS", "$APO.CDIS was not stated"},
        {1, "$TOOL = m_t1", "$TOOL = m_t2", "\"m_t2\" is not in the configuration module"},
        {1, "$TOOL = m_t1", "$TOOL = m_l1", "is not in the configuration module"},
        {1, "$LOAD = m_l1", "m_ask(\"now?\")", "only the main program asks"},
        {0, "m_ask(\"Is the block fixed?\")", "m_ask(\"\")", "1 to 80 characters"},
        {0, "m_ask(\"Is the block fixed?\")", "m_stop( )", "this routine is for an interrupt"},
        {0, "m_ask(\"Is the block fixed?\")", "m_ask(\"Is the block fixed?", "m.src, line"},
        {0, "m_ask(\"Is the block fixed?\")", "m_ask(1)", "m.src, line"},
        {0, "m_ask(\"Is", "m_tell(\"Is", "m.src, line"},
        {2, "$OUT[1] = FALSE\r\n$OUT[2] = FALSE\r\nLOOP", "$OUT[2] = FALSE\r\nLOOP",
         "\"m_stop\" does not switch off 1"},
        {2, "BRAKE\r\n$OUT[1] = FALSE\r\n", "BRAKE\r\n", "\"m_fall\" does not switch off 1"},
        {2, "BRAKE\r\n$OUT[1] = FALSE", "BRAKE\r\n$OUT[1] = TRUE", "a routine switches off"},
        {2, "BRAKE\r\n", "", "m_cfg.src, line"},
        {2, "LIN_REL {Z -50.00} #TOOL\r\n", "", "m_cfg.src, line"},
        {2, "{Z -50.00}", "{Z 50.00}", "m_cfg.src, line"},
        {2, "{Z -50.00}", "{Y -50.00}", "along X or Z"},
        {2, "#TOOL", "#BASE", "m_cfg.src, line"},
        {2, "ENDLOOP\r\n", "", "LOOP, HALT, ENDLOOP"},
        {2, "ENDLOOP\r\n", "ENDLOOP\r\nRESUME\r\n", "no line of a routine"},
        {2, "IF DIALOG <= 0 THEN", "IF DIALOG < 0 THEN", "no line of a message"},
        {2, "WHILE (DIALOG > 0) AND EXISTS_KRLDLG(DIALOG,ANSWER)\r\n", "", "no line of a message"},
        {2, "GLOBAL DEF m_say", "GLOBAL DEF m_ask", "the routine is there twice"},
        {2, "GLOBAL DEF m_say", "GLOBAL DEF m_001", "is a program too"},
        {2, "DEF m_cfg( )\r\n", "DEF m_cfg( )\r\n$OUT[1] = TRUE\r\n", "does nothing when it is started alone"},
        {3, "FRAME m_base", "FRAME m_t1", "the name is there twice"},
        {3, "FRAME m_base = {X 1200.000", "FRAME m_base = {X 9200.000", "m_cfg.dat, line 2"},
        {3, ",C 0.0000}", "}", "m_cfg.dat, line 2"},
        {3, "GLOBAL FRAME m_t1", "FRAME m_t1", "m_cfg.dat, line 3"},
        {3, "DECL GLOBAL LOAD", "DECL GLOBAL REAL", "m_cfg.dat, line 4"},
        {3, " PUBLIC", "", "m_cfg.dat, line 2"},
    };
    EXPECT_EQ(refusal(good_files()), "");
    for (const ModuleFault& fault : faults) {
        std::vector<ProgramFile> files = good_files();
        std::string& text = files[fault.file].text;
        const std::size_t at = text.find(fault.from);
        ASSERT_NE(at, std::string::npos) << fault.from;
        text.replace(at, fault.from.size(), fault.to);
        EXPECT_NE(refusal(files).find(fault.says), std::string::npos)
            << fault.from << " -> " << fault.to << ": " << refusal(files);
    }
}

TEST(KrlConfig, AModuleOfWhichAFileIsMissingIsRefused) {
    std::vector<ProgramFile> files = good_files();
    files.pop_back();
    EXPECT_NE(refusal(files), "");
    files = good_files();
    files.erase(files.begin() + 2);
    EXPECT_NE(refusal(files).find("its .src is missing"), std::string::npos);
    files = good_files();
    files.erase(files.begin() + 2, files.end());
    EXPECT_NE(refusal(files).find("the configuration module is missing"), std::string::npos) << refusal(files);
    files = good_files();
    files.push_back({"n_cfg.dat", files[3].text});
    EXPECT_NE(refusal(files), "");
}

// Where a table is, its axis has a speed of its own.
TEST(KrlConfig, ATableTurnsAtAStatedSpeed) {
    std::vector<ProgramFile> files = good_files();
    const auto put = [&](const std::string& from, const std::string& to) {
        const std::size_t at = files[1].text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        files[1].text.replace(at, from.size(), to);
    };
    put("$BASE = m_base", "$BASE = EK(MACHINE_DEF[2].ROOT,MACHINE_DEF[2].MECH_TYPE,m_base)");
    put("A6 0.000}", "A6 0.000,E1 20.000}");
    put("C 180.000}", "C 180.000,E1 20.000}");
    EXPECT_NE(refusal(files).find("$VEL_EXTAX"), std::string::npos) << refusal(files);
    put("$LOAD = m_l1\r\n$TOOL", "$VEL_EXTAX[1] = 40\r\n$ACC_EXTAX[1] = 30\r\n$LOAD = m_l1\r\n$TOOL");
    EXPECT_EQ(refusal(files), "");
    const ParsedProgram program = read_krl(files, "m");
    EXPECT_EQ(program.states.back().table_speed, 0.4);
    EXPECT_EQ(program.states.back().table_acceleration, 0.3);
}

}  // namespace
}  // namespace qchopper
