// Routines are fixed lines around the signals of the cell file. A dialog takes 80 characters, which KUKA's message
// type allows (KRLMSG_T, KUKA System Software 8.3, operating and programming instructions for system integrators).
// O(operations).

#include "cam/post/krl_config.h"

#include <algorithm>
#include <set>
#include <utility>

#include "cam/post/krl_signals.h"
#include "cam/post/post_signals.h"

namespace qchopper {
namespace {

constexpr std::size_t longest_message = 80;
constexpr double retract_mm = 50;

std::string in_quotes(std::string_view words) {
    std::string text = as_ascii(words);
    std::replace(text.begin(), text.end(), '"', '_');
    return "\"" + text + "\"";
}

void switch_off(const CellMachine& machine, KrlText& text) {
    stop_spindle(machine, text);
    stop_extraction(machine, text);
}

// Nothing follows: a program that went on would carve with a spindle that stands.
void add_stop_for_good(KrlText& text) {
    text.line("LOOP");
    text.line("HALT");
    text.line("ENDLOOP");
    text.line("END");
}

void add_stopped(const CellMachine& machine, const KrlNames& names, KrlText& text) {
    text.line("GLOBAL DEF " + names.stopped() + "( )");
    text.comment("the program was stopped: reset it, and restart from its chunk");
    switch_off(machine, text);
    add_stop_for_good(text);
}

void add_fallen(const CellMachine& machine, const KrlNames& names, KrlText& text) {
    const bool is_x = machine.spindle.tool_axis == ToolAxis::x;
    text.line("GLOBAL DEF " + names.fallen() + "( )");
    text.comment("spindle or extraction is no longer running: reset the program, and restart from its chunk");
    text.line("BRAKE");
    switch_off(machine, text);
    text.line(std::string("LIN_REL {") + (is_x ? "X " : "Z ") + written_mm("retract", -retract_mm) + "} #TOOL");
    add_stop_for_good(text);
}

void add_messages(const KrlNames& names, KrlText& text) {
    text.line("GLOBAL DEF " + names.ask() + "(ASKED[ ]:OUT)");
    text.line("DECL CHAR ASKED[ ]");
    text.line("DECL KRLMSG_T MSG");
    text.line("DECL KRLMSGPAR_T PAR[3]");
    text.line("DECL KRLMSGDLGSK_T KEY[7]");
    text.line("DECL KRLMSGOPT_T OPT");
    text.line("DECL INT DIALOG,ANSWER,I");
    text.line("MSG = {MODUL[] \"QChopper\",NR 1,MSG_TXT[] \" \"}");
    text.line("MSG.MSG_TXT[ ] = ASKED[ ]");
    text.line("FOR I = 1 TO 3");
    text.line("PAR[I] = {PAR_TYPE #EMPTY}");
    text.line("ENDFOR");
    text.line("FOR I = 2 TO 7");
    text.line("KEY[I] = {SK_TYPE #EMPTY}");
    text.line("ENDFOR");
    text.line("KEY[1] = {SK_TYPE #VALUE,SK_TXT[] \"Done\"}");
    text.line("OPT = {VL_STOP TRUE,CLEAR_P_RESET TRUE,CLEAR_P_SAW FALSE,LOG_TO_DB TRUE}");
    text.line("DIALOG = SET_KRLDLG(MSG,PAR[ ],KEY[ ],OPT)");
    text.comment("without a dialog the program stops here instead");
    text.line("IF DIALOG <= 0 THEN");
    text.line("HALT");
    text.line("ENDIF");
    text.line("WHILE (DIALOG > 0) AND EXISTS_KRLDLG(DIALOG,ANSWER)");
    text.line("WAIT SEC 0.1");
    text.line("ENDWHILE");
    text.line("END");
    text.line("GLOBAL DEF " + names.say() + "(SAID[ ]:OUT)");
    text.line("DECL CHAR SAID[ ]");
    text.line("DECL KRLMSG_T MSG");
    text.line("DECL KRLMSGPAR_T PAR[3]");
    text.line("DECL KRLMSGOPT_T OPT");
    text.line("DECL INT MESSAGE,I");
    text.line("MSG = {MODUL[] \"QChopper\",NR 2,MSG_TXT[] \" \"}");
    text.line("MSG.MSG_TXT[ ] = SAID[ ]");
    text.line("FOR I = 1 TO 3");
    text.line("PAR[I] = {PAR_TYPE #EMPTY}");
    text.line("ENDFOR");
    text.line("OPT = {VL_STOP FALSE,CLEAR_P_RESET TRUE,CLEAR_P_SAW FALSE,LOG_TO_DB FALSE}");
    text.line("MESSAGE = SET_KRLMSG(#NOTIFY,MSG,PAR[ ],OPT)");
}

KrlText source(const CellMachine& machine, const KrlNames& names) {
    KrlText text;
    krl::begin_program(names.module(), text);
    text.comment("started alone this does nothing");
    text.line("END");
    add_stopped(machine, names, text);
    add_fallen(machine, names, text);
    add_messages(names, text);
    text.line("END");
    return text;
}

KrlText data(const Program& program, const CellMachine& machine, const KrlNames& names) {
    KrlText text;
    text.line("&ACCESS RVP");
    text.line("&REL 1");
    text.line("DEFDAT " + names.module() + " PUBLIC");
    text.comment("enter a touched-off base and measured tools here, once qchopper verify has proven them");
    text.line("DECL GLOBAL FRAME " + names.base() + " = " + krl::frame(program.base));
    std::set<std::size_t> used;
    for (const ProgramOperation& operation : program.operations) used.insert(operation.tool);
    for (const std::size_t tool : used) {
        const CuttingTool& own = machine.tools[tool];
        text.comment(tool_words(own));
        text.line("DECL GLOBAL FRAME " + names.tool(own.number) + " = " +
                  krl::frame(program.tools[tool].tool_in_flange));
        text.line("DECL GLOBAL LOAD " + names.load(own.number) + " = " + krl::load(program.tools[tool].load));
    }
    text.line("ENDDAT");
    return text;
}

// What is watched: the input of spindle.at_speed and of extraction.running, each with the number of its interrupt.
std::vector<std::pair<int, std::string>> watched(const CellMachine& machine) {
    constexpr int first = 22;
    std::vector<std::pair<int, std::string>> inputs;
    if (machine.spindle.at_speed->kind == SignalKind::input)
        inputs.emplace_back(first, machine.spindle.at_speed->target);
    if (machine.extraction && machine.extraction->running && machine.extraction->running->kind == SignalKind::input) {
        inputs.emplace_back(first + 1, machine.extraction->running->target);
    }
    return inputs;
}

}  // namespace

std::vector<ProgramText> krl_config(const Program& program, const CellMachine& machine, const KrlNames& names) {
    return {{names.module() + ".src", source(machine, names).bytes()},
            {names.module() + ".dat", data(program, machine, names).bytes()}};
}

namespace krl {

void ask(const KrlNames& names, const std::vector<std::string>& sentences, KrlText& text) {
    for (std::string rest : sentences) {
        while (!rest.empty()) {
            std::size_t length = std::min(longest_message, rest.size());
            const std::size_t space = rest.rfind(' ', length);
            if (length < rest.size() && space != std::string::npos && space > 0) length = space;
            text.line(names.ask() + "(" + in_quotes(rest.substr(0, length)) + ")");
            rest.erase(0, std::min(rest.size(), rest.find_first_not_of(' ', length)));
        }
    }
}

void say(const KrlNames& names, const std::string& sentence, KrlText& text) {
    text.line(names.say() + "(" + in_quotes(sentence) + ")");
}

void watch_stops(const KrlNames& names, KrlText& text) {
    text.line("INTERRUPT DECL 21 WHEN $STOPMESS == TRUE DO " + names.stopped() + "( )");
    text.line("INTERRUPT ON 21");
}

void watch_signals(const CellMachine& machine, const KrlNames& names, KrlText& text) {
    for (const auto& [number, input] : watched(machine)) {
        text.line("INTERRUPT DECL " + std::to_string(number) + " WHEN $IN[" + input + "] == FALSE DO " +
                  names.fallen() + "( )");
        text.line("INTERRUPT ON " + std::to_string(number));
    }
}

void unwatch_signals(const CellMachine& machine, KrlText& text) {
    const auto inputs = watched(machine);
    if (!inputs.empty()) text.line("WAIT SEC 0");  // the look-ahead would switch them off up to five moves early
    for (const auto& [number, input] : inputs) text.line("INTERRUPT OFF " + std::to_string(number));
}

}  // namespace krl

}  // namespace qchopper
